#include "core/nc/dialect/isg_block.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/base/length_unit.h"
#include "core/base/reasons.h"
#include "core/nc/dialect/gcode_block.h"
#include "core/nc/dialect/gcode_tools.h"
#include "core/nc/dialect/isg_block_words.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/passing_calls.h"
#include "core/nc/dialect/tool_data.h"
#include "core/nc/dialect/turning.h"
#include "core/nc/dialect/unfollowed.h"

namespace trc {
namespace {

// Roundings and chamfers pass while TRC is off: they cut a corner and leave the ends of the blocks
// beside it. Beside a contour they are refused (D-92, D-173).
bool take_isg_corner(Reading& reading, ProgramLine& line, BlockWords& block) {
  WordPlace& open = reading.gcode.corners.open;
  if (block.selects() && open.source.line > 0)
    return reading.refuse_at(open, Code::nc_unsupported,
                             "a rounding or a chamfer before the motion that selects TRC");
  const bool is_corner = !block.isg.corner.empty();
  const auto refused = [&](std::string_view why) {
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = block.isg.corner_begin,
                                          .detail = block.isg.corner + std::string(why)});
  };
  if (is_corner && (reading.contour_open() || block.has(GGroup::side))) return refused("");
  if (is_corner && block.isg.corner_has_i_word) {
    if (block.axis) return refused(reason::with_axis_words);
    block.center.reset();
    block.move.center = {};
    take_for_technology(line, WordRole::coordinate);
  }
  if (open.source.line > 0 && (block.axis || block.center)) {
    open = {};
    read_plain_lines_again(reading);
  }
  if (is_corner) {
    open = reading.place_of_word(line, block.isg.corner_begin);
    reading.reads_plain_lines = false;
  }
  return true;
}

// G130 X80: the axis words are percentages, and nothing moves (D-182).
bool take_axis_weights(Reading& reading, ProgramLine& line, BlockWords& block) {
  using enum GGroup;
  if (!block.isg.weights || !(block.axis || block.center)) return true;
  const bool other_function = block.has(motion) || block.has(side) || block.has(dwell) ||
                              block.has(zero_shift) || block.has(single_move) ||
                              !block.isg.corner.empty() || block.isg.suppresses ||
                              block.isg.passed_function;
  if (other_function || block.center)
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.isg.weights,
                                    .detail = word_to_pass(line.text, *block.isg.weights)
                                                  .append(reason::percentages_beside_a_motion)});
  block.axis.reset();
  block.move.end = {};
  block.move.tracking.clear();
  take_for_technology(line, WordRole::coordinate);
  return true;
}

// #SUPPRESS OFFSETS X50: the block leads to a place in the coordinates of the machine (D-183).
bool copy_without_offsets(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (!block.isg.suppresses) return true;
  const bool active = reading.contour_open();
  if (active || block.selects())
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = *block.isg.suppresses,
                                          .detail = active ? "#SUPPRESS OFFSETS while TRC is active"
                                                           : "TRC beside #SUPPRESS OFFSETS"});
  block.copied = true;
  block.forget |= block.named_axes();
  take_for_technology(line, WordRole::coordinate);
  take_for_technology(line, WordRole::trc);
  return true;
}

