#pragma once

#include <string_view>

#include "core/base/language.h"

namespace trc {

// What helps against a word that is not followed (900003), whose number is missing or wrong
// (900008), that is not all of a circle (900101), or that the tool finds no way past (90019,
// 90038), by the reason that its diagnostic gives in `detail`; empty: the reason is none of those
// that have a help of their own.
[[nodiscard]] std::string_view help_by_reason(std::string_view detail, Language language);

}  // namespace trc
