#include "core/verify/verification.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/reasons.h"
#include "core/base/tolerances.h"
#include "core/trc/result/selection_limit.h"
#include "core/verify/closing_corner.h"

namespace trc::verify {
namespace {

// No way in is looked for on a longer contour.
constexpr std::size_t most_blocks_helped = 1000;

// Without the place on the contour, which the caller adds as the last value.
Diagnostic too_near(Code code, const Clearance& place) {
  Diagnostic problem = diagnostic(code, place.path);
  problem.values = {{"clearance", place.distance}, {"tool_radius", place.required}};
  problem.point = DiagnosticPoint{.x = place.place[0], .y = place.place[1], .z = place.place[2]};
  return problem;
}

Diagnostic gouge(const ClearanceReport& found) {
  Diagnostic problem = too_near(Code::clearance_violated, *found.gouge);
  problem.values.push_back({"blocks", static_cast<double>(found.gouging)});
  append_place(problem.values, "other", found.gouge->contour);
  return problem;
}

Diagnostic crossing(const CrossedWall& crossed) {
  Diagnostic problem = diagnostic(Code::way_crosses_contour, crossed.way);
  problem.point =
      DiagnosticPoint{.x = crossed.place[0], .y = crossed.place[1], .z = crossed.place[2]};
  append_place(problem.values, "other", crossed.wall);
  return problem;
}

std::string_view reason_at(ClosingCorner corner) {
  switch (corner) {
    case ClosingCorner::none:
      break;
    case ClosingCorner::inside:
      return reason::closes_in_inside_corner;
    case ClosingCorner::other_side:
      return reason::comes_from_other_side;
  }
  return {};
}

// A warning if the contour does not quite close, and the path comes nearer there by more than
// rounding explains. It stops nothing, however gouges are reported (D-101).
std::optional<Diagnostic> open_closing(const ClearanceReport& found, const Tolerances& tolerances) {
  if (found.gouging > 0 || !found.worst || found.worst->margin() >= -tolerances.on_top)
    return std::nullopt;
  Diagnostic warning = too_near(Code::bottleneck, *found.worst);
  warning.severity = Severity::warning;
  append_place(warning.values, "other", found.worst->contour);
  return warning;
}

}  // namespace

std::size_t Verification::held_only(std::span<const Block> blocks) const {
  if (!ends_.empty() || is_untold_) return 0;
  bool holds = !held_.programmed().empty();
  std::size_t room =
      setup_.selection_blocks - std::min(setup_.selection_blocks, held_.programmed().size());
  std::size_t count = 0;
  for (const Block& block : blocks) {
    if (const auto* motion = std::get_if<MotionBlock>(&block)) {
      if (motion->mode->active() ? room-- == 0 : holds) break;
      holds = holds || motion->mode->active();
    }
    ++count;
  }
  return count;
}

bool Verification::programmed(const Block& block) {
  const auto* motion = std::get_if<MotionBlock>(&block);
  if (motion == nullptr) return true;
  const auto& programmed = held_.programmed();
  if (!motion->mode->active()) {
    if (!programmed.empty() && (ends_.empty() || is_before(ends_.back(), programmed.back().source)))
      ends_.push_back(motion->source);
    return true;
  }
  if (motion->mode->selection_number == too_long_) return true;
  if (programmed.size() < setup_.selection_blocks) {
    const bool begins = programmed.empty() || held_.rule_of(programmed.back()).selection !=
                                                  motion->mode->selection_number;
    if (begins) approaches_.push_back(*motion);
    held_.add(*motion);
    return true;
  }
  too_long_ = motion->mode->selection_number;
  held_ = MeasuredPath();
  approaches_.clear();
  unmeasured_ = motion->source;
  is_untold_ = true;
  return setup_.verify == Verify::report || tell_unmeasured();
}

bool Verification::tell_unmeasured() {
  if (!std::exchange(is_untold_, false)) return true;
  Diagnostic problem = selection_too_long(unmeasured_, setup_.selection_blocks);
  problem.detail = "the path beside it is not measured";
  return tell(std::move(problem));
}

bool Verification::compensated(std::span<const CompensatedBlock> path) {
  for (const CompensatedBlock& block : path) {
    if (is_untold_ && block.source.index >= unmeasured_.index && !tell_unmeasured()) return false;
    // A retract stems from the block after its selection, but belongs to the selection.
    const bool leads_away = block.origin == Origin::retract;
    if (leads_away) held_.add(block);
    if (!ends_.empty() && !is_before(block.source, ends_.front())) {
      const Source end = ends_.front();
      ends_.pop_front();
      if (!measure_before(end)) return false;
    }
    if (!leads_away) held_.add(block);
  }
  return true;
}

bool Verification::finish() {
  if (!tell_unmeasured()) return false;
  return measure_before({.index = std::numeric_limits<std::uint64_t>::max()});
}

bool Verification::measure_before(const Source& end) {
  const std::size_t behind = held_.first_from(end);
  const ClearanceReport found = measure_clearance(held_, behind, setup_.clearance, checkpoint_);
  report_.add(found);
  if (auto warning = open_closing(found, setup_.clearance.tolerances))
    diagnostics_.report(std::move(*warning));
  std::vector<Diagnostic> problems;
  for (const CrossedWall& crossed : found.crossed) problems.push_back(crossing(crossed));
  if (found.gouging > 0) {
    Diagnostic& problem = problems.emplace_back(gouge(found));
    if (const auto way = way_that_closes_at(*found.gouge)) {
      problem.detail =
          reason_at(closing_corner(*way, setup_.clearance.tolerances.input_resolution));
      if (setup_.help) problem.entry_help = setup_.help(*way);
    }
  }
  held_.forget_before(behind);
  const auto& programmed = held_.programmed();
  while (!approaches_.empty() &&
         (programmed.empty() ||
          approaches_.front().source.index < programmed[programmed.begin()].source.index))
    approaches_.pop_front();
  std::ranges::stable_sort(problems, {}, [](const Diagnostic& one) { return one.source.index; });
  return std::ranges::all_of(problems, [&](Diagnostic& one) { return tell(std::move(one)); });
}

std::optional<RefusedWay> Verification::way_that_closes_at(const Clearance& worst) const {
  const auto& programmed = held_.programmed();
  const auto approach =
      std::find_if(approaches_.rbegin(), approaches_.rend(),
                   [&](const MotionBlock& block) { return block.source.index < worst.path.index; });
  if (approach == approaches_.rend()) return std::nullopt;
  const std::size_t begin = held_.first_from(approach->source);
  const std::uint32_t rule = programmed[begin].rule;
  const Rule& at_begin = held_.rule_of(programmed[begin]);
  RefusedWay way{.kind = WayBesideCorner{}};
  way.blocks.push_back(*approach);
  way.shift = at_begin.side == Side::left ? at_begin.radius : -at_begin.radius;
  for (std::size_t place = begin + 1; place < programmed.end(); ++place) {
    const ProgrammedPiece& piece = programmed[place];
    if (held_.rule_of(piece).selection != approach->mode->selection_number) break;
    // The program of a part beside its centre path is not known here, nor are other radii or sides.
    if (!piece.is_contour || piece.rule != rule || held_.rule_of(piece).nominal > 0)
      return std::nullopt;
    if (way.blocks.size() > most_blocks_helped) return std::nullopt;
    way.blocks.push_back({.source = piece.source,
                          .path = segment_of(piece.piece),
                          .role = piece.role,
                          .mode = approach->mode});
  }
  if (way.blocks.size() < 3) return std::nullopt;
  const Source& first = way.blocks[1].source;
  const Source& last = way.blocks.back().source;
  const bool is_at_closing = (worst.path == first && worst.contour == last) ||
                             (worst.path == last && worst.contour == first);
  if (!is_at_closing) return std::nullopt;
  return way;
}

bool Verification::tell(Diagnostic problem) {
  if (setup_.verify == Verify::report) problem.severity = Severity::warning;
  return diagnostics_.report(std::move(problem));
}

}  // namespace trc::verify
