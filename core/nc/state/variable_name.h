#pragma once

#include <string>
#include <string_view>

#include "core/nc/state/dialect_name.h"

namespace trc {

// The one name of a variable that a setup may spell in several ways: in capitals, without blanks,
// `#`, `<` and `>`, and with a number as the control counts it. `# 0500` is 500, `#<ab>` is AB, and
// of Sinumerik `r01` and `R[1]` are R1.
[[nodiscard]] std::string plain_variable_name(std::string_view spelling, DialectName dialect);

}  // namespace trc
