#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "core/base/likely_meant.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/text/characters.h"

// How a block of plain letters and numbers is read: the dialects of Fanuc and of LinuxCNC.

namespace trc {
namespace {

using enum GGroup;

// SCALE of Sinumerik, which ends where it stands alone.
constexpr int scale_tenths = 10060;

void add(ProgramLine& line, const CodeWord& word, WordRole role) {
  line.words.push_back({.begin = word.begin, .end = word.end, .role = role});
}

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

// T0101: the tool and its offset in one word, as lathes have it.
bool is_turning_tool(std::string_view word) {
  return word.size() == 5 && word.substr(1) != "0000" && word.substr(1, 2) == word.substr(3);
}

// -1 where it is none.
std::int64_t whole_number(double value) {
  return is_whole(value) ? static_cast<std::int64_t>(value) : -1;
}

bool has_length_offset(const ProgramLine& line) {
  return std::ranges::any_of(line.words, [&](const WordRange& range) {
    const std::string_view word = line.word(range);
    return word == "G43" || word == "g43" || word == "G44" || word == "g44";
  });
}

constexpr std::array<MotionKind, 4> motions{MotionKind::rapid, MotionKind::linear,
                                            MotionKind::clockwise, MotionKind::counter_clockwise};

bool is_subprogram_call(double m) { return m == 96 || m == 97 || m == 98 || m == 198; }

}  // namespace

bool Interpreter::refuse_code(const ProgramLine& line, const CodeWord& word, Code code,
                              std::string_view meaning) {
  std::string detail(line.word({.begin = word.begin, .end = word.end}));
  if (!meaning.empty()) detail.append(", ").append(meaning);
  return refuse(line, TextFault{.code = code, .begin = word.begin, .detail = std::move(detail)});
}

// All words are read, also behind one that is refused, so that every obstacle is told.
bool Interpreter::read_code_words(ProgramLine& line, BlockWords& block) {
  CodeReader reader(line.text);
  bool readable = true;
  for (;;) {
    const CodeWord word = reader.next();
    switch (word.kind) {
      case CodeWord::Kind::end:
        return complete_code_block(line, block) && readable;
      case CodeWord::Kind::fault:
        refuse(line, reader.fault());
        readable = false;
        break;
      case CodeWord::Kind::comment:
        add(line, word, WordRole::comment);
        break;
      case CodeWord::Kind::skip:
        block.to_skip = true;
        add(line, word, WordRole::technology);
        break;
      case CodeWord::Kind::address:
        readable = read_code_word(word, line, block) && readable;
        break;
    }
    if (diagnostics_.stopped()) return false;
  }
}

bool Interpreter::read_code_word(const CodeWord& word, ProgramLine& line, BlockWords& block) {
  switch (word.letter) {
    case 'N':
      // Some controls jump and call with N behind other words.
      if (block.words > 0)
        return refuse_code(line, word, Code::nc_unsupported, "behind other words");
      if (word.has_number && word.whole && is_whole(word.value))
        line.source.number = static_cast<std::int64_t>(word.value);
      add(line, word, WordRole::number);
      return true;
    case 'O':  // the number of the program
      if (blocks_read_ > 0 && dialect_.name == DialectName::linuxcnc)
        return refuse_code(line, word, Code::nc_unsupported, "a subprogram or a loop");
      if (blocks_read_ > 0)
        return refuse(line, TextFault{.code = Code::nc_unsupported,
                                      .begin = word.begin,
                                      .detail = "O, a second program in one text"});
      add(line, word, WordRole::comment);
      return true;
    case 'G':
      ++block.words;
      return read_code_function(word, line, block);
    default:
      ++block.words;
      return read_code_address(word, line, block);
  }
}

bool Interpreter::read_code_function(const CodeWord& word, ProgramLine& line, BlockWords& block) {
  const GFunction* function = dialect_.function(word.value);
  static constexpr GFunction unknown{
      .number = 1007, .group = single_move, .meaning = "an unknown function"};
  if (function == nullptr && state_.setup().copies_unknown_words) function = &unknown;
  if (function == nullptr) return refuse_code(line, word, Code::nc_unknown_function);
  const GGroup group = function->group;
  if (group == refused || group == call)
    return refuse_code(line, word, Code::nc_unsupported, function->meaning);
  if (group == turning) return refuse_code(line, word, Code::turning, function->meaning);
  BlockWords::Function& seen = block.functions[static_cast<std::size_t>(group)];
  const bool alone = group != technology && group != axis_technology;
  if (alone && seen.function != nullptr && seen.function != function)
    return refuse_code(line, word,
                       group == side ? Code::compensation_side_twice : Code::nc_group_twice);
  seen = {.function = function, .begin = word.begin};
  if (function->number == 96) code_.turning = true;
  // Where there is nothing to end, G40 is a line of the program like any other.
  const bool ends_nothing = group == side && function->number == 40 && !contour_open();
  add(line, word, ends_nothing ? WordRole::mode : role_of(group));
  return true;
}

bool Interpreter::read_code_axis(const CodeWord& word, ProgramLine& line, BlockWords& block) {
  const int axis = axis_of_letter_[static_cast<std::size_t>(word.letter - 'A')];
  if (axis < 0) return refuse_code(line, word, Code::nc_axis_unknown);
  const auto index = static_cast<std::size_t>(axis);
  if (index >= 3 && block.move.tracking.size() <= index - 3)
    block.move.tracking.resize(state_.setup().tracking_axes.size());
  auto& coordinate = index < 3 ? block.move.end[index] : block.move.tracking[index - 3];
  if (coordinate) return refuse_code(line, word, Code::nc_word_twice);
  coordinate = word.value;
  code_.y_seen |= word.letter == 'Y';
  if (!block.axis) block.axis = word.begin;
  add(line, word, WordRole::coordinate);
  return true;
}

bool Interpreter::read_code_address(const CodeWord& word, ProgramLine& line, BlockWords& block) {
  const auto twice = [&] { return refuse_code(line, word, Code::nc_word_twice); };
  const BlockWords::Value value{.value = word.value, .begin = word.begin};
  if (word.comma && dialect_.name == DialectName::linuxcnc)
    return refuse_code(line, word, Code::nc_unsupported, "which LinuxCNC does not have");
  if (word.comma) {
    const bool angle = word.letter == 'A';
    if (word.letter == 'R' || word.letter == 'C') {
      if (block.corner) return twice();
      block.corner = word.begin;
      block.move.corner = {
          .form = word.letter == 'R' ? CornerCut::Form::round : CornerCut::Form::leg,
          .size = word.value};
      add(line, word, WordRole::technology);
      return true;
    }
    if (trc_active())
      return refuse_code(line, word, Code::nc_unsupported,
                         angle ? "the angle of a motion while TRC is active"
                               : "a rounding or a chamfer while TRC is active");
    if (angle) block.unfollowed_word = word.begin;
    add(line, word, WordRole::technology);
    return true;
  }
  const char letter = word.letter;
  if (letter == '$') {
    if (dialect_.name != DialectName::linuxcnc) return refuse_code(line, word, Code::nc_syntax);
    add(line, word, WordRole::technology);
    return true;
  }
  if (letter <= 'C' || letter >= 'U') return read_code_axis(word, line, block);
  switch (letter) {
    case 'I':
    case 'J':
    case 'K':
    case 'R': {
      auto& target = letter == 'R' ? block.move.radius
                                   : block.move.center[static_cast<std::size_t>(letter - 'I')];
      if (target) return twice();
      target = word.value;
      if (!block.center) block.center = word.begin;
      add(line, word, WordRole::coordinate);
      return true;
    }
    case 'F':
      if (block.feed) return twice();
      if (word.value < 0) return refuse_code(line, word, Code::nc_number);
      block.feed = value;
      add(line, word, WordRole::feed);
      return true;
    case 'D':
      if (block.tool) return twice();
      if (word.value >= first_named_tool) return refuse_code(line, word, Code::nc_number);
      block.tool = value;
      break;
    case 'T':
      if (block.later_tool || (block.tool_number && dialect_.name != DialectName::fanuc))
        return twice();
      if (!is_number_of_tool(std::floor(word.value)))
        return refuse_code(line, word, Code::nc_number);
      (block.tool_number ? block.later_tool : block.tool_number) = {.value = std::floor(word.value),
                                                                    .begin = word.begin};
      code_.turning |= is_turning_tool(line.word({.begin = word.begin, .end = word.end}));
      break;
    case 'M':
      return read_code_machine_function(word, line, block);
    case 'L':
      block.tool_data = value;
      break;
    case 'P':
      block.tool_data_number = value;
      break;
    case 'Q':
      block.quantity = value;
      break;
    case 'H':
      block.offset = value;
      break;
    default:  // S E
      break;
  }
  add(line, word, WordRole::technology);
  return true;
}

bool Interpreter::read_code_machine_function(const CodeWord& word, ProgramLine& line,
                                             BlockWords& block) {
  const double m = word.value;
  if (is_subprogram_call(m))
    return refuse_code(line, word, Code::nc_unsupported, "a subprogram call");
  const bool linuxcnc = dialect_.name == DialectName::linuxcnc;
  if (linuxcnc && m == 72)
    return refuse_code(line, word, Code::nc_unsupported, "modes as they were at M70");
  block.names_tool |= linuxcnc && m == 61;
  const bool ends = m == 2 || m == 30 || m == 99;
  line.ends_program |= ends;
  block.changes_tool |= m == 6;
  block.loads_tool |= m == 6;
  add(line, word, ends || m == 0 || m == 1 ? WordRole::stop : WordRole::technology);
  return true;
}

// What the words mean together, before any of it takes effect.
bool Interpreter::complete_code_block(ProgramLine& line, BlockWords& block) {
  // T01T02M06 of Mazak: the first tool is changed, the second one fetched meanwhile. Radii come
  // from D, so nothing hangs on which of them a control loads.
  if (block.later_tool && !block.changes_tool)
    return refuse(line, TextFault{.code = Code::nc_word_twice,
                                  .begin = block.later_tool->begin,
                                  .detail = "T without M06"});
  if (block.tool_number)
    code_.next_tool = block.named_tool.value_or(whole_number(block.tool_number->value));
  code_.tool_named |= block.tool_number.has_value();
  code_.changes_by_m6 |= block.changes_tool;
  if (block.changes_tool) {
    code_.spindle_tool = code_.next_tool;
    code_.spindle_empty = code_.tool_named && code_.next_tool == 0;
    block.forget |= static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  }
  if (block.names_tool && block.quantity) {
    code_.spindle_tool = whole_number(block.quantity->value);
    code_.spindle_empty = code_.spindle_tool == 0;
  }
  const bool spindle_limit = block.has(unfollowed_end) && block.of(unfollowed_end).is(50);
  const bool has_spindle = std::ranges::any_of(line.words, [&](const WordRange& word) {
    return line.text[word.begin] == 'S' || line.text[word.begin] == 's';
  });
  code_.turning |= (spindle_limit || block.of(frame).is(92)) && has_spindle;
  // Under MCALL of Sinumerik each motion has the cycle behind it.
  const bool motion_ends_cycle = block.has(motion) && dialect_.name != DialectName::sinumerik;
  if (motion_ends_cycle || block.has(cycle_end)) code_.cycle = false;
  if (block.has(motion)) code_.tangent_arcs = false;
  code_.tangent_arcs |= block.begins_tangent_arcs;
  if (block.has(dwell)) {  // F is a time
    block.feed.reset();
    for (WordRange& word : line.words)
      if (word.role == WordRole::feed) word.role = WordRole::technology;
  }
  if (block.has(dimension)) code_.dimension_uncertain = block.to_skip;
  if (code_.dimension_uncertain && block.axis && !block.to_skip)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.axis,
                                  .detail = "a motion behind G90 or G91 that may be skipped"});
  if (block.to_skip && (block.has(unit) || block.has(plane)))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = line.words.front().begin,
                                  .detail = "a unit or a plane that may be skipped"});
  take_unit_of_old(line, block);
  forget_what_ends_nothing(block);
  const bool deletes_frames = block.has(frame) && !block.axis;
  if (deletes_frames && code_.unfollowed == scale_tenths) code_.unfollowed = -1;
  if (block.has(unfollowed) && block.of(unfollowed).function->tenths() == scale_tenths &&
      !block.axis) {
    code_.unfollowed = -1;
    block.forget |= all_axes;
    block.functions[static_cast<std::size_t>(unfollowed)] = {};
  }
  if (block.has(unfollowed)) code_.unfollowed = block.of(unfollowed).function->tenths();
  if (block.has(unfollowed_end)) code_.unfollowed = -1;
  if (dialect_.name == DialectName::sinumerik) {
    take_pole(block);
    if (!resolve_polar_words(line, block) || !take_soft_lead(line, block)) return false;
  }
  if (!take_fagor_words(line, block) || !take_modal_rounding(line, block)) return false;
  if (!check_code_selection(line, block) || !take_corner(line, block)) return false;
  const bool goes_on = copy_code_block(line, block);
  if (block.has(cycle)) code_.cycle = true;
  reads_plain_lines_ = !code_.cycle && code_.unfollowed < 0 && !code_.tangent_arcs &&
                       !code_.dimension_uncertain && code_.y_seen && faults_.empty() &&
                       code_.modal_rounding == 0 && !code_.soft_approach;
  return goes_on && take_tool_data(line, block);
}

