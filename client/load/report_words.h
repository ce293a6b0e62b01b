#pragma once

#include <string>
#include <string_view>

#include "core/base/language.h"

namespace trc::load {

// A sentence of the report, or a part of one, in the language; one that is not in the table as it
// is.
[[nodiscard]] std::string said(std::string_view english, Language language);

}  // namespace trc::load
