#include "server/http/view/tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

namespace trc::server::http {
namespace {

static_assert(std::endian::native == std::endian::little);

struct DrawnSegment {
  std::array<float, 4> ends{};
  std::uint32_t element = 0;
  std::uint32_t line = 0;
  std::uint32_t style = 0;
  float tool_radius = 0;  // mm; 0: not compensated
  float sweep = 0;        // rad; 0: a line
};
static_assert(sizeof(DrawnSegment) == 36);

// The directions from a point in which a straight line passes every omitted point.
class Sleeve {
 public:
  void begin() {
    open_ = true;
    farthest_ = 0;
  }

  // Whether the line may go on straight from its start to `to`. If so, `to` is remembered.
  bool admits(const Vector& to, double tolerance) {
    const double distance = to.norm();
    if (distance <= tolerance) return farthest_ <= tolerance;
    // A line to here would not show the way back.
    if (distance + tolerance < farthest_) return false;
    // Directions that pass `to` within the tolerance; lengths do not matter.
    const double along = std::sqrt(distance * distance - tolerance * tolerance);
    const Vector aside(-tolerance * to.y(), tolerance * to.x());
    const Vector low = along * to - aside;
    const Vector high = along * to + aside;
    if (std::exchange(open_, false)) {
      low_ = low;
      high_ = high;
    } else {
      if (cross(low_, to) < 0 || cross(to, high_) < 0) return false;
      if (cross(low_, low) > 0) low_ = low;
      if (cross(high, high_) > 0) high_ = high;
    }
    farthest_ = std::max(farthest_, distance);
    return true;
  }

 private:
  bool open_ = true;
  Vector low_ = Vector::Zero();  // clockwise limit of the remaining directions
  Vector high_ = Vector::Zero();
  double farthest_ = 0;
};

Point place_on(const Arc& arc, double share) {
  return share < 1 ? verify::place_at(arc, share).point : arc.end;
}

// Where an arc meets the lines through the sides of a box, as shares of the arc.
std::vector<double> shares_on_sides(const Arc& arc, const Point& low, const Point& high) {
  constexpr double turn = 2 * std::numbers::pi;
  const double radius = radius_of(arc);
  const Vector from = arc.start - arc.center;
  const double begin = std::atan2(from.y(), from.x());
  std::vector<double> shares;
  const auto take = [&](double angle) {
    const double way = arc.sweep > 0 ? angle - begin : begin - angle;
    const double share = (way - turn * std::floor(way / turn)) / std::abs(arc.sweep);
    if (share < 1) shares.push_back(share);
  };
  for (const double side : {low.x(), high.x()}) {
    const double angle = std::acos((side - arc.center.x()) / radius);
    if (std::isnan(angle)) continue;
    take(angle);
    take(-angle);
  }
  for (const double side : {low.y(), high.y()}) {
    const double angle = std::asin((side - arc.center.y()) / radius);
    if (std::isnan(angle)) continue;
    take(angle);
    take(std::numbers::pi - angle);
  }
  return shares;
}

class Drawing {
 public:
  Drawing(const Square& square, Plane plane, double tolerance, std::size_t most_segments)
      : square_(square),
        plane_(plane),
        tolerance_(tolerance),
        most_segments_(most_segments),
        dot_cells_(static_cast<std::size_t>(std::clamp(square.side / (4 * tolerance), 8.0, 256.0))),
        dots_(dot_cells_ * dot_cells_) {
    // Strokes have a width: a motion beside the square may reach into it.
    const double margin = square.side / 128;
    low_ = square.low - Vector(margin, margin);
    high_ = square.low + Vector(square.side + margin, square.side + margin);
  }

  // False if there are too many segments.
  bool draw(const Elements& elements, std::uint32_t flags);
  [[nodiscard]] const std::vector<DrawnSegment>& segments() const { return segments_; }

 private:
  struct Pen {
    std::size_t element = 0;
    std::uint32_t line = 0;
    std::uint32_t style = 0;
    float tool_radius = 0;
  };

  [[nodiscard]] bool sees(const verify::Bounds& box) const {
    return box.low.x() <= high_.x() && box.high.x() >= low_.x() && box.low.y() <= high_.y() &&
           box.high.y() >= low_.y();
  }

  [[nodiscard]] Pen pen_of(const Elements& elements, std::size_t index, std::uint32_t flags) const;
  void draw_group(const Elements& elements, std::size_t group, std::uint32_t flags);
  void draw_element(const Elements& elements, std::size_t index, std::uint32_t flags);
  void draw_chords(const Arc& arc);
  void draw_arc(const Arc& arc, const verify::Bounds& box, const Pen& pen);
  void add(const Arc& arc, double from, double to, const Pen& pen);
  void draw_dot(const Point& at, const Pen& pen);
  void go_to(const Point& to);
  void lift();
  void begin_at(const Point& at);
  void add(const Point& from, const Point& to, const Pen& pen);
  void add(const Point& from, const Point& to, double sweep, const Pen& pen);

