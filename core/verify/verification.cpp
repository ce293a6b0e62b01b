#include "core/verify/verification.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

namespace trc::verify {
namespace {

Diagnostic gouge(const ClearanceReport& found) {
  const Clearance& worst = *found.worst;
  Diagnostic problem = diagnostic(Code::clearance_violated, worst.path);
  if (found.gouging == found.accepted) problem.severity = Severity::warning;
  problem.values = {{"clearance", worst.distance},
                    {"tool_radius", worst.required},
                    {"blocks", static_cast<double>(found.gouging)}};
  append_place(problem.values, "other", worst.contour);
  problem.point = DiagnosticPoint{.x = worst.place[0], .y = worst.place[1], .z = worst.place[2]};
  return problem;
}

}  // namespace

void Verification::programmed(const Block& block) {
  const auto* motion = std::get_if<MotionBlock>(&block);
  if (motion == nullptr) return;
  if (motion->mode->active()) {
    programmed_.push_back(*motion);
  } else if (!programmed_.empty() &&
             (ends_.empty() || ends_.back() < index_of(programmed_.back()))) {
    ends_.push_back(motion->source.index);
  }
}

bool Verification::compensated(std::span<const CompensatedBlock> path) {
  for (const CompensatedBlock& block : path) {
    if (!ends_.empty() && block.source.index >= ends_.front()) {
      const std::uint64_t end = ends_.front();
      ends_.pop_front();
      if (!measure_before(end)) return false;
    }
    if (!programmed_.empty()) path_.push_back(block);
  }
  return true;
}

bool Verification::finish() { return measure_before(std::numeric_limits<std::uint64_t>::max()); }

bool Verification::measure_before(std::uint64_t end) {
  const auto behind =
      std::partition_point(programmed_.begin(), programmed_.end(),
                           [&](const Block& motion) { return index_of(motion) < end; });
  const ClearanceReport found =
      measure_clearance({programmed_.begin(), behind}, path_, allowed_, leads_);
  programmed_.erase(programmed_.begin(), behind);
  path_.clear();
  report_.checked += found.checked;
  report_.gouging += found.gouging;
  report_.accepted += found.accepted;
  report_.wall_length += found.wall_length;
  report_.touched_length += found.touched_length;
  if (!found.worst) return true;
  if (!report_.worst || found.worst->margin() < report_.worst->margin())
    report_.worst = found.worst;
  return found.gouging == 0 || diagnostics_.report(gouge(found));
}

}  // namespace trc::verify
