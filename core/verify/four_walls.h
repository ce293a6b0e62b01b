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
// Nothing near is left out. Of what is added, multiplied and divided to tell two capsules apart, no
// step is off by more than 6e-8 of the sum of the coordinates of their centres and halves, and
// there are fewer than twenty of them: `slack` is more than that, and what each capsule adds of it
// is in its margin. What floats cannot hold is near to everything.
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
    Surroundings(const Capsule& path, const Point& origin, double reach)
        : Surroundings(around(path, origin), 0, reach) {}
    // One of several.
    Surroundings(const FourWalls& paths, std::size_t place, double reach)
        : x_(all(paths.x_[place])),
          y_(all(paths.y_[place])),
          half_x_(all(paths.half_x_[place])),
          half_y_(all(paths.half_y_[place])),
          normal_x_(all(paths.normal_x_[place])),
          normal_y_(all(paths.normal_y_[place])) {
      const float within = rounded_up(reach + slack * std::abs(reach));
      about_ = all(rounded_up(paths.radius_[place] + within));
      beside_ = all(rounded_up(paths.margin_[place] + within));
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

  // What has not been set is near to nothing. Before anything is asked, finish() has to be called.
  void set(std::size_t place, const Capsule& wall, const Point& origin) {
    const Vector center = wall.center - origin;
    constexpr double most = 1e15;
    const bool is_held = center.lpNorm<1>() + wall.half.lpNorm<1>() + wall.margin < most;
    x_[place] = is_held ? static_cast<float>(center.x()) : 0;
    y_[place] = is_held ? static_cast<float>(center.y()) : 0;
    half_x_[place] = is_held ? static_cast<float>(wall.half.x()) : 0;
    half_y_[place] = is_held ? static_cast<float>(wall.half.y()) : 0;
    margin_[place] = is_held ? rounded_up(wall.margin) : std::numeric_limits<float>::infinity();
  }
  // Makes of all of them what comparing them asks for.
  void finish() {
    const Floats length = root_of(half_x_ * half_x_ + half_y_ * half_y_);
    const Truths is_line = length > Floats{};
    const Floats share = 1 / length;
    normal_x_ = std::bit_cast<Floats>(std::bit_cast<Truths>(-half_y_ * share) & is_line);
    normal_y_ = std::bit_cast<Floats>(std::bit_cast<Truths>(half_x_ * share) & is_line);
    const Floats all_of_it = size(x_) + size(y_) + size(half_x_) + size(half_y_) + margin_;
    margin_ += static_cast<float>(slack) * all_of_it + shortest;
    radius_ = length + margin_;
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
  static constexpr double slack = 2e-6;  // a part: more than the rounding of floats all in all

  // The square of what is shorter is none in floats.
  static constexpr float shortest = 1e-15F;  // mm

  static FourWalls around(const Capsule& one, const Point& origin) {
    FourWalls made;
    made.set(0, one, origin);
    made.finish();
    return made;
  }

  static Floats all(float value) { return Floats{value, value, value, value}; }
  static Floats size(Floats of) {
    constexpr std::int32_t all_but_sign = std::numeric_limits<std::int32_t>::max();
    return std::bit_cast<Floats>(std::bit_cast<Truths>(of) & all_but_sign);
  }
  static Floats root_of(Floats squares) {
#ifdef __SSE__
    return __builtin_ia32_sqrtps(squares);
#else
    for (std::size_t place = 0; place < count; ++place) squares[place] = std::sqrt(squares[place]);
    return squares;
#endif
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
  static constexpr double slack = 1e-6;  // a part: more than the rounding of floats all in all
  // Floats put a number off by up to 1.2e-7 of itself.
  static float rounded_up(double value) {
    return static_cast<float>(value + 2e-7 * std::abs(value));
  }
  static float rounded_down(double value) { return -rounded_up(-value); }

  static constexpr float nowhere = std::numeric_limits<float>::infinity();
  Floats inner_{nowhere, nowhere, nowhere, nowhere};
  Floats outer_{};
};

}  // namespace trc::verify