  const Square& square_;
  const Plane plane_;
  const double tolerance_;
  const std::size_t most_segments_;
  Point low_;
  Point high_;
  std::vector<DrawnSegment> segments_;

  bool down_ = false;
  Point begin_ = Point::Zero();  // of the segment being drawn
  Point at_ = Point::Zero();
  Pen pen_;
  Pen next_pen_;  // for the motion after the stroke
  bool begun_by_dot_ = false;
  Sleeve sleeve_;
  // At most one dot per cell.
  std::size_t dot_cells_;
  std::vector<bool> dots_;
};

bool Drawing::draw(const Elements& elements, std::uint32_t flags) {
  down_ = false;
  for (std::size_t group = 0; group < elements.groups().size(); ++group) {
    if (sees(elements.groups()[group].box))
      draw_group(elements, group, flags);
    else
      lift();
    if (segments_.size() > most_segments_) return false;
  }
  lift();
  return segments_.size() <= most_segments_;
}

void Drawing::draw_group(const Elements& elements, std::size_t group, std::uint32_t flags) {
  const Elements::Group& of = elements.groups()[group];
  const std::size_t first = group * Elements::group_size;
  const std::size_t end = std::min(first + Elements::group_size, elements.size());
  // A group the size of a dot is drawn as its last point.
  if (down_ && !of.has_special && of.box.size().maxCoeff() <= tolerance_ / 2) {
    next_pen_ = pen_of(elements, end - 1, flags);
    return go_to(elements[end - 1].end);
  }
  for (std::size_t i = first; i < end; ++i) draw_element(elements, i, flags);
}

Drawing::Pen Drawing::pen_of(const Elements& elements, std::size_t index,
                             std::uint32_t flags) const {
  const Element& element = elements[index];
  return {.element = index,
          .line = element.line,
          .style = static_cast<std::uint32_t>(element.style) | flags |
                   (element.rapid ? rapid_flag : 0U) | (element.plane == plane_ ? 0U : aside_flag),
          .tool_radius = element.tool_radius};
}

void Drawing::draw_element(const Elements& elements, std::size_t index, std::uint32_t flags) {
  const Element& element = elements[index];
  if (element.from_unknown) return lift();
  const Segment shape = elements.shape_of(element);
  verify::Bounds box;
  box.add(shape);
  if (!sees(box)) return lift();
  const Pen pen = pen_of(elements, index, flags);
  const bool small = box.size().maxCoeff() <= 2 * tolerance_;
  // A circle too small to show is a dot.
  const bool is_closed = element.arc >= 0 && element.start == element.end;
  const bool is_dot = small && (element.is_special() || is_closed);
  if (is_dot) draw_dot(element.start, pen);
  // A small element keeps the pen of the stroke it is part of, unless it is of another kind and can
  // be seen.
  const bool joined = down_ && at_ == element.start;
  const bool is_other = !is_dot && !begun_by_dot_ && pen.style != pen_.style &&
                        (at_ - begin_).norm() > 2 * tolerance_;
  // An element that can be pointed at is drawn as a segment of its own.
  if (!joined || is_other || (!small && (pen.style != pen_.style || begin_ != at_))) {
    lift();
    begin_at(element.start);
  }
  if (begin_ == at_ || (begun_by_dot_ && !is_dot)) pen_ = pen;
  begun_by_dot_ = is_dot && (begin_ == at_ || begun_by_dot_);
  if (!is_dot) next_pen_ = pen;
  const auto* arc = std::get_if<Arc>(&shape);
  if (arc != nullptr && small)
    draw_chords(*arc);
  else if (arc != nullptr)
    draw_arc(*arc, box, pen);
  else
    go_to(element.end);
  if (small) return;
  lift();
  begin_at(element.end);
}

// Draws a small arc as chords, which are joined where nobody can see it.
void Drawing::draw_chords(const Arc& arc) {
  constexpr double most_chords = 20'000;
  const double radius = radius_of(arc);
  const double sagitta = std::min(tolerance_ / 2, radius);
  const double step = radius > 0 ? 2 * std::acos(1 - sagitta / radius) : std::numbers::pi;
  const double count =
      std::clamp(std::ceil(std::abs(arc.sweep) / std::max(step, 1e-9)), 2.0, most_chords);
  for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i)
    go_to(place_on(arc, static_cast<double>(i) / count));
  go_to(arc.end);
}

// Keeps an arc as an arc where it is visible, so that it is round at any scale.
void Drawing::draw_arc(const Arc& arc, const verify::Bounds& box, const Pen& pen) {
  // The stroke begun for this arc is not needed.
  down_ = false;
  if ((box.low - low_).minCoeff() >= 0 && (high_ - box.high).minCoeff() >= 0)
    return add(arc, 0, 1, pen);
  std::vector<double> cuts = shares_on_sides(arc, low_, high_);
  cuts.push_back(1);
  std::sort(cuts.begin(), cuts.end());
  double from = 0;
  for (const double to : cuts) {
    const Point middle = place_on(arc, (from + to) / 2);
    const bool is_seen = (middle - low_).minCoeff() >= 0 && (high_ - middle).minCoeff() >= 0;
    if (to > from && is_seen) add(arc, from, to, pen);
    from = to;
  }
}

// Draws a part of an arc in pieces that stay near their chords: each piece is hardly larger than
// its visible part, and its ends and its sweep determine its centre.
void Drawing::add(const Arc& arc, double from, double to, const Pen& pen) {
  const double radius = radius_of(arc);
  const double rise = std::min(16 * tolerance_, radius);
  const double step = 2 * std::acos(1 - rise / radius);
  const double count = std::ceil((to - from) * std::abs(arc.sweep) / step);
  const double sweep = (to - from) * arc.sweep / count;
  const bool is_straight = radius * (1 - std::cos(sweep / 2)) < tolerance_ / 4;
  Point at = place_on(arc, from);
  for (std::size_t i = 1; i <= static_cast<std::size_t>(count); ++i) {
    const double share = static_cast<double>(i) / count;
    const Point next = place_on(arc, share < 1 ? from + share * (to - from) : to);
    add(at, next, is_straight ? 0 : sweep, pen);
    at = next;
  }
}

void Drawing::draw_dot(const Point& at, const Pen& pen) {
  const Vector inside = (at - low_).cwiseQuotient(high_ - low_) * static_cast<double>(dot_cells_);
  if (inside.minCoeff() < 0 || inside.maxCoeff() >= static_cast<double>(dot_cells_)) return;
  const auto cell =
      static_cast<std::size_t>(inside.x()) * dot_cells_ + static_cast<std::size_t>(inside.y());
  if (dots_[cell]) return;
  dots_[cell] = true;
  add(at, at, pen);
}

void Drawing::go_to(const Point& to) {
  if (!sleeve_.admits(to - begin_, tolerance_)) {
    add(begin_, at_, pen_);
    begin_ = at_;
    pen_ = next_pen_;
    sleeve_.begin();
    (void)sleeve_.admits(to - begin_, tolerance_);
  }
  at_ = to;
}

void Drawing::lift() {
  if (down_ && at_ != begin_) add(begin_, at_, pen_);
  down_ = false;
}

void Drawing::begin_at(const Point& at) {
  begin_ = at_ = at;
  down_ = true;
  sleeve_.begin();
}

// Draws the visible part of a segment: a long one would lose precision in numbers of 32 bits.
void Drawing::add(const Point& from, const Point& to, const Pen& pen) {
  const Vector way = to - from;
  double first = 0;
  double last = 1;
  for (const int axis : {0, 1}) {
    if (way[axis] == 0) {
      if (from[axis] < low_[axis] || from[axis] > high_[axis]) return;
      continue;
    }
    const double a = (low_[axis] - from[axis]) / way[axis];
    const double b = (high_[axis] - from[axis]) / way[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return;
  add(from + first * way, from + last * way, 0, pen);
}

void Drawing::add(const Point& from, const Point& to, double sweep, const Pen& pen) {
  const Point a = from - square_.low;
  const Point b = to - square_.low;
  segments_.push_back({.ends = {static_cast<float>(a.x()), static_cast<float>(a.y()),
                                static_cast<float>(b.x()), static_cast<float>(b.y())},
                       .element = static_cast<std::uint32_t>(pen.element),
                       .line = pen.line,
                       .style = pen.style,
                       .tool_radius = pen.tool_radius,
                       .sweep = static_cast<float>(sweep)});
}

void append(std::string& out, std::uint32_t number) {
  std::array<char, sizeof number> bytes{};
  std::memcpy(bytes.data(), &number, sizeof number);
  out.append(bytes.data(), bytes.size());
}

std::string bytes_of(const std::vector<DrawnSegment>& segments, double tolerance) {
  std::string bytes = "TRCT";
  append(bytes, static_cast<std::uint32_t>(segments.size()));
  append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(tolerance)));
  append(bytes, 0);
  bytes.append(reinterpret_cast<const char*>(segments.data()),
               segments.size() * sizeof(DrawnSegment));
  return bytes;
}

}  // namespace

std::string tile_of(const Elements& contour, const Elements& path, Plane plane,
                    const Square& square, const TileLimits& limits) {
  for (double tolerance = limits.tolerance;; tolerance *= 2) {
    Drawing drawing(square, plane, tolerance, limits.most_segments);
    const bool fits = drawing.draw(contour, 0) && drawing.draw(path, path_flag);
    // Beyond this tolerance everything in the square is one dot.
    if (fits || tolerance > square.side) return bytes_of(drawing.segments(), tolerance);
  }
}

}  // namespace trc::server::http
