#include "core/trc/passes/contour_violations.h"

#include <cmath>
#include <numbers>

#include "core/geometry/parallel.h"

namespace trc {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

}  // namespace

bool ContourViolations::apply(PathBlock& block) {
  if (block.role == Role::passive || block.role == Role::uncompensated) return true;
  if (block.role == Role::contour && !block.masked) {
    const auto* arc = std::get_if<Arc>(&block.programmed.path);
    if (!(arc != nullptr ? check_arc(block, *arc) : check_line(block))) return false;
  }
  return check_range(block);
}

bool ContourViolations::check_line(const PathBlock& block) {
  const Vector travelled = end_of(block.tool_path) - start_of(block.tool_path);
  return !runs_back(travelled, block.tangent_at_end, tolerances_) ||
         report_reversed(block, travelled.dot(block.tangent_at_end));
}

// Also called if the offsets do not meet (D-147).
bool ContourViolations::report_reversed(const PathBlock& block, double along) {
  Diagnostic violation = diagnostic(Code::line_reversed, block.programmed.source);
  violation.values = {{"programmed_length", length_of(block.programmed.path)},
                      {"compensated_length", along},
                      {"tool_radius", block.mode().cutting_radius(std::abs(block.at_end.shift))}};
  return report(std::move(violation), block);
}

bool ContourViolations::check_arc(const PathBlock& block, const Arc& programmed) {
  const double sweep = std::abs(programmed.sweep);
  const double left = sweep - block.cut_at_start - block.cut_at_end;
  return !is_consumed(left, parallel_radius(programmed, block.at_end.shift), tolerances_) ||
         report_wrapped(block, left, sweep);
}

bool ContourViolations::report_wrapped(const PathBlock& block, double left, double sweep) {
  Diagnostic violation = diagnostic(Code::arc_wrapped, block.programmed.source);
  violation.values = {{"corrected_sweep", (left + 2 * std::numbers::pi) * degrees},
                      {"largest_sweep", sweep * degrees},
                      {"tool_radius", block.mode().cutting_radius(std::abs(block.at_end.shift))}};
  return report(std::move(violation), block);
}

bool ContourViolations::check_range(const PathBlock& block) {
  const std::optional<Code> problem = out_of_range(block.tool_path, tolerances_);
  return !problem || report_out_of_range(block, *problem);
}

bool ContourViolations::report_out_of_range(const PathBlock& block, Code code) {
  Diagnostic problem = diagnostic(code, block.programmed.source);
  problem.values = {{"largest_coordinate", tolerances_.largest_coordinate}};
  return diagnostics_.report(std::move(problem));
}

bool ContourViolations::report(Diagnostic violation, const PathBlock& block) {
  const Position place =
      from_plane(block.mode().plane, start_of(block.tool_path), block.programmed.normal.from);
  violation.point = DiagnosticPoint{.x = place[0], .y = place[1], .z = place[2]};
  if (block.half_slot > 0)
    violation.values.push_back({"slot_width", 2 * block.mode().cutting_radius(block.half_slot)});
  else if (block.largest_radius > 0)
    violation.values.push_back(
        {"largest_radius", block.mode().cutting_radius(block.largest_radius)});
  if (block.mode().options.ignore_cont_damage) violation.severity = Severity::warning;
  return diagnostics_.report(std::move(violation));
}

}  // namespace trc
