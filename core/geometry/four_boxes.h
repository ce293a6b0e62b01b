#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/geometry/segment.h"

namespace trc {

using Box = Eigen::AlignedBox2d;
// A box kept in floats, since there are many: never smaller, larger by the rounding of a float.
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
[[nodiscard]] inline float rounded_up(double value) {
  constexpr float least = std::numeric_limits<float>::min();
  const auto nearest = static_cast<float>(value);
  const float unit = std::abs(nearest) * std::numeric_limits<float>::epsilon() + least;
  return static_cast<double>(nearest) >= value ? nearest : nearest + unit;
}

// The sides of a box: least x and y, and the greatest ones with the other sign. So all are rounded
// the same way, which is done together: by at most two units in the last place too far.
class KeptSides {
  using TwoDoubles = __attribute__((vector_size(16))) double;
  using TwoFloats = __attribute__((vector_size(8))) float;
  using Floats = __attribute__((vector_size(16))) float;
  using Truths = __attribute__((vector_size(16))) std::int32_t;

 public:
  explicit KeptSides(const Box& box) {
    const TwoDoubles first{box.min().x(), box.min().y()};
    const TwoDoubles second = -TwoDoubles{box.max().x(), box.max().y()};
    const auto first_floats = __builtin_convertvector(first, TwoFloats);
    const auto second_floats = __builtin_convertvector(second, TwoFloats);
    const Floats nearest = __builtin_shufflevector(first_floats, second_floats, 0, 1, 2, 3);
    const auto first_above = __builtin_convertvector(first_floats, TwoDoubles) > first;
    const auto second_above = __builtin_convertvector(second_floats, TwoDoubles) > second;
    const Truths above = __builtin_shufflevector(std::bit_cast<Truths>(first_above),
                                                 std::bit_cast<Truths>(second_above), 0, 2, 4, 6);
    constexpr std::int32_t all_but_sign = std::numeric_limits<std::int32_t>::max();
    const auto size = std::bit_cast<Floats>(std::bit_cast<Truths>(nearest) & all_but_sign);
    const Floats unit =
        size * std::numeric_limits<float>::epsilon() + std::numeric_limits<float>::min();
    sides_ = nearest - std::bit_cast<Floats>(std::bit_cast<Truths>(unit) & above);
  }

  [[nodiscard]] float min_x() const { return sides_[0]; }
  [[nodiscard]] float min_y() const { return sides_[1]; }
  [[nodiscard]] float max_x() const { return -sides_[2]; }
  [[nodiscard]] float max_y() const { return -sides_[3]; }

 private:
  Floats sides_;
};

[[nodiscard]] inline KeptBox kept(const Box& box) {
  const KeptSides sides(box);
  return {Eigen::Vector2f(sides.min_x(), sides.min_y()),
          Eigen::Vector2f(sides.max_x(), sides.max_y())};
}

// Up to four boxes that are compared with an area all at once.
class FourBoxes {
  using Floats = __attribute__((vector_size(16))) float;
  using Truths = __attribute__((vector_size(16))) std::int32_t;

 public:
  static constexpr std::size_t count = 4;
  // One bit a box.
  using Bits = unsigned;
  // Of the boxes from `number` on, where the first one has the number `first`.
  [[nodiscard]] static Bits bits_from(std::size_t first, std::size_t number) {
    constexpr Bits every = (1U << count) - 1;
    if (number <= first) return every;
    return number - first >= count ? 0 : every << (number - first) & every;
  }

  // An area and all within reach of it.
  class Surroundings {
   public:
    Surroundings(const Box& area, double reach) : Surroundings(KeptSides(area), reach) {}

   private:
    friend class FourBoxes;
    Surroundings(const KeptSides& sides, double reach)
        : min_x_(all(sides.min_x())),
          min_y_(all(sides.min_y())),
          max_x_(all(sides.max_x())),
          max_y_(all(sides.max_y())),
          squared_reach_(all(rounded_up(std::min(with_slack(reach * reach), most)))) {}

    static constexpr double most = std::numeric_limits<float>::max() / 2;
    // For what near() does in floats.
    static double with_slack(double squared_reach) { return (1 + 2e-6) * squared_reach; }

    Floats min_x_;
    Floats min_y_;
    Floats max_x_;
    Floats max_y_;
    Floats squared_reach_;
  };

