#include "tests/interop/linuxcnc/comparison.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tests/support/slow_clearance.h"

namespace trc::linuxcnc {
namespace {

using support::point_at;
using support::slow_distance;

std::string text_of(const Point& point) {
  std::ostringstream text;
  text << std::setprecision(10) << '(' << point.x() << ", " << point.y() << ')';
  return text.str();
}

std::string sentence(const std::string& what, std::size_t block, const Point& ours,
                     const Point& theirs) {
  return what + " of contour block " + std::to_string(block + 1) + ": ours " + text_of(ours) +
         ", LinuxCNC's " + text_of(theirs) + ", apart " + std::to_string((ours - theirs).norm());
}

bool is_masked(const JudgedContour& judged, std::size_t index) {
  return index + 1 < judged.contour.blocks.size() &&
         std::abs(turn_to_tool(judged, index)) < corner_threshold;
}

bool same_kind(const Segment& a, const Segment& b) {
  if (is_arc(a) != is_arc(b)) return false;
  return !is_arc(a) || (std::get<Arc>(a).sweep > 0) == (std::get<Arc>(b).sweep > 0);
}

// The inserted blocks of one corner against each other.
std::string corner_difference(std::size_t index, const Compensated& ours, const Compensated& theirs,
                              double tolerance) {
  if (ours.corner.size() != theirs.corner.size())
    return "after contour block " + std::to_string(index + 1) + " we insert " +
           std::to_string(ours.corner.size()) + " blocks, LinuxCNC " +
           std::to_string(theirs.corner.size());
  for (std::size_t k = 0; k < ours.corner.size(); ++k) {
    const Segment& a = ours.corner[k];
    const Segment& b = theirs.corner[k];
    if (!same_kind(a, b))
      return "other kind of block inserted after block " + std::to_string(index + 1);
    if ((end_of(a) - end_of(b)).norm() > tolerance)
      return sentence("corner end", index, end_of(a), end_of(b));
    const Point center_a = std::get<Arc>(a).center;
    const Point center_b = std::get<Arc>(b).center;
    if ((center_a - center_b).norm() > tolerance)
      return sentence("corner centre", index, center_a, center_b);
  }
  return {};
}

// How far the distance of both ends and a few points of `path` from `programmed` is off.
double equidistance_error(const Segment& path, const Segment& programmed, double radius) {
  double error = 0;
  for (const Point& point : {start_of(path), point_at(path, 0.25), point_at(path, 0.5),
                             point_at(path, 0.75), end_of(path)})
    error = std::max(error, std::abs(slow_distance(point, programmed) - radius));
  return error;
}

}  // namespace

double turn_to_tool(const JudgedContour& judged, std::size_t index) {
  const auto& blocks = judged.contour.blocks;
  const double turn =
      turn_between(tangent_at_end(blocks[index]), tangent_at_start(blocks[index + 1]));
  return judged.mode.side == Side::left ? turn : -turn;
}

std::vector<Compensated> seated(const JudgedContour& judged,
                                const std::vector<CompensatedBlock>& path) {
  std::vector<Compensated> result(judged.contour.blocks.size());
  std::vector<bool> found(result.size());
  for (const CompensatedBlock& block : path) {
    if (block.source.number < 1 || std::cmp_greater(block.source.number, result.size())) continue;
    const auto index = static_cast<std::size_t>(block.source.number - 1);
    if (block.origin == Origin::transition) result[index].corner.push_back(block.path);
    if (block.origin != Origin::programmed) continue;
    result[index].block = block.path;
    found[index] = true;
  }
  for (std::size_t k = 0; k < found.size(); ++k)
    if (!found[k]) throw std::runtime_error("we dropped contour block " + std::to_string(k + 1));
  return result;
}

std::vector<Compensated> seated_answer(const JudgedContour& judged) {
  std::vector<Compensated> result;
  auto next = judged.path.begin();
  const auto take = [&]() -> const Segment& {
    if (next == judged.path.end()) throw std::runtime_error("LinuxCNC's path is too short");
    return *next++;
  };
  const std::size_t count = judged.contour.blocks.size();
  for (std::size_t k = 0; k < count; ++k) {
    result.push_back({.block = take()});
    if (!same_kind(result.back().block, judged.contour.blocks[k]))
      throw std::runtime_error("LinuxCNC's block for contour block " + std::to_string(k + 1) +
                               " is of another kind");
    if (k + 1 < count && turn_to_tool(judged, k) < -corner_threshold)
      result.back().corner.push_back(take());
  }
  if (next != judged.path.end()) throw std::runtime_error("LinuxCNC's path is too long");
  return result;
}

std::string difference(const JudgedContour& judged, const std::vector<Compensated>& ours,
                       const std::vector<Compensated>& theirs, double tolerance) {
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const Segment& a = ours[k].block;
    const Segment& b = theirs[k].block;
    if (!same_kind(a, b)) return "another kind of block " + std::to_string(k + 1);
    const bool start_masked = k > 0 && is_masked(judged, k - 1);
    if (!start_masked && (start_of(a) - start_of(b)).norm() > tolerance)
      return sentence("start", k, start_of(a), start_of(b));
    if (is_arc(a)) {
      const Point center_a = std::get<Arc>(a).center;
      const Point center_b = std::get<Arc>(b).center;
      if ((center_a - center_b).norm() > tolerance)
        return sentence("centre", k, center_a, center_b);
    }
    if (is_masked(judged, k)) continue;
    if ((end_of(a) - end_of(b)).norm() > tolerance) return sentence("end", k, end_of(a), end_of(b));
    if (auto text = corner_difference(k, ours[k], theirs[k], tolerance); !text.empty()) return text;
  }
  return {};
}

std::string broken_equidistant(const JudgedContour& judged, const std::vector<Compensated>& ours,
                               double tolerance) {
  const double radius = judged.mode.tool_radius;
  const auto& programmed = judged.contour.blocks;
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const std::string where = " contour block " + std::to_string(k + 1) + " by ";
    if (const double error = equidistance_error(ours[k].block, programmed[k], radius);
        error > tolerance)
      return "not one radius from" + where + std::to_string(error);
    if (k + 1 == ours.size()) break;
    const Point corner = end_of(programmed[k]);
    for (const Segment& inserted : ours[k].corner)
      if (const double error =
              equidistance_error(inserted, Line{.start = corner, .end = corner}, radius);
          error > tolerance)
        return "not one radius from the corner after" + where + std::to_string(error);
    if (!is_masked(judged, k)) continue;
    for (const Point& joint : {end_of(ours[k].block), start_of(ours[k + 1].block)})
      for (const Segment& neighbour : {programmed[k], programmed[k + 1]})
        if (const double gouge = radius - slow_distance(joint, neighbour); gouge > tolerance)
          return "gouge at the corner after" + where + std::to_string(gouge);
  }
  return {};
}

}  // namespace trc::linuxcnc