// G70 and G71 alone are inch and mm of older controls; with words beside them they are cycles.
void Interpreter::take_unit_of_old(ProgramLine& line, BlockWords& block) const {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  const bool unit_of_old = block.of(single_move).is(70) || block.of(single_move).is(71);
  if (!unit_of_old || block.axis || block.center || block.tool_data || block.tool_data_number ||
      block.has(unit))
    return;
  for (WordRange& word : line.words)
    if (word.begin == found.begin) word.role = WordRole::mode;
  block.functions[static_cast<std::size_t>(unit)] = {
      .function = dialect_.function(found.is(70) ? 20 : 21), .begin = found.begin};
  found = {};
}

// G69, G50 and the like stand in the first line of many programs, where there is nothing to end.
void Interpreter::forget_what_ends_nothing(BlockWords& block) {
  const auto ends = [&](GGroup group, std::initializer_list<int> tenths) {
    return block.has(group) &&
           std::ranges::find(tenths, block.of(group).function->tenths()) != tenths.end();
  };
  if (block.has(unfollowed_end) && code_.unfollowed < 0)
    block.functions[static_cast<std::size_t>(unfollowed_end)] = {};
  if (ends(frame, {501, 690, 1000})) {
    if (!code_.turned && code_.unfollowed != 682) {
      // The axes of G50.1 and G100 are those that are mirrored no longer; with T beside it G100 is
      // a tool change that goes there.
      block.copied |= block.axis && !block.tool_number && !block.of(frame).is(69);
      block.functions[static_cast<std::size_t>(frame)] = {};
    }
    if (code_.unfollowed == 682) code_.unfollowed = -1;
    code_.turned = false;
  }
  code_.turned |= ends(frame, {511, 680, 1010});
}

