#pragma once

#include <string>
#include <string_view>

#include "core/base/language.h"

namespace trc::cli {

// A heading or a cell of the tables of `trc info` in the language; one that is not known as it is.
[[nodiscard]] std::string cell_in(Language language, std::string_view english);

}  // namespace trc::cli
