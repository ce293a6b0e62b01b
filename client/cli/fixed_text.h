#pragma once

#include <string>

#include "core/nc/text/number_format.h"

namespace trc::cli {

// "30.000": all decimals, no sign at zero.
[[nodiscard]] inline std::string fixed(double value, int decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

}  // namespace trc::cli