// Decides whether the line is copied as it stands, and which axes it may move.
bool Interpreter::copy_code_block(ProgramLine& line, BlockWords& block) {
  const auto named_axes = [&] {
    AxisBits named = 0;
    for (std::size_t axis = 0; axis < block.move.end.size(); ++axis)
      if (block.move.end[axis]) named |= static_cast<AxisBits>(1U << axis);
    return named;
  };
  const bool moves = block.axis || block.center;
  const auto third = static_cast<AxisBits>(1U << axes_of(state_.mode().plane).third);
  const AxisBits named = named_axes();
  // G28 Z and G53 Z: the tool stays beside the contour, and the next line may end TRC.
  const bool leaves_across = dialect_.name == DialectName::fanuc && named == third &&
                             !block.center && !block.to_skip &&
                             (block.of(single_move).is(28) || block.of(single_move).is(30) ||
                              block.of(single_move).is(53));
  std::optional<std::uint32_t> begin;
  std::string meaning;
  const auto copy = [&](GGroup group, AxisBits forget) {
    if (!block.has(group)) return;
    block.copied = true;
    block.forget |= forget;
    if (group == single_move && leaves_across) return;
    begin = block.of(group).begin;
    meaning = block.of(group).function->meaning;
  };
  copy(single_move, named == 0 || block.of(single_move).is(1007) ? all_axes : named);
  copy(cycle, static_cast<AxisBits>(named | third));
  // Both controls: the axes named stand where the block says, the others where they stood.
  block.sets_position = block.has(frame) && block.of(frame).function->tenths() == 920 &&
                        block.axis && !incremental_ && !block.to_skip &&
                        !block.of(dimension).is(91);
  copy(frame, block.sets_position ? AxisBits{0} : all_axes);
  copy(tool_data, block.tool_data && (block.tool_data->value == 2 || block.tool_data->value == 20)
                      ? all_axes
                      : AxisBits{0});
  copy(unfollowed, all_axes);
  copy(unfollowed_end, all_axes);
  const auto copy_motion = [&](const char* why, AxisBits forget) {
    if (block.copied || !(moves || block.unfollowed_word) || block.has(dwell)) return;
    begin = std::min({block.axis.value_or(~0U), block.center.value_or(~0U),
                      block.unfollowed_word.value_or(~0U)});
    meaning = why;
    block.copied = true;
    block.forget |= forget;
  };
  if (code_.cycle)
    copy_motion("a position of a drilling cycle", static_cast<AxisBits>(named | third));
  if (code_.unfollowed >= 0) copy_motion("a position that is not followed", all_axes);
  if (block.axis && (block.of(axis_technology).is(5) || block.of(axis_technology).is(8)))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(axis_technology).begin,
                                  .detail = "G5 or G8 with axis words"});
  // A pole moves nothing, nor does it count from where the tool stands.
  if (block.of(axis_technology).is(111) || block.of(axis_technology).is(112)) {
    block.copied = true;
  } else if (block.axis) {
    copy(axis_technology, AxisBits{0});
  }
  if (block.unfollowed_word) copy_motion("CT, TURN=, AP=, RP=, ANG= or ,A", all_axes);
  if (code_.tangent_arcs) copy_motion("CT", named);
  const bool fanuc = dialect_.name == DialectName::fanuc;
  if (fanuc && block.tool_data) copy_motion("a motion with L, which is repeated", all_axes);
  if (block.to_skip) copy_motion("a motion that may be skipped", named);
  if (block.has(zero_shift) && !begin)
    begin = block.of(zero_shift).begin, meaning = "work coordinate system";
  if (block.to_skip && block.has(side))
    begin = block.of(side).begin, meaning = "TRC in a block that may be skipped";

  const MotionKind kind = block.has(motion)
                              ? motions[static_cast<std::size_t>(block.of(motion).function->number)]
                              : motion_;
  const bool circle = kind == MotionKind::clockwise || kind == MotionKind::counter_clockwise;
  if (dialect_.name == DialectName::linuxcnc && moves && circle && block.tool_data_number && !begin)
    begin = block.tool_data_number->begin, meaning = "P, the turns of an arc";

  // G40 beside G28 and the like ends TRC first.
  const bool active = trc_active() && !block.of(side).is(40);
  const bool selects_here = block.has(side) && !block.of(side).is(40);
  const bool may_be_skipped = block.to_skip && block.has(side) && (selects_here || contour_open());
  if (begin && (active || (selects_here && block.copied) || may_be_skipped))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *begin,
                                  .detail = meaning.append(" while TRC is active")});
  if (!block.copied) return true;
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate || word.role == WordRole::trc)
      word.role = WordRole::technology;
  return true;
}