  // A stretch of a path, given by its middle, and everything within reach of it.
  class Course {
   public:
    // It goes half its length to both sides of the middle, and departs from the tangent there by
    // no more than `bent`.
    Course(const Point& middle, const Vector& tangent, double half, double bent, double reach)
        : x_(all(static_cast<float>(middle.x()))),
          y_(all(static_cast<float>(middle.y()))),
          tangent_x_(all(static_cast<float>(tangent.x()))),
          tangent_y_(all(static_cast<float>(tangent.y()))),
          half_(all(static_cast<float>(half))) {
      const double farthest = reach + half;
      const double slack = 4e-6 * (farthest + bent) + 2e-7 * middle.lpNorm<1>();
      squared_beside_ = all(squared(reach + bent + slack));
      squared_about_ = all(squared(farthest + slack));
    }

   private:
    friend class FourBoxes;
    static float squared(double distance) {
      return rounded_up(std::min(distance * distance, 1e18));
    }

    Floats x_;
    Floats y_;
    Floats tangent_x_;
    Floats tangent_y_;
    Floats half_;
    Floats squared_beside_;
    Floats squared_about_;
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
    return bits_of(x * x + y * y <= area.squared_reach_);
  }

  // Those something in which may be within reach of the course. Places without a box may be among
  // them.
  //
  // The distance from a box is a convex function of the point: along the tangent it falls no faster
  // than it does in the middle, and what bends away from the tangent changes it by no more than
  // that. Nor does it fall by more than the way. Floats put the middle off by 1.2e-7 of its
  // coordinates and each of the few steps by 6e-8 of distances that are no larger than the reach
  // with half the length and the bend, where it matters: the slack of the course is more than all
  // of it.
  [[nodiscard]] Bits entered_by(const Course& course) const {
    const Floats x = positive(min_x_ - course.x_) - positive(course.x_ - max_x_);
    const Floats y = positive(min_y_ - course.y_) - positive(course.y_ - max_y_);
    const Floats squared = x * x + y * y;
    const Floats along = x * course.tangent_x_ + y * course.tangent_y_;
    // Times the distance, which saves a root and a quotient.
    const Floats aside = positive(squared - larger(along, -along) * course.half_);
    return bits_of((aside * aside <= course.squared_beside_ * squared) &
                   (squared <= course.squared_about_));
  }

  // Squared distances from four boxes.
  class Squares {
   public:
    [[nodiscard]] float operator[](std::size_t place) const { return squares_[place]; }
    [[nodiscard]] Bits up_to(float squared) const { return bits_of(squares_ <= all(squared)); }

   private:
    friend class FourBoxes;
    explicit Squares(Floats squares) : squares_(squares) {}
    Floats squares_;
  };
  // From the middle of the course, mm^2; only by rounding too large.
  [[nodiscard]] Squares squared_distances(const Course& course) const {
    const Floats x = positive(larger(min_x_ - course.x_, course.x_ - max_x_));
    const Floats y = positive(larger(min_y_ - course.y_, course.y_ - max_y_));
    return Squares(x * x + y * y);
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
  // Of comparisons, each nothing or all ones.
  static Bits bits_of(Truths truths) {
    const auto [first, second] = std::bit_cast<Halves>(truths);
    if ((first | second) == 0) return 0;
    return bits_of_half(first) | bits_of_half(second) << 2U;
  }
  static Bits bits_of_half(std::uint64_t half) {
    return static_cast<Bits>((half & 1U) | (half >> 62U & 2U));
  }

  // An empty box: beyond every area.
  Floats min_x_ = all(std::numeric_limits<float>::max());
  Floats min_y_ = all(std::numeric_limits<float>::max());
  Floats max_x_ = all(std::numeric_limits<float>::lowest());
  Floats max_y_ = all(std::numeric_limits<float>::lowest());
};

// Boxes of a row that are near something: those of the four with a bit.
struct NearFour {
  const FourBoxes* boxes = nullptr;
  std::size_t first = 0;  // the number of the first one
  FourBoxes::Bits bits = 0;

  [[nodiscard]] NearFour only(FourBoxes::Bits wanted) const {
    return {boxes, first, bits & wanted};
  }
  // Those from `from` on and before `end`.
  void drop(std::size_t from, std::size_t end) {
    if (from >= end || from >= first + FourBoxes::count || end <= first) return;
    bits &= ~(FourBoxes::bits_from(first, from) & ~FourBoxes::bits_from(first, end));
  }
  // Calls visit(number, place) for each of them, in ascending order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (FourBoxes::Bits rest = bits; rest != 0; rest &= rest - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(rest));
      visit(first + place, place);
    }
  }
};

}  // namespace trc
