#include "core/nc/dialect/gcode_block_words.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/reasons.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/gcode_beside_path.h"
#include "core/nc/dialect/gcode_block.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/turning.h"
#include "core/nc/text/characters.h"

// Reads the words of a block of plain letters and numbers: the dialects of Fanuc and LinuxCNC.

namespace trc {
namespace {

using enum GGroup;

WordRole role_of(GGroup group) {
  switch (group) {
    case motion:
      return WordRole::motion;
    case side:
      return WordRole::trc;
    case plane:
    case unit:
    case dimension:
    case circle_center:
      return WordRole::mode;
    default:
      return WordRole::technology;
  }
}

bool is_subprogram_call(double m) { return m == 96 || m == 97 || m == 98 || m == 198; }

// `:0030 T01 M06`: the number of a block at which a program may be entered. A lone `:` begins a
// program.
bool is_alignment_block(std::string_view line, const GcodeWord& word) {
  const std::string_view behind = without_blanks_in_front(line.substr(word.end));
  return line[word.begin] == ':' && !behind.empty() && behind.front() != '(' &&
         behind.front() != ';';
}

// False if the sign follows other words and only coolant and the like follow the sign.
bool hangs_on_switch(const Reading& reading, std::string_view line, const BlockWords& block) {
  const SkipSign within = skip_sign_within(line, reading.dialect.name);
  return block.words == 0 || !within.is_there() ||
         !is_beside_the_path(line, within, reading.dialect.name);
}

bool read_gcode_function(Reading& reading, const GcodeWord& word, ProgramLine& line,
                         BlockWords& block) {
  const GFunction* function = reading.dialect.function(word.value);
  // G41.2 … G42.6 of FANUC: no declaration lets them pass, as they compensate.
  const double whole = std::floor(word.value);
  const bool may_be_passed = function == nullptr && whole != 41 && whole != 42;
  if (may_be_passed && passes_word(reading.state.setup(), line.text, word.begin))
    function = &by_name::passing_function;
  if (function == nullptr && reading.state.setup().copies_unknown_words)
    function = &by_name::unknown_function;
  // On FANUC these functions turn the tool into the direction of the path.
  if (function == nullptr && (word.value == 41.1 || word.value == 42.1))
    return refuse_word(reading, line, word, Code::nc_unsupported,
                       "a correction of LINUXCNC, or a direction of the tool");
  if (function == nullptr && !may_be_passed)
    return refuse_word(reading, line, word, Code::nc_unsupported,
                       "compensation of the tool radius in space");
  if (function == nullptr) return refuse_word(reading, line, word, Code::nc_unknown_function);
  const GGroup group = function->group;
  if (group == refused || group == call)
    return refuse_word(reading, line, word, Code::nc_unsupported, function->meaning);
  if (group == turning) return refuse_word(reading, line, word, Code::turning, function->meaning);
  BlockWords::Function& seen = block.functions[static_cast<std::size_t>(group)];
  const bool alone = group != technology && group != axis_technology;
  // Functions that all end a mode may share a line: G15 and G50, G69 and G50.1 of a first line.
  const bool both_end =
      seen.function != nullptr &&
      (group == unfollowed_end || (group == frame && function->initial && seen.function->initial));
  if (alone && seen.function != nullptr && seen.function != function && !both_end)
    return refuse_word(reading, line, word,
                       group == side ? Code::compensation_side_twice : Code::nc_group_twice);
  // Keeps the function that other words of the line refer to: the speed limit of G50, the axes of
  // G50.1.
  if (group == unfollowed_end || group == frame)
    block.coordinates.ends.push_back(static_cast<std::int16_t>(function->tenths()));
  if (!both_end || seen.is(15) || seen.is(69)) seen = {.function = function, .begin = word.begin};
  block.coordinates.changes_length |=
      function->tenth == 0 &&
      (function->number == 43 || function->number == 44 || function->number == 49);
  if (function->number == 96)
    reading.gcode.seen.lathe = block.spindle.constant_cutting_speed = true;
  // A G40 that ends nothing is an ordinary line of the program.
  const bool ends_nothing = group == side && function->number == 40 && !reading.contour_open();
  if (reading.dialect.name == DialectName::fanuc && function->tenths() == tenths_of(11))
    reading.gcode.enters_parameters = false;
  add(line, word, ends_nothing ? WordRole::mode : role_of(group));
  return true;
}

// A coordinate; `bit`: as in WholeWord.
void see_whole(Reading& reading, const GcodeWord& word, std::size_t bit, BlockWords& block) {
  constexpr std::size_t bits = 64;
  if (word.whole && bit < bits) block.whole |= std::uint64_t{1} << bit;
  if (!word.whole) reading.gcode.seen.points = true;
}

bool read_gcode_axis(Reading& reading, const GcodeWord& word, ProgramLine& line,
                     BlockWords& block) {
  const int axis = reading.axis_of_letter[static_cast<std::size_t>(word.letter - 'A')];
  if (axis < 0) return refuse_word(reading, line, word, Code::nc_axis_unknown);
  const auto index = static_cast<std::size_t>(axis);
  if (index >= 3 && block.move.tracking.size() <= index - 3)
    block.move.tracking.resize(reading.state.setup().tracking_axes.size());
  auto& coordinate = index < 3 ? block.move.end[index] : block.move.tracking[index - 3];
  if (coordinate) return refuse_word(reading, line, word, Code::nc_word_twice);
  coordinate = word.value;
  see_whole(reading, word, index < 3 ? WholeWord::axis + index : WholeWord::tracking + index - 3,
            block);
  reading.gcode.seen.y |= word.letter == 'Y';
  if (!block.axis) block.axis = word.begin;
  add(line, word, WordRole::coordinate);
  return true;
}

// ,R ,C ,A
bool read_comma_word(Reading& reading, const GcodeWord& word, ProgramLine& line,
                     BlockWords& block) {
  if (reading.dialect.name == DialectName::linuxcnc)
    return refuse_word(reading, line, word, Code::nc_unsupported, "which LinuxCNC does not have");
  const bool angle = word.letter == 'A';
  if (word.letter == 'R' || word.letter == 'C') {
    if (block.corners.begin) return refuse_word(reading, line, word, Code::nc_word_twice);
    block.corners.begin = word.begin;
    block.move.corner = {.form = word.letter == 'R' ? CornerCut::Form::round : CornerCut::Form::leg,
                         .size = word.value};
    see_whole(reading, word, WholeWord::corner, block);
  } else if (angle && reading.trc_active()) {
    if (block.angle) return refuse_word(reading, line, word, Code::nc_word_twice);
    block.angle = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::trc);
    return true;
  } else if (reading.trc_active()) {
    return refuse_word(reading, line, word, Code::nc_unsupported,
                       "a rounding or a chamfer while TRC is active");
  } else if (angle) {
    block.unfollowed_word = word.begin;
  } else {
    return refuse_word(reading, line, word, Code::nc_syntax);  // X0, Y0
  }
  add(line, word, WordRole::technology);
  return true;
}

// In LinuxCNC $ is a spindle and @ a polar radius.
bool read_gcode_sign(Reading& reading, const GcodeWord& word, ProgramLine& line,
                     BlockWords& block) {
  const bool linuxcnc = reading.dialect.name == DialectName::linuxcnc;
  if (word.letter == '$') {
    if (!linuxcnc) return refuse_word(reading, line, word, Code::nc_syntax);
  } else {
    if (!linuxcnc || reading.trc_active())
      return refuse_word(reading, line, word, Code::nc_unsupported, "polar coordinates");
    block.unfollowed_word = word.begin;
  }
  add(line, word, WordRole::technology);
  return true;
}

// I, J, K and R.
bool read_gcode_center(Reading& reading, const GcodeWord& word, ProgramLine& line,
                       BlockWords& block) {
  const bool is_radius = word.letter == 'R';
  const auto axis = is_radius ? 0 : static_cast<std::size_t>(word.letter - 'I');
  auto& target = is_radius ? block.move.radius : block.move.center[axis];
  if (target) return refuse_word(reading, line, word, Code::nc_word_twice);
  target = word.value;
  see_whole(reading, word, is_radius ? WholeWord::radius : WholeWord::center + axis, block);
  if (!block.center) block.center = word.begin;
  add(line, word, WordRole::coordinate);
  return true;
}

// T of FANUC may give an offset number after a point, and may occur twice.
bool read_gcode_tool(Reading& reading, const GcodeWord& word, ProgramLine& line,
                     BlockWords& block) {
  if (block.tools.later_t_word ||
      (block.tools.t_word && reading.dialect.name != DialectName::fanuc))
    return refuse_word(reading, line, word, Code::nc_word_twice);
  if (!is_number_of_tool(std::floor(word.value)))
    return refuse_word(reading, line, word, Code::nc_number);
  (block.tools.t_word ? block.tools.later_t_word : block.tools.t_word) = {
      .value = std::floor(word.value), .begin = word.begin};
  reading.gcode.seen.lathe |= is_turning_tool(line.word({.begin = word.begin, .end = word.end}));
  add(line, word, WordRole::technology);
  return true;
}

bool read_gcode_machine_function(Reading& reading, const GcodeWord& word, ProgramLine& line,
                                 BlockWords& block) {
  const double m = word.value;
  if (is_subprogram_call(m))
    return refuse_word(reading, line, word, Code::nc_unsupported, "a subprogram call");
  const bool linuxcnc = reading.dialect.name == DialectName::linuxcnc;
  if (linuxcnc && (m == 70 || m == 71 || m == 72))
    block.kept_modes = {.value = m, .begin = word.begin};
  if (linuxcnc && m == 73)
    return refuse_word(reading, line, word, Code::nc_unsupported,
                       "modes as they were before a subprogram");
  block.tools.q_word_names_tool |= linuxcnc && m == 61;
  const bool ends = m == 2 || m == 30 || m == 99;
  line.ends_program |= ends;
  if (m == 6) block.tools.change = word.begin;
  block.spindle.is_oriented |= m == 19;
  block.tools.loads |= m == 6;
  add(line, word, ends || m == 0 || m == 1 ? WordRole::stop : WordRole::technology);
  return true;
}

bool read_gcode_address(Reading& reading, const GcodeWord& word, ProgramLine& line,
                        BlockWords& block) {
  const auto twice = [&] { return refuse_word(reading, line, word, Code::nc_word_twice); };
  const BlockWords::Value value{.value = word.value, .begin = word.begin};
  if (word.comma) return read_comma_word(reading, word, line, block);
  const char letter = word.letter;
  if (letter == '$' || letter == '@') return read_gcode_sign(reading, word, line, block);
  if (letter <= 'C' || letter >= 'U') return read_gcode_axis(reading, word, line, block);
  switch (letter) {
    case 'I':
    case 'J':
    case 'K':
    case 'R':
      return read_gcode_center(reading, word, line, block);
    case 'F':
      if (block.feed) return twice();
      if (word.value < 0) return refuse_word(reading, line, word, Code::nc_number);
      block.feed = value;
      if (word.whole) block.whole |= std::uint64_t{1} << WholeWord::feed;
      add(line, word, WordRole::feed);
      return true;
    case 'D':
      if (block.tools.d_word) return twice();
      if (word.value >= first_named_tool) return refuse_word(reading, line, word, Code::nc_number);
      block.tools.d_word = value;
      break;
    case 'T':
      return read_gcode_tool(reading, word, line, block);
    case 'M':
      return read_gcode_machine_function(reading, word, line, block);
    case 'L':
      block.l_word = value;
      break;
    case 'P':
      block.p_word = value;
      break;
    case 'Q':
      block.q_word = value;
      break;
    case 'H':
      block.h_word = value;
      break;
    case 'S':
      block.spindle.speed = value;
      break;
    default:  // E
      break;
  }
  add(line, word, WordRole::technology);
  return true;
}

}  // namespace