// With R beside them G36 to G39 are those of Fagor: a rounding, a tangential entry and exit, a
// chamfer. Elsewhere they measure, or have no R.
bool Interpreter::take_fagor_words(ProgramLine& line, BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  if (dialect_.name != DialectName::fanuc || found.function == nullptr || !block.move.radius)
    return true;
  const int number = found.function->number;
  if (number < 36 || number > 39) return true;
  if (number == 37 || number == 38) {
    const bool selects = block.has(side) && !block.of(side).is(40);
    if (!trc_active() && !selects) return true;
    return refuse(
        line,
        TextFault{.code = Code::nc_unsupported,
                  .begin = found.begin,
                  .detail = number == 37 ? "G37 R, a tangential entry: program its line and arc"
                                         : "G38 R, a tangential exit: program its arc and line"});
  }
  block.corner = found.begin;
  block.move.corner = {.form = number == 36 ? CornerCut::Form::round : CornerCut::Form::leg,
                       .size = *block.move.radius};
  block.move.radius.reset();
  const bool in_contour = trc_active() && !block.has(side);
  block.center.reset();
  for (WordRange& word : line.words) {
    const char letter = line.text[word.begin];
    if (word.role == WordRole::coordinate && (letter == 'R' || letter == 'r'))
      word.role = in_contour ? WordRole::trc : WordRole::technology;
    const bool is_center = letter >= 'I' && letter <= 'K';
    if (word.role == WordRole::coordinate && (is_center || (letter >= 'i' && letter <= 'k')) &&
        !block.center)
      block.center = word.begin;
  }
  found = {};
  return true;
}

