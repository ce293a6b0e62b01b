#include "core/nc/dialect/turning.h"

#include <algorithm>
#include <string>

// Programs of lathes: only these work without Y (D-105).

namespace trc {
namespace {

using enum GGroup;

constexpr std::string_view of_a_lathe = "G41, G42 of a lathe";
constexpr std::string_view of_x_and_z = "a contour of X and Z in the plane X Y";

bool refuse_turning(Reading& reading, const ProgramLine& line, std::uint32_t begin,
                    std::string_view detail) {
  return reading.refuse(
      line, TextFault{.code = Code::turning, .begin = begin, .detail = std::string(detail)});
}

// A mill may come down after G41, before the approach.
bool comes_down(const Reading& reading, bool moves_x) {
  return !moves_x && (!reading.faults.empty() || reading.state.awaits_approach());
}

}  // namespace

bool is_turning_tool(std::string_view word) {
  return word.size() == 5 && word.substr(1) != "0000" && word.substr(1, 2) == word.substr(3);
}

bool check_turning(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (std::ranges::find(reading.faults, Code::turning, &Reading::Fault::code) !=
      reading.faults.end())
    return true;  // one cause is told once
  const bool selects = block.selects();
  if (selects && reading.gcode.seen.lathe && !reading.gcode.seen.y)
    return refuse_turning(reading, line, block.of(side).begin, of_a_lathe);
  const bool in_zx =
      block.has(plane) ? block.of(plane).is(18) : reading.state.programmed_plane() == Plane::zx;
  const bool leads_in_zx = in_zx || (block.move.end[0] && block.move.end[2]);
  if (selects && !reading.gcode.seen.y && leads_in_zx)
    return refuse_turning(reading, line, block.of(side).begin,
                          "G41, G42 of a lathe, because no Y precedes it");
  if (reading.trc_active() && !reading.gcode.seen.y && reading.state.mode().plane == Plane::xy &&
      block.move.end[2] && !comes_down(reading, block.move.end[0].has_value()))
    return refuse_turning(reading, line, *block.axis, of_x_and_z);
  return true;
}

bool check_turning_of_isg(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (block.selects() && reading.gcode.seen.lathe && !reading.gcode.seen.y)
    return refuse_turning(reading, line, block.of(side).begin, of_a_lathe);
  if (!block.deselects() || !reading.trc_active() || reading.gcode.seen.y) return true;
  return !reading.gcode.seen.z_in_contour ||
         refuse_turning(reading, line, block.of(side).begin, of_x_and_z);
}

void note_axes(Reading& reading, AxisBits axes) {
  GcodeModes::Seen& seen = reading.gcode.seen;
  if (seen.y) return;
  seen.y = (axes & main_axis_bit(1)) != 0;
  if (!reading.trc_active())
    seen.z_in_contour = false;
  else if ((axes & main_axis_bit(2)) != 0 && reading.state.mode().plane == Plane::xy)
    seen.z_in_contour |= !comes_down(reading, (axes & main_axis_bit(0)) != 0);
}

}  // namespace trc
