#pragma once

#include <span>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

// The English words for a code, in the words of ISG.
struct EnglishRow {
  Code code{};
  std::string_view cause;   // a sentence without full stop
  std::string_view remedy;  // what the operator or programmer can do
};

// One of each row of the table of codes, in its order.
[[nodiscard]] std::span<const EnglishRow> english_rows();
[[nodiscard]] const EnglishRow& english_row_of(Code code);

}  // namespace trc