bool refuse_word(Reading& reading, const ProgramLine& line, const GcodeWord& word, Code code,
                 std::string_view meaning) {
  std::string detail(line.word({.begin = word.begin, .end = word.end}));
  if (!meaning.empty()) detail.append(", ").append(meaning);
  return reading.refuse(line,
                        TextFault{.code = code, .begin = word.begin, .detail = std::move(detail)});
}

bool read_gcode_words(Reading& reading, ProgramLine& line, BlockWords& block) {
  const auto blanks = reading.dialect.name == DialectName::linuxcnc
                          ? GcodeReader::Blanks::in_numbers
                          : GcodeReader::Blanks::between_words;
  GcodeReader reader(line.text, blanks);
  std::size_t faults = 0;
  for (;;) {
    const GcodeWord word = reader.next();
    switch (word.kind) {
      case GcodeWord::Kind::end:
        return complete_gcode_block(reading, line, block) && faults == 0;
      case GcodeWord::Kind::fault:
        if (reader.fault().code == Code::nc_unsupported &&
            names_what_passes(reading, line.text, word.begin) &&
            !cuts_off_words(reading, line, word.begin)) {
          line.words.push_back(
              {.begin = word.begin,
               .end = static_cast<std::uint32_t>(without_blanks_behind(line.text).size())});
          break;
        }
        reading.refuse(line, reader.fault());
        ++faults;
        break;
      case GcodeWord::Kind::comment:
        if (reading.dialect.name == DialectName::fanuc && block.words > 0 &&
            reads_as_block(std::string_view(line.text).substr(word.begin, word.end - word.begin))) {
          refuse_word(reading, line, word, Code::nc_unsupported,
                      "a second block in the line, or a comment that reads as one");
          ++faults;
          break;
        }
        add(line, word, WordRole::comment);
        break;
      case GcodeWord::Kind::skip:
        block.to_skip |= hangs_on_switch(reading, line.text, block);
        add(line, word, WordRole::technology);
        break;
      case GcodeWord::Kind::address:
        faults += read_gcode_word(reading, word, line, block) ? 0 : 1;
        break;
    }
    if (reading.diagnostics.stopped() || faults >= reading.limits.most_faults) return false;
  }
}

