#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/base/length_unit.h"
#include "core/base/tolerances.h"
#include "core/geometry/segment.h"

namespace trc {

// How a programmed circle is checked (rule 10.4). G165 (initial): an inaccurate
// centre is shifted onto a valid circle within limits. G164: no correction, the
// radii at start and end may differ within limits.
struct CircleCheck {
  bool correct_center = true;              // G165 / G164
  double largest_shift = 2.0;              // mm, P-CHAN-00059; not on small arcs (D-41)
  double largest_shift_factor = 0.05;      // of the corrected radius, P-CHAN-00060
  double reported_shift = 0.01;            // mm; a larger one gets a warning, 900221 (D-41)
  double largest_radius_difference = 0.1;  // mm, G164, P-CHAN-00171
  double largest_radius_factor = 0.01;     // of the radius, G164, P-CHAN-00172
  // mm; by how much half the chord may exceed the R word: one digit of a program
  // with three decimals. The arc is a semicircle then.
  double largest_radius_shortfall = 1e-3;
  // mm, what the last digit of a coordinate is worth: three decimals, of an inch four. A misfit
  // that such rounding of each coordinate explains is accepted (D-44); with 0 none is.
  double last_digit = 1e-3;

  bool operator==(const CircleCheck&) const = default;
};

// A circular block in its plane, absolute, mm.
struct CircleEnds {
  Point start = Point::Zero();
  Point end = Point::Zero();
  bool clockwise = false;
};

struct CircleFault {
  Code code = Code::circle_center_misfit;
  std::vector<DiagnosticValue> values{};
};

enum class ArcUse : std::uint8_t { as_programmed, with_equidistant };

using CircleResult = std::variant<Arc, CircleFault>;

// The worth of the last digit of a program that counts in this unit, mm.
[[nodiscard]] constexpr double last_digit(LengthUnit unit) {
  return unit == LengthUnit::inch ? 2.54e-3 : 1e-3;
}

// How much correcting a centre changes an arc, as a length: the width of the narrowest ring about
// the programmed centre that holds the arc, mm. On a short arc that is far less than the shift.
[[nodiscard]] double width_about(const Point& programmed_center, const Arc& arc);

// Start, end and centre that are off by half of the last digit on both axes make an arc no wider
// than that.
[[nodiscard]] constexpr double rounded_width(double last_digit) { return 3 * last_digit; }

// The arc about a programmed centre. For every arc made:
//   (1) start and end are those given, bit for bit; they are equal for a full circle
//   (2) start and end are equally far from the centre
//   (3) 0 < |sweep| <= 2 pi
//
// A start and an end closer than `same_point` are one point, and the arc is the full circle:
// rounded coordinates mean that, and a shorter arc cuts nothing. With a larger distance the
// direction decides: an end ahead of the start gives a short arc, an end behind it an almost full
// circle, as written.
//
// Where the arc gets an equidistant, radii that G164 lets differ by more than `on_contour` are
// refused (90018), since no circle fits them. Where rounding alone explains width_about(), no
// misfit of either kind is refused.
//
// Errors: 20035, 20036, 21758, 90018.
[[nodiscard]] CircleResult arc_about(const Point& center, const CircleEnds& ends,
                                     const CircleCheck& check, ArcUse use,
                                     const Tolerances& tolerances);

// The arc of a radius word: at most 180 degrees when positive, more when negative.
// Errors: 20034, 20035 (the ends are farther apart than the diameter), 20036.
[[nodiscard]] CircleResult arc_of_radius(double radius, const CircleEnds& ends,
                                         const CircleCheck& check, const Tolerances& tolerances);

}  // namespace trc
