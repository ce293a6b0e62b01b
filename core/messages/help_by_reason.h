#pragma once

#include <string_view>
#include <vector>

#include "core/base/language.h"

namespace trc {

// The remedy for the reason that a diagnostic gives in `detail`: a word that is not followed
// (900003), a missing or wrong number (900008), an incomplete circle (900101), a place that
// the tool cannot pass (90019, 90038) and the like. Empty: the reason has no remedy of its
// own.
[[nodiscard]] std::string_view help_by_reason(std::string_view detail, Language language);

// The reasons with a remedy of their own.
[[nodiscard]] std::vector<std::string_view> reasons_with_help();

}  // namespace trc