bool read_gcode_word(Reading& reading, const GcodeWord& word, ProgramLine& line,
                     BlockWords& block) {
  switch (word.letter) {
    case 'N':
      // Some controls jump and call with an N after other words.
      if (block.words > 0)
        return refuse_word(reading, line, word, Code::nc_syntax, reason::number_after_words);
      if (word.has_number && word.whole && is_whole(word.value))
        line.source.number = static_cast<std::int64_t>(word.value);
      add(line, word, WordRole::number);
      return true;
    case 'O':  // the program number
      if (is_alignment_block(line.text, word)) {
        add(line, word, WordRole::number);
        return true;
      }
      if ((reading.blocks_read > 0 || line.text[word.end - 1] == '>') &&
          reading.dialect.name == DialectName::linuxcnc)
        return refuse_word(reading, line, word, Code::nc_unsupported, "a subprogram or a loop");
      if (reading.blocks_read > 0)
        return reading.refuse(line,
                              TextFault{.code = Code::nc_unsupported,
                                        .begin = word.begin,
                                        .detail = reading.gcode.seen.program
                                                      ? "O, a second program in one text"
                                                      : "O, after blocks without a number of their "
                                                        "program"});
      reading.gcode.seen.program = true;
      add(line, word, WordRole::comment);
      return true;
    case 'G':
      ++block.words;
      return read_gcode_function(reading, word, line, block);
    default:
      ++block.words;
      return read_gcode_address(reading, word, line, block);
  }
}

}  // namespace trc
