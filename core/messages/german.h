#pragma once

#include <span>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

// The German words for a code, as a machinist would say them. Words of programs, settings and
// options stay as they are, and so do numbers: with a decimal point.
struct GermanRow {
  Code code{};
  std::string_view title;              // for EnglishRow::cause
  std::string_view help;               // for EnglishRow::remedy
  std::string_view on_command_line{};  // for Explanation::on_command_line; empty as that is
};

// One of each row of the table of codes, in its order.
[[nodiscard]] std::span<const GermanRow> german_rows();
[[nodiscard]] const GermanRow& german_row_of(Code code);

}  // namespace trc
