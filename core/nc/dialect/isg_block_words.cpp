#include "core/nc/dialect/isg_block_words.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/reasons.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/isg_command.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/passing_calls.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/turning.h"
#include "core/nc/text/characters.h"

namespace trc {
namespace {

WordRole role_of(GGroup group) {
  switch (group) {
    case GGroup::motion:
      return WordRole::motion;
    case GGroup::tangential:
    case GGroup::feed_adaptation:
    case GGroup::transition:
    case GGroup::side:
    case GGroup::selection:
    case GGroup::masking:
      return WordRole::trc;
    case GGroup::plane:
    case GGroup::unit:
    case GGroup::dimension:
    case GGroup::circle_center:
    case GGroup::circle_check:
      return WordRole::mode;
    default:
      return WordRole::technology;
  }
}

bool weighs_axes(int function) {
  constexpr std::array weights{130, 132, 136, 230, 333, 338};
  return std::ranges::find(weights, function) != weights.end();
}

bool is_of_isg_alone(GGroup group) {
  using enum GGroup;
  return group == tangential || group == selection || group == masking || group == circle_center ||
         group == circle_check || group == spatial_circle;
}

Code twice_code(GGroup group) {
  switch (group) {
    case GGroup::transition:
      return Code::transition_type_twice;
    case GGroup::side:
      return Code::compensation_side_twice;
    case GGroup::selection:
      return Code::selection_mode_twice;
    default:
      return Code::nc_group_twice;
  }
}

// G40 stands there, but the tool is still beside the contour (rule 10.9).
constexpr std::string_view behind_lost_retract = " after G40 without motion";

// A call that passes elsewhere: not before the motion that leaves the contour.
TextFault with_reason(const Reading& reading, const ProgramLine& line, TextFault fault) {
  const bool calls = fault.code == Code::nc_unsupported && upper(line.text[fault.begin]) == 'L';
  if (!calls || !reading.contour_open() || reading.trc_active()) return fault;
  fault.detail.resize(std::min(fault.detail.find(", "), fault.detail.size()));
  fault.detail.append(behind_lost_retract);
  return fault;
}

// A continued line may have another number; the first one counts.
bool read_number(Reading& reading, const Word& word, ProgramLine& line, BlockWords&) {
  if (word.has_argument || !word.whole || !is_whole(word.value))
    return reading.refuse(line, word, Code::nc_number);
  if (line.source.number != Source::no_number) {
    const std::string_view before =
        without_blanks_behind(std::string_view(line.text).substr(0, word.begin));
    const bool new_line = before.ends_with('\n') || before.ends_with('\r');
    if (!new_line) return reading.refuse(line, word, Code::nc_word_twice);
  } else {
    line.source.number = static_cast<std::int64_t>(word.value);
  }
  add(line, word, WordRole::number);
  return true;
}

// Whether axis words stand in the line, which a declared function may not have beside it.
bool names_axis(const ProgramLine& line) {
  const std::string_view text = line.text;
  for (std::size_t at = 0; at < text.size() && text[at] != '(' && text[at] != ';'; ++at) {
    const bool is_letter_alone = at == 0 || !is_letter(text[at - 1]);
    if (!is_letter_alone || std::string_view("XYZ").find(upper(text[at])) == std::string_view::npos)
      continue;
    const std::size_t value = std::min(text.find_first_not_of(" =+-", at + 1), text.size());
    if (value < text.size() && (is_digit(text[value]) || text[value] == '.')) return true;
  }
  return false;
}

bool read_unknown_function(Reading& reading, const Word& word, ProgramLine& line,
                           BlockWords& block) {
  if (passes_word(reading.state.setup(), line.text, word.begin)) {
    block.isg.passed_function = word.begin;
    add(line, word, WordRole::technology);
    return true;
  }
  const bool is_of_another = !reading.isg_word_seen && looks_like(line.text);
  std::string detail(line.word({.begin = word.begin, .end = word.end}));
  if (!is_of_another && names_axis(line)) detail += reason::with_axis_words;
  return reading.refuse(line, word, Code::nc_unknown_function, std::move(detail));
}

bool refuse_function(Reading& reading, const Word& word, const GFunction& function,
                     ProgramLine& line) {
  Code code = Code::nc_unsupported;
  if (function.group == GGroup::spatial_circle && reading.state.mode().active())
    code = Code::spatial_circle_while_active;
  else if (function.group == GGroup::spatial_circle && reading.state.just_deselected())
    code = Code::spatial_circle_after_deselection;
  TextFault fault{
      .code = code, .begin = word.begin, .detail = named(function, ", ").append(function.meaning)};
  if (function.number == 21) fault.slip = {.kind = SlipKind::unit_of_another, .instead = "G71"};
  return reading.refuse(line, fault);
}

bool read_g_function(Reading& reading, const Word& word, ProgramLine& line, BlockWords& block) {
  const GFunction* function =
      word.has_argument || word.whole ? find_g_function(word.value) : nullptr;
  if (function == nullptr) return read_unknown_function(reading, word, line, block);
  const GGroup group = function->group;
  reading.isg_word_seen |= is_of_isg_alone(group);
  reading.gcode.seen.lathe |= function->number == 96;
  // G20 ends mirroring here, which is the initial state, but means inch elsewhere: the program
  // would run in millimetres instead of inches.
  if (function->number == 20 && !reading.isg_word_seen)
    return reading.refuse(line,
                          TextFault{.code = Code::other_dialect,
                                    .begin = word.begin,
                                    .detail = "G20, inch in fanuc and linuxcnc",
                                    .slip = {.kind = SlipKind::unit_of_another, .instead = "G70"}});
  if (function->number == 301 || function->number == 302) {
    block.isg.corner = named(*function, function->number == 301 ? ", chamfer" : ", rounding");
    block.isg.corner_begin = word.begin;
    block.isg.corner_has_i_word = true;
    add(line, word, WordRole::technology);
    return true;
  }
  // G80 … G89 alone: passing_calls.cpp.
  const bool calls = group == GGroup::single_move && function->number / 10 == 8;
  if (group == GGroup::refused || group == GGroup::spatial_circle || calls)
    return refuse_function(reading, word, *function, line);
  if (group == GGroup::zero_shift && reading.contour_open() &&
      reading.gcode.coordinates.work_offset != function->tenths())
    return reading.refuse(
        line, word, Code::nc_unsupported,
        named(*function, reading.trc_active() ? " while TRC is active" : behind_lost_retract));
  constexpr int homing = 74;
  block.isg.homes |= function->number == homing;
  if (weighs_axes(function->number)) block.isg.weights = word.begin;
  const bool may_have_argument = group == GGroup::zero_shift || group == GGroup::technology ||
                                 group == GGroup::axis_technology;
  if (word.has_argument && !may_have_argument) return reading.refuse(line, word, Code::nc_syntax);
  BlockWords::Function& seen = block.functions[static_cast<std::size_t>(group)];
  if (seen.function != nullptr && group != GGroup::technology && group != GGroup::axis_technology)
    return reading.refuse(line, word, twice_code(group));
  seen = {.function = function, .begin = word.begin};
  // A G40 that ends nothing is an ordinary line of the program.
  const bool ends_nothing = group == GGroup::side && function->number == 40;
  add(line, word, ends_nothing && !reading.contour_open() ? WordRole::mode : role_of(group));
  return true;
}

bool read_axis(Reading& reading, const Word& word, ProgramLine& line, BlockWords& block) {
  int axis = reading.axis_of_letter[static_cast<std::size_t>(word.letter - 'A')];
  double value = word.value;
  if (word.has_argument) {  // an axis with a name of its own
    const std::string_view text = line.word({.begin = word.begin, .end = word.end});
    const std::string_view name = without_blanks_behind(text.substr(0, text.find('=')));
    const auto& names = reading.state.setup().tracking_axes;
    const auto found = std::ranges::find_if(
        names, [&](const std::string& candidate) { return same_name(candidate, name); });
    axis = found == names.end() ? -1 : static_cast<int>(found - names.begin()) + 3;
    value = word.argument;
  }
  if (axis < 0) return reading.refuse(line, word, Code::nc_axis_unknown);
  const auto index = static_cast<std::size_t>(axis);
  if (index >= 3 && block.move.tracking.size() <= index - 3)
    block.move.tracking.resize(reading.state.setup().tracking_axes.size());
  auto& coordinate = index < 3 ? block.move.end[index] : block.move.tracking[index - 3];
  if (coordinate) return reading.refuse(line, word, Code::nc_word_twice);
  coordinate = value;
  if (!block.axis) block.axis = word.begin;
  add(line, word, WordRole::coordinate);
  return true;
}

bool read_machine_function(Reading& reading, const Word& word, ProgramLine& line,
                           BlockWords& block) {
  if (word.value == 17 || word.value == 29)
    return reading.refuse(line, word, Code::nc_unsupported, "M17, M29, the end of a subprogram");
  // M2=3 belongs to the second spindle.
  const bool ends = !word.has_argument && (word.value == 2 || word.value == 30);
  line.ends_program |= ends;
  block.tools.loads |= word.value == 6;
  add(line, word,
      ends || word.value == 0 || word.value == 1 ? WordRole::stop : WordRole::technology);
  return true;
}

bool read_address(Reading& reading, const Word& word, ProgramLine& line, BlockWords& block) {
  const char letter = word.letter;
  const auto twice = [&] { return reading.refuse(line, word, Code::nc_word_twice); };
  const bool may_have_argument = letter == 'S' || letter == 'M' || letter == 'H';
  const bool axis_letter = letter <= 'C' || letter == 'Q' || letter >= 'U';
  if (axis_letter) return read_axis(reading, word, line, block);
  if (word.has_argument && !may_have_argument) return reading.refuse(line, word, Code::nc_syntax);
  switch (letter) {
    case 'I':
    case 'J':
    case 'K': {
      auto& center = block.move.center[static_cast<std::size_t>(letter - 'I')];
      if (center) return twice();
      center = word.value;
      break;
    }
    case 'R':
      if (block.move.radius) return twice();
      block.move.radius = word.value;
      break;
    case 'F':
      if (block.feed) return twice();
      if (word.value < 0) return reading.refuse(line, word, Code::nc_number);
      block.feed = {.value = word.value, .begin = word.begin};
      add(line, word, WordRole::feed);
      return true;
    case 'D':
      if (block.tools.d_word) return twice();
      if (block.tools.radius)
        return reading.refuse(line, word, Code::radius_and_tool_word_together);
      if (!is_number_of_tool(word.value)) return reading.refuse(line, word, Code::nc_number);
      block.tools.d_word = {.value = word.value, .begin = word.begin};
      add(line, word, WordRole::technology);
      return true;
    case 'T':
      if (block.tools.t_word) return twice();
      if (!is_number_of_tool(word.value)) return reading.refuse(line, word, Code::nc_number);
      block.tools.t_word = {.value = word.value, .begin = word.begin};
      reading.gcode.seen.lathe |=
          is_turning_tool(line.word({.begin = word.begin, .end = word.end}));
      add(line, word, WordRole::technology);
      return true;
    case 'S':
      if (!word.has_argument && std::exchange(block.isg.has_spindle, true)) return twice();
      add(line, word, WordRole::technology);
      return true;
    case 'H':
      add(line, word, WordRole::technology);
      return true;
    case 'M':
      return read_machine_function(reading, word, line, block);
    default:
      return reading.refuse(line, word, Code::nc_unsupported);
  }
  if (!block.center) block.center = word.begin;
  add(line, word, WordRole::coordinate);
  return true;
}

}  // namespace

std::string named(const GFunction& function, std::string_view why) {
  return std::string("G").append(std::to_string(function.number)).append(why);
}

bool read_isg_words(Reading& reading, ProgramLine& line, BlockWords& block) {
  const auto comment_bytes = reading.state.setup().demands_utf8() ? WordReader::CommentBytes::utf8
                                                                  : WordReader::CommentBytes::any;
  WordReader reader(line.text, comment_bytes);
  for (;;) {
    const Word word = reader.next();
    switch (word.kind) {
      case WordKind::end:
        if (block.isg.has_command && block.words > 1)
          return reading.refuse(
              line, TextFault{.begin = block.isg.command, .detail = "# not alone in its block"});
        if (block.isg.number_alone && !block.has(GGroup::dwell))
          return reading.refuse(line, TextFault{.begin = *block.isg.number_alone,
                                                .detail = "a number without letter"});
        return true;
      case WordKind::fault:
        return read_call_behind_words(reading, reader.fault().begin, line, block) ||
               reading.refuse(line, with_reason(reading, line, reader.fault()));
      case WordKind::comment:
        add(line, word, WordRole::comment);
        continue;
      case WordKind::skip:
        if (const SkipSign sign = skip_sign_of(line.text, DialectName::isg);
            sign.begin != word.begin || !is_beside_the_path(line.text, sign, DialectName::isg))
          return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                                .begin = word.begin,
                                                .detail = "/, a block to skip on demand"});
        add(line, word, WordRole::technology);
        continue;
      case WordKind::address:
        if (word.letter == 'N') {
          if (!read_number(reading, word, line, block)) return false;
          continue;
        }
        if (!(word.letter == 'G' ? read_g_function(reading, word, line, block)
                                 : read_address(reading, word, line, block)))
          return false;
        break;
      case WordKind::number:
        if (block.isg.number_alone) return reading.refuse(line, word, Code::nc_syntax);
        block.isg.number_alone = word.begin;
        add(line, word, WordRole::technology);
        break;
      case WordKind::variable:
        if (block.tools.d_word)
          return reading.refuse(line, word, Code::radius_and_tool_word_together);
        if (block.tools.radius) return reading.refuse(line, word, Code::nc_word_twice);
        reading.isg_word_seen = true;
        block.tools.radius = {.value = word.value, .begin = word.begin};
        block.tools.radius_is_change = word.relative;
        add(line, word, WordRole::trc);
        break;
      case WordKind::command:
        if (!read_command(reading, word, line, block)) return false;
        break;
    }
    ++block.words;
  }
}

}  // namespace trc