// RNDM= rounds every corner. What the control would round in the output too must not be modal
// there, so that it begins and ends within the contour.
bool Interpreter::take_modal_rounding(ProgramLine& line, BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  const bool ends = block.of(side).is(40) && trc_active();
  if (block.modal_rounding) {
    code_.modal_rounding = block.modal_rounding->value * length_unit();
    if (trc_active() || selects)
      for (WordRange& word : line.words)
        if (word.begin == block.modal_rounding->begin) word.role = WordRole::trc;
  }
  const bool from_outside = selects && !trc_active() && !block.modal_rounding;
  if (code_.modal_rounding != 0 && (from_outside || ends))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(side).begin,
                                  .detail = "RNDM= beyond the contour: set it behind G41, G42, and "
                                            "to 0 in front of G40"});
  if (code_.modal_rounding != 0 && trc_active() && !selects && (block.axis || block.center) &&
      !block.corner && !block.copied)
    block.move.corner = {.form = CornerCut::Form::round,
                         .size = code_.modal_rounding / length_unit(),
                         .modal = true};
  return true;
}

// While TRC is active the corner becomes blocks of its own, and its word is not written. Else the
// control makes it.
bool Interpreter::take_corner(ProgramLine& line, BlockWords& block) {
  if (!block.corner) return true;
  if (!contour_open() && !block.has(side)) {
    block.move.corner.reset();
    return true;
  }
  const bool nothing_else = trc_active() && !block.has(side) && block.axis;
  if (!nothing_else || !(block.move.corner->size >= 0))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.corner,
                                  .detail = "a rounding or a chamfer beside G40 … G42, or behind "
                                            "a motion that is none"});
  if (block.move.corner->size == 0) block.move.corner.reset();
  for (WordRange& word : line.words)
    if (word.begin == *block.corner) word.role = WordRole::trc;
  return true;
}

