#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/geometry/segment.h"
#include "core/verify/box.h"
#include "core/verify/capsule.h"

namespace trc::verify {

// What lies around up to four walls, compared with a piece of path all at once. Coordinates count
// from an origin near to the walls, so that they may be floats.
//
// Nothing near is left out. Of what is added, subtracted and multiplied to tell two capsules apart,
// no step is off by more than 6e-8 of the sum of the coordinates of their centres and halves, and
// there are fewer than ten of them: `slack` is more than that, and what each capsule adds of it is
// in its margin. What floats cannot hold is near to everything.
class FourWalls {
  using Floats = __attribute__((vector_size(16))) float;
  using Truths = __attribute__((vector_size(16))) std::int32_t;

 public:
  static constexpr std::size_t count = 4;
  // One bit a wall.
  using Bits = unsigned;

  // A piece of path, and all within reach of it.
  class Surroundings {
   public:
    Surroundings(const Capsule& path, const Point& origin, double reach) {
      const Kept kept(path, origin);
      x_ = all(kept.x);
      y_ = all(kept.y);
      half_x_ = all(kept.half_x);
      half_y_ = all(kept.half_y);
      normal_x_ = all(static_cast<float>(path.normal.x()));
      normal_y_ = all(static_cast<float>(path.normal.y()));
      const double within = reach + slack * std::abs(reach);
      about_ = all(rounded_up(kept.radius + within));
      beside_ = all(rounded_up(kept.margin + within));
    }

   private:
    friend class FourWalls;
    Floats x_;
    Floats y_;
    Floats half_x_;
    Floats half_y_;
    Floats normal_x_;
    Floats normal_y_;
    Floats about_;
    Floats beside_;
  };

  // What has not been set is near to nothing.
  void set(std::size_t place, const Capsule& wall, const Point& origin) {
    const Kept kept(wall, origin);
    x_[place] = kept.x;
    y_[place] = kept.y;
    half_x_[place] = kept.half_x;
    half_y_[place] = kept.half_y;
    normal_x_[place] = static_cast<float>(wall.normal.x());
    normal_y_[place] = static_cast<float>(wall.normal.y());
    radius_[place] = rounded_up(kept.radius);
    margin_[place] = rounded_up(kept.margin);
  }

  // Counts from another origin, which lies at `shift` from the old one.
  void move_origin(const Vector& shift) {
    x_ -= all(static_cast<float>(shift.x()));
    y_ -= all(static_cast<float>(shift.y()));
    const Floats more = all(rounded_up(slack * shift.lpNorm<1>()));
    radius_ += more;
    margin_ += more;
  }

  // Those that may be within reach of the path. Their circles are apart, or one lies beside the
  // line of the other one: else they may be near.
  [[nodiscard]] Bits near(const Surroundings& path) const {
    const Floats x = x_ - path.x_;
    const Floats y = y_ - path.y_;
    const Floats farthest = radius_ + path.about_;
    const Truths about = x * x + y * y <= farthest * farthest;
    if (!is_any(about)) return 0;
    const Floats limit = path.beside_ + margin_;
    const Floats of_path = size(path.normal_x_ * x + path.normal_y_ * y) -
                           size(path.normal_x_ * half_x_ + path.normal_y_ * half_y_);
    const Floats of_wall = size(normal_x_ * x + normal_y_ * y) -
                           size(normal_x_ * path.half_x_ + normal_y_ * path.half_y_);
    return bits_of(about & (of_path <= limit) & (of_wall <= limit));
  }

 private:
  friend class FourRings;
  static constexpr double slack = 2e-6;

  // Of a capsule, from the origin on.
  struct Kept {
    Kept(const Capsule& capsule, const Point& origin) {
      const Vector center = capsule.center - origin;
      const double size = center.lpNorm<1>() + capsule.half.lpNorm<1>() + capsule.margin;
      constexpr double most = 1e15;
      if (!(size < most)) {
        radius = margin = std::numeric_limits<double>::infinity();
        return;
      }
      x = static_cast<float>(center.x());
      y = static_cast<float>(center.y());
      half_x = static_cast<float>(capsule.half.x());
      half_y = static_cast<float>(capsule.half.y());
      margin = capsule.margin + slack * size;
      radius = capsule.half_length + margin;
    }
    float x = 0;
    float y = 0;
    float half_x = 0;
    float half_y = 0;
    double margin = 0;
    double radius = 0;
  };

  static Floats all(float value) { return Floats{value, value, value, value}; }
  static Floats size(Floats of) {
    constexpr std::int32_t all_but_sign = std::numeric_limits<std::int32_t>::max();
    return std::bit_cast<Floats>(std::bit_cast<Truths>(of) & all_but_sign);
  }
  // By next to nothing too large; what is slack is far more than that.
  static float rounded_up(double value) {
    return static_cast<float>(value + 1e-7 * std::abs(value));
  }
  static bool is_any(Truths truths) { return bits_of(truths) != 0; }
  static Bits bits_of(Truths truths) {
#ifdef __SSE__
    return static_cast<Bits>(__builtin_ia32_movmskps(std::bit_cast<Floats>(truths)));
#else
    const Truths places = truths & Truths{1, 2, 4, 8};
    const auto [first, second] = std::bit_cast<std::array<std::uint64_t, 2> >(places);
    const std::uint64_t both = first | second;
    return static_cast<Bits>((both | both >> 32U) & 15U);
#endif
  }

  static constexpr float nowhere = 1e17F;  // its square is a float
  Floats x_ = all(nowhere);
  Floats y_ = all(nowhere);
  Floats half_x_{};
  Floats half_y_{};
  Floats normal_x_{};
  Floats normal_y_{};
  Floats radius_{};
  Floats margin_{};
};

// The distances of up to four walls from one point, compared with those of a piece of path all at
// once: that tells walls apart that go round in windings, each inside the next. As with FourWalls
// nothing near is left out.
class FourRings {
  using Floats = __attribute__((vector_size(16))) float;
  using Truths = __attribute__((vector_size(16))) std::int32_t;

 public:
  // Of a piece of path, about the same point, and all within reach of it.
  class Surroundings {
   public:
    Surroundings() = default;
    Surroundings(const Ring& path, double reach)
        : lowest_(rounded_down(path.inner - reach - slack * (path.outer + std::abs(reach)))),
          highest_(rounded_up(path.outer + reach + slack * (path.outer + std::abs(reach)))) {}

   private:
    friend class FourRings;
    float lowest_ = 0;
    float highest_ = 0;
  };

  // What has not been set is near to nothing.
  void set(std::size_t place, const Ring& wall) {
    inner_[place] = rounded_down(wall.inner);
    outer_[place] = rounded_up(wall.outer);
  }
  [[nodiscard]] FourWalls::Bits near(const Surroundings& path) const {
    const Floats lowest{path.lowest_, path.lowest_, path.lowest_, path.lowest_};
    const Floats highest{path.highest_, path.highest_, path.highest_, path.highest_};
    return FourWalls::bits_of((outer_ >= lowest) & (inner_ <= highest));
  }

 private:
  static constexpr double slack = 1e-6;
  static float rounded_up(double value) {
    return static_cast<float>(value + 2e-7 * std::abs(value));
  }
  static float rounded_down(double value) { return -rounded_up(-value); }

  static constexpr float nowhere = std::numeric_limits<float>::infinity();
  Floats inner_{nowhere, nowhere, nowhere, nowhere};
  Floats outer_{};
};

}  // namespace trc::verify
