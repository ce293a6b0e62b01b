#include "core/trc/passes/split.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace trc {
namespace {

// A stretch of the line, as a share of it.
struct Part {
  double share = 0;
  double feed = 0;
};

// The share of the line that one mm of the option takes; 0 if it cannot be determined.
double share_of_one_mm(const SplitOption& split, const PathBlock& block) {
  const Line& line = std::get<Line>(block.tool_path);
  const Vector way = line.end - line.start;
  double extent = way.norm();
  if (!split.along_path) {
    const PlaneAxes axes = axes_of(block.mode().plane);
    extent = split.axis == axes.first    ? std::abs(way.x())
             : split.axis == axes.second ? std::abs(way.y())
                                         : 0;
  }
  return extent > 0 ? 1 / extent : 0;
}

double between(const AxisTravel& travel, double share) {
  return travel.from + share * (travel.to - travel.from);
}

// The line from share `from` to share `to`; its far end is exact at 1.
PathBlockPtr piece(const PathBlock& whole, const Point& start, double from, double to,
                   double feed) {
  auto owner = std::make_unique<PathBlock>();
  PathBlock& part = *owner;
  part.programmed = whole.programmed;
  part.role = whole.role;
  part.origin = whole.origin;
  const Line& line = std::get<Line>(whole.tool_path);
  const bool last = to == 1;
  const Point end = last ? line.end : Point(line.start + to * (line.end - line.start));
  part.tool_path = Line{.start = start, .end = end};
  const auto travel = [&](const AxisTravel& axis) -> AxisTravel {
    return {.from = from == 0 ? axis.from : between(axis, from),
            .to = last ? axis.to : between(axis, to)};
  };
  part.programmed.normal = travel(whole.programmed.normal);
  for (AxisTravel& axis : part.programmed.tracking) axis = travel(axis);
  if (feed > 0) {
    part.programmed.feed = feed;
    part.programmed.rapid = false;
  }
  return owner;
}

}  // namespace

bool Split::feed(PathBlockPtr block, PathBlocks& out) {
  if (ignores(*block)) {
    out.push_back(std::move(block));
    return true;
  }
  const SplitOption& split = block->mode().options.split;
  const bool approach = block->role == Role::approach;
  const bool wanted =
      split.where == SplitOption::Where::combined ||
      split.where == (approach ? SplitOption::Where::pre : SplitOption::Where::post);
  const double one = wanted ? share_of_one_mm(split, *block) : 0;
  const double slack = tolerances_.on_contour * one;  // D-14
  // From the contour outwards.
  std::array<Part, 2> parts{Part{split.distance_1 * one, split.feed_1}, Part{}};
  std::size_t count = split.distance_1 > 0 ? 1 : 0;
  if (split.distance_2 > 0) {
    parts = {Part{split.distance_2 * one, split.feed_2}, parts[0]};
    count += 1;
    if (parts[0].share + parts[1].share > 1 + slack) count = 1;
  }
  if (one == 0 || count == 0 || parts[0].share > 1 + slack) {
    out.push_back(std::move(block));
    return true;
  }
  // The stretches along the line, from its start.
  std::array<Part, 3> stretches{};
  double rest = 1;
  for (std::size_t i = 0; i < count; ++i) rest -= parts[i].share;
  if (std::abs(rest) <= slack) {
    parts[count - 1].share += rest;
    rest = 0;
  }
  if (approach) {
    stretches[0] = {rest, 0};
    for (std::size_t i = 0; i < count; ++i) stretches[i + 1] = parts[count - 1 - i];
  } else {
    for (std::size_t i = 0; i < count; ++i) stretches[i] = parts[i];
    stretches[count] = {rest, 0};
  }
  Point start = start_of(block->tool_path);
  double from = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const bool last = i == count || (i + 1 == count && stretches[count].share <= 0);
    const double to = last ? 1 : from + stretches[i].share;
    if (stretches[i].share > 0) {
      out.push_back(piece(*block, start, from, to, stretches[i].feed));
      start = end_of(out.back()->tool_path);
      from = to;
    }
    if (last) break;
  }
  out.back()->passive = std::move(block->passive);
  return true;
}

}  // namespace trc