// What G41 and G42 need, and D words.
bool Interpreter::check_code_selection(ProgramLine& line, BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  const auto wrong = [&](Code code, std::string detail) {
    return refuse(
        line, TextFault{.code = code, .begin = block.of(side).begin, .detail = std::move(detail)});
  };
  if (selects && code_.unfollowed >= 0)
    return wrong(Code::nc_unsupported,
                 "TRC while coordinates are not followed (polar, scaled or tilted)");
  if (dialect_.name == DialectName::sinumerik && !choose_tool_of_edge(line, block)) return false;
  // Only lathes work without Y.
  const bool turns = code_.turning && !code_.y_seen;
  if (selects && turns) return wrong(Code::turning, "G41, G42 of a lathe");
  if (trc_active() && !code_.y_seen && state_.mode().plane == Plane::xy && block.move.end[0] &&
      block.move.end[2])
    return refuse(line, TextFault{.code = Code::turning,
                                  .begin = *block.axis,
                                  .detail = "a contour of X and Z in the plane X Y"});
  const bool fanuc = dialect_.name == DialectName::fanuc;
  if (fanuc && selects && block.tool_data_number)
    return wrong(Code::nc_unsupported, "G41, G42 with a radius in P");
  // Older controls have one table for lengths and radii, with H words for both.
  if (fanuc && selects && !block.tool && block.offset && !has_length_offset(line))
    block.tool = block.offset;
  if (selects && block.of(side).function->tenth != 0) {
    if (!block.tool) return wrong(Code::nc_number, "G41.1, G42.1 without D, the diameter");
    block.tool_radius = {.value = block.tool->value / 2, .begin = block.tool->begin};
    block.tool.reset();
  } else if (selects && dialect_.tool_of_spindle && !block.tool &&
             (code_.spindle_tool != 0 || code_.spindle_empty)) {
    block.tool = {.value = static_cast<double>(code_.spindle_tool), .begin = block.of(side).begin};
  }
  if (selects && !block.tool && !block.tool_radius && code_.missing_tool >= 0)
    return wrong(Code::tool_unknown, "D" + std::to_string(code_.missing_tool));
  if (!block.tool && !block.tool_radius) return true;
  if ((selects || trc_active()) && dialect_.name != DialectName::sinumerik)
    for (WordRange& word : line.words)
      if (line.text[word.begin] == 'D' || line.text[word.begin] == 'd') word.role = WordRole::trc;
  if (!block.tool) return true;
  const std::int64_t number = whole_number(block.tool->value);
  code_.missing_tool = -1;
  if (!is_whole(block.tool->value))
    return refuse(line,
                  TextFault{.code = Code::nc_number, .begin = block.tool->begin, .detail = "D"});
  if (state_.tool().has_tool(number)) return true;
  const bool one_radius = state_.setup().tools.empty() && state_.setup().mode.tool_radius != 0;
  if (one_radius && (!selects || code_.only_register.value_or(number) == number)) {
    // The radius of the setup stands for the one register that the program selects with.
    if (selects) code_.only_register = number;
    block.tool.reset();
    return true;
  }
  if (!selects && !trc_active()) {
    // H and D stand side by side in many programs: it matters only where G41 has no D of its own.
    code_.missing_tool = number;
    block.tool.reset();
    return true;
  }
  return refuse(line, TextFault{.code = Code::tool_unknown,
                                .begin = block.tool->begin,
                                .detail = "D" + std::to_string(number)});
}

