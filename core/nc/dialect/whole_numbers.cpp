#include "core/nc/dialect/whole_numbers.h"

#include <bit>
#include <cmath>
#include <string>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"

// Numbers of Fanuc without a decimal point: millimetres on some controls, thousandths on others
// (D-50).

namespace trc {
namespace {

constexpr double increment_mm = 0.001;  // degrees too
constexpr double increment_inch = 0.0001;
constexpr double feed_increment_inch = 0.01;  // F10 is 0.1 in/min; in mm, F10 is 10 mm/min
constexpr double longest_travel = 10'000;     // mm, of a milling machine

constexpr double largest_tool = 50;  // mm; a radius, in increments that of a tool of 0.05 mm

// G10 L12 and L13: a radius that increments would make a usual one, or any wear.
bool is_doubtful_tool_data(const BlockWords& block, double in_mm) {
  if (!block.move.radius || (!block.l_word && !block.p_word)) return false;
  const double data = block.l_word ? block.l_word->value : 12;
  const double size = std::abs(*block.move.radius) * in_mm;
  return data == 13 ? size != 0 : data == 12 && size >= largest_tool;
}

std::uint32_t begin_of_radius(const ProgramLine& line, const BlockWords& block) {
  for (const WordRange& word : line.words)
    if (upper(line.text[word.begin]) == 'R') return word.begin;
  return block.of(GGroup::tool_data).begin;
}

bool turns(std::string_view axis) {
  return axis.empty() || std::string_view("UVWXYZ").find(axis[0]) == std::string_view::npos;
}

}  // namespace

bool count_whole_numbers(Reading& reading, ProgramLine& line, BlockWords& block) {
  const WholeNumbers rule = reading.state.setup().whole_numbers;
  if (rule == WholeNumbers::units) return true;
  const LengthUnit unit =
      block.has(GGroup::unit) ? reading.unit_of(*block.of(GGroup::unit).function) : reading.unit;
  MoveRequest& move = block.move;
  const auto is_whole = [&](std::size_t bit) { return bit < 64 && (block.whole >> bit & 1) != 0; };
  if (rule == WholeNumbers::unsaid) {
    const double in_mm = mm_of(unit);
    if (block.has(GGroup::tool_data) && is_whole(WholeWord::radius) &&
        is_doubtful_tool_data(block, in_mm))
      return reading.refuse(
          line, TextFault{.code = Code::nc_number,
                          .begin = begin_of_radius(line, block),
                          .detail = std::string(block.l_word && block.l_word->value == 13
                                                    ? "a wear"
                                                    : "a tool radius")
                                        .append(" without a decimal point: say what whole "
                                                "numbers count in")});
    for (const GGroup group :
         {GGroup::tool_data, GGroup::frame, GGroup::single_move, GGroup::axis_technology})
      if (block.has(group)) return true;  // no positions of the program
    for (std::size_t axis = 0; axis < move.end.size(); ++axis)
      if (move.end[axis] && is_whole(WholeWord::axis + axis) && !reading.gcode.seen.points &&
          std::abs(*move.end[axis]) * in_mm >= longest_travel)
        return reading.refuse(
            line, TextFault{.code = Code::nc_number,
                            .begin = *block.axis,
                            .detail = "a place metres away without a decimal point: say "
                                      "what whole numbers count in"});
    return true;
  }
  const double length = unit == LengthUnit::inch ? increment_inch : increment_mm;
  const auto scale = [&](auto& value, std::size_t bit, double increment) {
    if (value && is_whole(bit)) *value *= increment;
  };
  for (std::size_t axis = 0; axis < move.end.size(); ++axis) {
    scale(move.end[axis], WholeWord::axis + axis, length);
    scale(move.center[axis], WholeWord::center + axis, length);
  }
  scale(move.radius, WholeWord::radius, length);
  if (move.corner && is_whole(WholeWord::corner)) move.corner->size *= length;
  const auto& names = reading.state.setup().tracking_axes;
  for (std::size_t axis = 0; axis < move.tracking.size(); ++axis)
    scale(move.tracking[axis], WholeWord::tracking + axis,
          turns(names[axis]) ? increment_mm : length);
  const int feed = block.has(GGroup::feed_mode) ? block.of(GGroup::feed_mode).function->number
                                                : reading.feed_mode;
  if (unit == LengthUnit::inch && feed == 94 && block.feed && is_whole(WholeWord::feed))
    block.feed->value *= feed_increment_inch;
  return true;
}

}  // namespace trc
