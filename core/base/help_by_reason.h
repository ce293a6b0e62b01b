#pragma once

#include <string_view>
#include <vector>

#include "core/base/language.h"

namespace trc {

// What helps against a word that is not followed (900003), whose number is missing or wrong
// (900008), that is not all of a circle (900101), that the tool finds no way past (90019, 90038)
// and the like, by the reason that its diagnostic gives in `detail`; empty: the reason is none of
// those that have a help of their own.
[[nodiscard]] std::string_view help_by_reason(std::string_view detail, Language language);

// The reasons that have one.
[[nodiscard]] std::vector<std::string_view> reasons_with_help();

}  // namespace trc