// Sinumerik: T is the tool, D its edge; D0 is none.
bool Interpreter::choose_tool_of_edge(ProgramLine& line, BlockWords& block) {
  // A tool change chooses the first one.
  if (block.tool || block.tool_number) code_.edge = block.tool ? block.tool->value : 1;
  block.tool.reset();
  const bool selects = block.has(side) && !block.of(side).is(40);
  if (!selects) return true;
  const std::uint32_t begin = block.of(side).begin;
  if (code_.edge == 0) {
    block.tool = {.value = 0, .begin = begin};
    return true;
  }
  const std::int64_t number = code_.changes_by_m6 ? code_.spindle_tool : code_.next_tool;
  const auto unknown = [&](std::string detail) {
    return refuse(
        line, TextFault{.code = Code::tool_unknown, .begin = begin, .detail = std::move(detail)});
  };
  const bool table = !state_.setup().tools.empty();
  const std::int64_t edge = whole_number(code_.edge);
  const std::int64_t row = row_of_edge(number, edge);
  if (table && number == no_tool_number) return unknown(name_not_in_table(code_.tool_name));
  const bool is_plain = edge == 1 && code_.tool_name.empty();
  if (table && !is_plain && !state_.tool().has_tool(row))
    return unknown("D" + std::to_string(edge) + " of " +
                   (code_.tool_name.empty() ? "T" + std::to_string(number) : code_.tool_name));
  if (number == no_tool_number) {
    // The radius of the setup stands for the one tool that the program selects with.
    if (code_.only_tool_name.empty()) code_.only_tool_name = code_.tool_name;
    return code_.only_tool_name == code_.tool_name || unknown(code_.tool_name);
  }
  if (number != 0)
    block.tool = {.value = static_cast<double>(table ? row : number), .begin = begin};
  return true;
}

// With the name of the table that it is a slip of, if there is one.
std::string Interpreter::name_not_in_table(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& [known, tool] : state_.setup().tool_names) names.push_back(known);
  const auto meant = likely_meant(in_upper_case(name), names);
  return meant ? name + ", the table has " + *meant : name;
}

// G10 L12 P R of Fanuc, G10 L1 P R of LinuxCNC: the program gives a tool its radius.
bool Interpreter::take_tool_data(ProgramLine& line, BlockWords& block) {
  // Controls with one table for lengths and radii have no L word.
  if (!block.has(tool_data) || (!block.tool_data && !block.tool_data_number)) return true;
  const std::int64_t data = block.tool_data ? whole_number(block.tool_data->value) : 12;
  const bool linuxcnc = dialect_.name == DialectName::linuxcnc;
  const bool radius_data =
      linuxcnc ? data == 1 || data == 10 || data == 11 : data == 12 || data == 13;
  if (!radius_data || !block.move.radius) return true;
  if (data == 13 && *block.move.radius == 0) return true;
  if (data != (linuxcnc ? 1 : 12) || !block.tool_data_number || incremental_)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(tool_data).begin,
                                  .detail = "G10 L" + std::to_string(data) +
                                            ", wear or a sum of a tool radius"});
  if (!faults_.empty()) return true;
  const bool inch = block.has(unit) ? counts_in_inch(*block.of(unit).function) : inch_;
  state_.define_tool(whole_number(block.tool_data_number->value),
                     *block.move.radius * (inch ? mm_per_inch : 1));
  return true;
}

}  // namespace trc
