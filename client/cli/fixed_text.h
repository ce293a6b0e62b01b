#pragma once

#include <string>

#include "core/base/length_unit.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {

// "30.000": all decimals, no sign at zero.
[[nodiscard]] inline std::string fixed(double value, int decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

// The length in the unit that the program counts in (D-46), with one more decimal in inch.
[[nodiscard]] inline std::string length_in(LengthUnit unit, double mm, int decimals) {
  return fixed(mm / mm_of(unit), unit == LengthUnit::inch ? decimals + 1 : decimals);
}
[[nodiscard]] inline const char* name_of_unit(LengthUnit unit) {
  return unit == LengthUnit::inch ? " in" : " mm";
}

}  // namespace trc::cli