// Words that may not stand in one block, or look like those of another dialect.
bool check_isg_words(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  const auto wrong = [&](Code code, const BlockWords::Function& function, std::string_view why) {
    return reading.refuse(
        line,
        TextFault{.code = code, .begin = function.begin, .detail = named(*function.function, why)});
  };
  if (block.isg.passed_function && (block.axis || block.center))
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.isg.passed_function,
                                    .detail = word_to_pass(line.text, *block.isg.passed_function)
                                                  .append(reason::with_axis_words)});
  const bool main_axis_only = std::ranges::none_of(
      block.move.tracking, [](const auto& value) { return value.has_value(); });
  if (block.has(dwell)) {
    const bool time =
        block.isg.number_alone || block.isg.has_spindle || (block.axis && main_axis_only);
    if (block.words > 2 || (block.words == 2 && !time))
      return wrong(Code::nc_syntax, block.of(dwell), " is not alone with its time");
    if (block.words < 2) return wrong(Code::nc_number, block.of(dwell), " without a time");
  }
  if (block.has(axis_technology) && (block.axis || block.center))
    return wrong(Code::nc_unsupported, block.of(axis_technology), reason::with_axis_words);
  if (block.has(tangential) && !block.has(side))
    return wrong(Code::nc_syntax, block.of(tangential), " without G40, G41 or G42");
  if (!reading.isg_word_seen && !reading.contour_open() && block.axis && !block.has(motion) &&
      !block.has(side)) {
    // In other dialects these are working area limits and a local zero point, not positions.
    if (block.has(transition))
      return wrong(Code::other_dialect, block.of(transition), reason::with_axis_words);
    const auto g52 = std::ranges::find_if(line.words, [&](const WordRange& range) {
      return line.word(range) == "G52" || line.word(range) == "g52";
    });
    if (g52 != line.words.end())
      return reading.refuse(
          line, TextFault{.code = Code::other_dialect,
                          .begin = g52->begin,
                          .detail = std::string("G52").append(reason::with_axis_words)});
  }
  return true;
}

}  // namespace

bool check_isg_block(Reading& reading, ProgramLine& line, BlockWords& block) {
  using enum GGroup;
  if (!take_axis_weights(reading, line, block) || !copy_without_offsets(reading, line, block) ||
      !check_isg_words(reading, line, block))
    return false;
  // The retract of a mill may lift it.
  const AxisBits retracting = block.deselects() ? main_axis_bit(2) : AxisBits{0};
  note_axes(reading, static_cast<AxisBits>(block.named_axes() & ~retracting));
  if (!check_turning_of_isg(reading, line, block)) return false;
  if (!watch_tool(reading, line, block) || !restate_modes(reading, line, block) ||
      !note_unknown_call(reading, line, block))
    return false;
  if (const std::int64_t number =
          block.tools.d_word ? register_number(block.tools.d_word->value) : 0;
      !reading.state.tool().has_tool(number))
    take_only_register(reading, line, block, number);
  if (block.isg.homes) {  // afterwards only the machine knows where the axes are
    block.copied = true;
    take_for_technology(line, WordRole::coordinate);
  }
  take_work_offset(reading, block);
  if (!take_isg_corner(reading, line, block)) return false;
  take_contour_of_cycle(reading, line, block);
  if (!copy_thread(reading, line, block)) return false;
  const bool preset = block.of(zero_shift).is(92);
  if (preset && (block.has(motion) || block.center || block.move.radius))
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.of(zero_shift).begin,
                        .detail = named(*block.of(zero_shift).function, " with a motion")});
  return check_feed(reading, line, block) && take_tool_data(reading, line, block);
}

bool check_feed(Reading& reading, ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  const bool preset = block.of(zero_shift).is(92);
  const int feed = block.has(feed_mode) ? block.of(feed_mode).function->number : reading.feed_mode;
  const LengthUnit lengths =
      block.has(unit) ? reading.unit_of(*block.of(unit).function) : reading.unit;
  if (block.feed && feed == 94 &&
      !reading.state.is_feed(block.feed->value * reading.feed_unit(lengths))) {
    const auto word = std::ranges::find(line.words, block.feed->begin, &WordRange::begin);
    const std::uint32_t end = word == line.words.end() ? block.feed->begin + 1 : word->end;
    return reading.refuse(
        line, TextFault{.code = Code::nc_number,
                        .begin = block.feed->begin,
                        .detail = line.text.substr(block.feed->begin, end - block.feed->begin) +
                                  ", more than 0 and at most 1000000000 mm/min"});
  }
  for (WordRange& range : line.words) {
    const bool no_position = range.role == WordRole::coordinate && (preset || block.has(dwell));
    const bool no_feed = range.role == WordRole::feed && feed != 94;
    if (no_position || no_feed) range.role = WordRole::technology;
  }
  return true;
}

}  // namespace trc
