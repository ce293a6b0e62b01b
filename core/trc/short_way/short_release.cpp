#include "core/trc/short_way/short_release.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "core/base/flatten.h"
#include "core/geometry/parallel.h"
#include "core/trc/corner/tool_path.h"
#include "core/trc/passes/contour_violations.h"

namespace trc {

TRC_FLATTEN bool ShortRelease::put_out(std::vector<CompensatedBlock>& out, std::size_t most) {
  const std::size_t before = out.size();
  LoopRelease* const path = loop_removal_.releases_path();
  while (path != nullptr && out.size() < most) {
    path->pass_by_without_trace();
    if (const PathPiece* part = path->next_part()) {
      if (!put_out_part(*part, out)) break;
      path->part_has_left();
      continue;
    }
    const LoopRelease::Row row = path->next_as_they_came(most - out.size());
    const std::size_t count = row.count > 0 ? put_out_row(row, out) : 0;
    if (count == 0) break;
    path->have_left(count);
  }
  return out.size() > before;
}

std::size_t ShortRelease::put_out_row(const LoopRelease::Row& row,
                                      std::vector<CompensatedBlock>& out) {
  HeldPath::Reader held = loop_removal_.path().read_from(row.first);
  if (!may_put_out(held.setting())) return 0;
  const auto put_out_whole = [&](const auto& path) { return put_out_path(held, path, {}, out); };
  std::size_t count = 0;
  for (; count < row.count && held.next(); ++count) {
    const bool goes_on = held.is_linear() ? put_out_lines(held, row.first + count, out)
                                          : held.visit_path(put_out_whole);
    if (!goes_on) break;
  }
  return count;
}

bool ShortRelease::put_out_lines(const HeldPath::Reader& held, std::size_t transition,
                                 std::vector<CompensatedBlock>& out) {
  const HeldPath::Lines lines = loop_removal_.path().lines_of(transition);
  const auto is_out = [&](const Line& line) { return out_of_range(line, tolerances_); };
  if (std::any_of(lines.all().begin(), lines.all().end(), is_out)) return false;
  for (const Line& line : lines.all()) put_out_path(held, line, {}, out);
  return true;
}

bool ShortRelease::put_out_part(const PathPiece& part, std::vector<CompensatedBlock>& out) {
  HeldPath::Reader held = loop_removal_.path().read_from(part.block);
  const bool gets_circle = part.behind_loop && held.setting().mode->options.gen_cir_block_in_corner;
  if (gets_circle || !may_put_out(held.setting()) || !held.next()) return false;
  const auto put_out_line = [&](const Line& whole) {
    const HeldPath::Cuts cuts{part.from, length_of(whole) - part.to};
    return put_out_path(held, Line{.start = part.start, .end = part.end}, cuts, out);
  };
  const auto put_out_arc = [&](const Arc& whole) {
    const double length = length_of(whole);
    if (part.is_all_of(whole, length)) return put_out_path(held, whole, {}, out);
    const double radius = radius_of(whole);
    const HeldPath::Cuts cuts{part.from / radius, (length - part.to) / radius};
    return put_out_path(held, stretch_of(whole, part.from, part.to, part.start, part.end), cuts,
                        out);
  };
  return held.visit_path(overloaded{put_out_line, put_out_arc});
}

bool ShortRelease::may_put_out(const HeldPath::Setting& setting) const {
  return !inverse_path_ && setting.mode->feed_adaptation == FeedAdaptation::off;
}

template <class Path>
bool ShortRelease::put_out_path(const HeldPath::Reader& held, const Path& path,
                                const HeldPath::Cuts& cuts, std::vector<CompensatedBlock>& out) {
  if (out_of_range(path, tolerances_)) return false;
  if (held.is_contour()) {
    const auto length = programmed_length(held, path.end - path.start, cuts);
    if (!length) return false;
    reporting_.summary().programmed_length += *length;
  }
  const HeldPath::Setting& setting = held.setting();
  const Reporting::Motion motion{*setting.mode, setting.normal, setting.feed, setting.rapid};
  CompensatedBlock& block = reporting_.put_out(held.source(), motion, held.origin(), path, out);
  if (!setting.tracking.empty()) block.tracking = setting.tracking;
  return true;
}

std::optional<double> ShortRelease::programmed_length(const HeldPath::Reader& held,
                                                      const Vector& travelled,
                                                      const HeldPath::Cuts& more) const {
  const auto of_line = [&](const Line& line) -> std::optional<double> {
    const auto [tangent, length] = directed(line.end - line.start);
    if (runs_back(travelled, tangent, tolerances_)) return std::nullopt;
    return length;
  };
  const auto of_arc = [&](const Arc& arc, const HeldPath::Cuts& cuts) -> std::optional<double> {
    const double radius = radius_of(arc);
    const double sweep = std::abs(arc.sweep);
    const double left = sweep - (cuts.at_start + more.at_start) - (cuts.at_end + more.at_end);
    const double parallel = parallel_radius(arc, radius, held.setting().at_end.shift);
    if (is_consumed(left, parallel, tolerances_)) return std::nullopt;
    return sweep * radius;
  };
  return held.visit_programmed(overloaded{of_line, of_arc});
}

}  // namespace trc
