#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/segment.h"

namespace trc {

using Box = Eigen::AlignedBox2d;
// As many of them are kept: no smaller than the box, larger by the rounding of a float.
using KeptBox = Eigen::AlignedBox2f;

// 0 where they overlap or touch, mm^2.
[[nodiscard]] inline double squared_distance(const Box& a, const Box& b) {
  const double x = std::max({a.min().x() - b.max().x(), b.min().x() - a.max().x(), 0.0});
  const double y = std::max({a.min().y() - b.max().y(), b.min().y() - a.max().y(), 0.0});
  return x * x + y * y;
}

[[nodiscard]] inline Box widened(const KeptBox& box) {
  return {box.min().cast<double>(), box.max().cast<double>()};
}

// By at most two units in the last place too far.
[[nodiscard]] inline float rounded_down(double value) {
  constexpr float least = std::numeric_limits<float>::min();
  const auto nearest = static_cast<float>(value);
  const float unit = std::abs(nearest) * std::numeric_limits<float>::epsilon() + least;
  return static_cast<double>(nearest) <= value ? nearest : nearest - unit;
}
[[nodiscard]] inline float rounded_up(double value) { return -rounded_down(-value); }

[[nodiscard]] inline KeptBox kept(const Box& box) {
  return {Eigen::Vector2f(rounded_down(box.min().x()), rounded_down(box.min().y())),
          Eigen::Vector2f(rounded_up(box.max().x()), rounded_up(box.max().y()))};
}

// Up to four boxes that are compared with an area all at once.
class FourBoxes {
  using Floats = __attribute__((vector_size(16))) float;

 public:
  static constexpr std::size_t count = 4;
  // One bit a box.
  using Bits = unsigned;

  // An area and all within reach of it.
  class Surroundings {
   public:
    Surroundings(const Box& area, double reach)
        : min_x_(all(rounded_down(area.min().x()))),
          min_y_(all(rounded_down(area.min().y()))),
          max_x_(all(rounded_up(area.max().x()))),
          max_y_(all(rounded_up(area.max().y()))),
          squared_reach_(all(rounded_up(std::min(with_slack(reach * reach), most)))) {}

   private:
    friend class FourBoxes;
    static constexpr double most = std::numeric_limits<float>::max() / 2;
    // For what near() does in floats.
    static double with_slack(double squared_reach) { return (1 + 2e-6) * squared_reach; }

    Floats min_x_;
    Floats min_y_;
    Floats max_x_;
    Floats max_y_;
    Floats squared_reach_;
  };

  void set(std::size_t place, const KeptBox& box) {
    min_x_[place] = box.min().x();
    min_y_[place] = box.min().y();
    max_x_[place] = box.max().x();
    max_y_[place] = box.max().y();
  }
  // No box has been set from this place on.
  void clear_from(std::size_t place) {
    for (; place < count; ++place) set(place, KeptBox());
  }
  [[nodiscard]] KeptBox operator[](std::size_t place) const {
    return {Eigen::Vector2f(min_x_[place], min_y_[place]),
            Eigen::Vector2f(max_x_[place], max_y_[place])};
  }
  [[nodiscard]] KeptBox about_all() const {
    return {Eigen::Vector2f(least(min_x_), least(min_y_)),
            Eigen::Vector2f(greatest(max_x_), greatest(max_y_))};
  }

  // Those that may be near, by squared_distance() of what is kept of them; all others are farther
  // off. Places without a box are left out.
  //
  // Nothing that is near is left out: the area has been rounded outward, so that the difference of
  // two coordinates is no larger than the one squared_distance() takes; it, its square and the sum
  // are each too large by at most 6e-8 of themselves, all in all by less than 3e-7 of the result.
  // The reach has a slack of 2e-6, beside which the rounding of doubles is nothing.
  [[nodiscard]] Bits near(const Surroundings& area) const {
    const Floats x = positive(larger(min_x_ - area.max_x_, area.min_x_ - max_x_));
    const Floats y = positive(larger(min_y_ - area.max_y_, area.min_y_ - max_y_));
    const auto halves = std::bit_cast<Halves>(x * x + y * y <= area.squared_reach_);
    if ((halves.first | halves.second) == 0) return 0;
    return bits_of(halves.first) | bits_of(halves.second) << 2U;
  }

 private:
  struct Halves {
    std::uint64_t first;
    std::uint64_t second;
  };

  static Floats all(float value) { return Floats{value, value, value, value}; }
  static Floats larger(Floats a, Floats b) { return a > b ? a : b; }
  static Floats positive(Floats a) { return larger(a, Floats{}); }
  static float least(Floats a) { return std::min(std::min(a[0], a[1]), std::min(a[2], a[3])); }
  static float greatest(Floats a) { return std::max(std::max(a[0], a[1]), std::max(a[2], a[3])); }
  // Of two comparisons, each nothing or all ones.
  static Bits bits_of(std::uint64_t half) {
    return static_cast<Bits>((half & 1U) | (half >> 62U & 2U));
  }

  // An empty box: beyond every area.
  Floats min_x_ = all(std::numeric_limits<float>::max());
  Floats min_y_ = all(std::numeric_limits<float>::max());
  Floats max_x_ = all(std::numeric_limits<float>::lowest());
  Floats max_y_ = all(std::numeric_limits<float>::lowest());
};

// Boxes with a number each, for a few questions.
class NumberedBoxes {
 public:
  void clear() {
    fours_.clear();
    numbers_.clear();
  }
  [[nodiscard]] bool empty() const { return numbers_.empty(); }
  void add(std::size_t number, const KeptBox& box) {
    const std::size_t place = numbers_.size() % FourBoxes::count;
    if (place == 0) fours_.emplace_back();
    fours_.back().set(place, box);
    numbers_.push_back(number);
  }
  // Calls visit(number) for every box not farther than `reach` mm from `area`, in the order they
  // were added.
  template <class Visit>
  void for_each_near(const Box& area, double reach, Visit visit) const {
    const FourBoxes::Surroundings surroundings(area, reach);
    for (std::size_t four = 0; four < fours_.size(); ++four)
      for (FourBoxes::Bits near = fours_[four].near(surroundings); near != 0; near &= near - 1) {
        const auto place = static_cast<std::size_t>(std::countr_zero(near));
        if (squared_distance(widened(fours_[four][place]), area) > reach * reach) continue;
        visit(numbers_[four * FourBoxes::count + place]);
      }
  }

 private:
  std::vector<FourBoxes> fours_;
  std::vector<std::size_t> numbers_;
};

}  // namespace trc
