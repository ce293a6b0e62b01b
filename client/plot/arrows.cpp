#include "client/plot/arrows.h"

#include <algorithm>
#include <deque>
#include <optional>

namespace trc::plot {
namespace {

// The last pixels of a path that runs in short pieces.
class ShortPieces {
 public:
  void clear() { points_.clear(); }
  void add(const Point& from, const Point& to) {
    if (points_.empty() || (points_.back() - from).norm() > 1e-6) points_ = {from};
    points_.push_back(to);
    while (points_.size() > 2 && (points_.back() - points_[1]).norm() > reach) points_.pop_front();
  }
  // The direction, if the path has run straight for long enough to carry an arrow.
  [[nodiscard]] std::optional<Vector> direction() const {
    if (points_.size() < 2) return std::nullopt;
    const Vector way = points_.back() - points_.front();
    double length = 0;
    for (std::size_t i = 1; i < points_.size(); ++i) length += (points_[i] - points_[i - 1]).norm();
    constexpr double straight = 0.97;
    if (way.norm() < reach || way.norm() < straight * length) return std::nullopt;
    return way.normalized();
  }

 private:
  static constexpr double reach = 12;  // pixels
  std::deque<Point> points_;
};

class Arrows {
 public:
  explicit Arrows(const Frame& frame) : frame_(frame) {}

  std::vector<Arrow> along(const Picture& picture) {
    double whole = 0;
    for (const Stroke& stroke : picture.strokes)
      if (is_path(stroke))
        for (const Segment& segment : stroke.segments) whole += extent_of(segment) * frame_.scale;
    apart_ = since_ = std::max(100.0, whole / 80);
    for (const Stroke& stroke : picture.strokes)
      if (is_path(stroke))
        for (const Segment& segment : stroke.segments) pass(segment);
    return std::move(arrows_);
  }

 private:
  void pass(const Segment& segment) {
    const double length = extent_of(segment) * frame_.scale;
    since_ += length;
    const bool carries = length >= 36;
    if (carries)
      pieces_.clear();
    else
      pieces_.add(frame_.on_sheet(place_at(segment, 0).point),
                  frame_.on_sheet(place_at(segment, 1).point));
    if (since_ < apart_) return;
    if (carries) {
      constexpr double behind_the_middle = 0.65;
      const Place place = place_at(segment, behind_the_middle);
      // On the sheet y points down.
      add({.tip = frame_.on_sheet(place.point),
           .ahead = Vector(place.direction.x(), -place.direction.y())});
    } else if (const auto ahead = pieces_.direction()) {
      add({.tip = frame_.on_sheet(place_at(segment, 1).point), .ahead = *ahead});
    }
  }

  void add(const Arrow& arrow) {
    constexpr double room = 13;  // pixels
    const bool covered = std::any_of(arrows_.begin(), arrows_.end(), [&](const Arrow& other) {
      return (other.tip - arrow.tip).norm() < room;
    });
    if (covered) return;
    arrows_.push_back(arrow);
    since_ = 0;
  }

  const Frame& frame_;
  double apart_ = 0;  // pixels
  double since_ = 0;
  ShortPieces pieces_;
  std::vector<Arrow> arrows_;
};

}  // namespace

bool is_path(const Stroke& stroke) {
  return stroke.layer == Layer::path || stroke.layer == Layer::approach;
}

std::vector<Arrow> arrows_of(const Picture& picture, const Frame& frame) {
  return Arrows(frame).along(picture);
}

}  // namespace trc::plot
