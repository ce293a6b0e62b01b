#pragma once

#include <cmath>

namespace trc {

// Whether an arc is as good as its chord (D-44): it rises above the chord by at most half of
// `input_resolution`, which is less than the rounding of its ends. Both lengths in mm, the sweep in
// rad; an arc of one radian and more is not flat, however short its chord is.
[[nodiscard]] inline bool is_flat_arc(double chord, double sweep, double input_resolution) {
  // The rise is chord / 2 · tan(sweep / 4); up to one radian, an eighth of the product is 2 % less.
  return std::abs(sweep) < 1 && chord * std::abs(sweep) <= 4 * input_resolution;
}

}  // namespace trc
