#pragma once

#include <optional>
#include <string_view>

#include "core/nc/text/words.h"

namespace trc {

// Value of the expression at the start of `text`: decimal numbers, + - * / ** and brackets [ ],
// with blanks between. `length` are the bytes it takes; a word after it is not read.
//
// Numbers only: a variable or a function is refused by its name (900003). A number too large or a
// division by zero is 900008, an open bracket 900009. `begin` of a fault counts from `text`.
// `value` and `length` mean nothing after a fault.
[[nodiscard]] std::optional<TextFault> read_expression(std::string_view text, double& value,
                                                       std::size_t& length);

}  // namespace trc
