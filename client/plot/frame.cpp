#include "client/plot/frame.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace trc::plot {
namespace {

// One elliptical arc command spans at most half a turn. For larger arcs, rounding of the ends could
// decide the flag for the larger arc.
void append_arc(std::string& d, const Arc& arc, const Frame& frame) {
  const double radius = (arc.start - arc.center).norm() * frame.scale;
  const bool halved = std::abs(arc.sweep) > std::numbers::pi * (1 + 1e-9);
  // Seen from above, with y up, counter-clockwise is positive. On the sheet y points down, and SVG
  // denotes this direction by 0.
  const char* sense = arc.sweep > 0 ? "0" : "1";
  const auto append = [&](const Point& to) {
    d += "A" + px(radius) + " " + px(radius) + " 0 0 " + sense + " " + pair(frame.on_sheet(to));
  };
  if (halved) append(place_at(arc, 0.5).point);
  append(arc.end);
}

}  // namespace

Frame fit(const Bounds& contents, double widest, double tallest) {
  constexpr double margin = 0.06;  // of the larger extent, on each side
  Frame frame;
  Point low = contents.low;
  Point high = contents.high;
  const double larger = std::max((high - low).maxCoeff(), 0.0);
  // Far from the origin, doubles cannot resolve a smaller picture.
  const double least =
      std::max(contents.low.cwiseAbs().maxCoeff(), contents.high.cwiseAbs().maxCoeff()) * 1e-11;
  const bool is_point = larger <= least;
  const double extent = is_point ? 1.0 : larger;
  const double flattest = is_point ? 1.0 : 0.22;  // least height, or width, as a share of extent
  for (int axis = 0; axis < 2; ++axis) {
    const double wanted = std::max(high[axis] - low[axis] + 2 * margin * extent, flattest * extent);
    const double middle = low[axis] + (high[axis] - low[axis]) / 2;
    low[axis] = middle - wanted / 2;
    high[axis] = middle + wanted / 2;
  }
  frame.world = {.low = low, .high = high, .empty = false};
  const Vector size = frame.world.size();
  frame.scale = std::min(widest / size.x(), tallest / size.y());
  frame.width = size.x() * frame.scale;
  frame.height = size.y() * frame.scale;
  return frame;
}

Ticks ticks_between(double low, double high, double smallest_step) {
  const double magnitude = std::pow(10.0, std::floor(std::log10(smallest_step)));
  constexpr std::array<double, 4> multiples{1, 2, 5, 10};
  Ticks ticks;
  for (const double multiple : multiples) {
    ticks.step = multiple * magnitude;
    if (ticks.step >= smallest_step) break;
  }
  ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(ticks.step) + 1e-9)));
  const double first = std::ceil(low / ticks.step);
  const double last = std::floor(high / ticks.step);
  const int steps = static_cast<int>(last - first);
  for (int n = 0; n <= steps; ++n) ticks.at.push_back((first + n) * ticks.step);
  return ticks;
}

std::string decimal(double value, int decimals) {
  std::array<char, 400> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                          std::chars_format::fixed, decimals);
  std::string text(buffer.data(), error == std::errc{} ? end : buffer.data());
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string px(double value) { return decimal(value, 3); }

std::string pair(const Point& point) { return px(point.x()) + " " + px(point.y()); }

std::string path_data(std::span<const Segment> segments, const Frame& frame) {
  std::string d;
  std::optional<Point> reached;
  for (const Segment& segment : segments) {
    const Place start = place_at(segment, 0);
    if (!reached || *reached != start.point) d += "M" + pair(frame.on_sheet(start.point));
    const Place end = place_at(segment, 1);
    const auto* arc = std::get_if<Arc>(&segment);
    if (arc && (arc->start - arc->center).norm() * frame.scale > 0.01) {
      append_arc(d, *arc, frame);
    } else {
      d += "L" + pair(frame.on_sheet(end.point));
    }
    reached = end.point;
  }
  return d;
}

std::array<const char*, 2> axis_names(Plane plane) {
  if (plane == Plane::zx) return {"Z", "X"};
  if (plane == Plane::yz) return {"Y", "Z"};
  return {"X", "Y"};
}

}  // namespace trc::plot
