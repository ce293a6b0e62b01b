#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

// A word that was mistyped: what it is, where it begins, and what was probably meant.
struct FoundSlip {
  Slip slip{};
  std::size_t begin = 0;  // bytes of the line
  std::string word{};     // as written
};

// Whether the word at this byte of a line, which could not be read, is a slip of typing: a decimal
// comma, the letter O or l where a digit belongs, signs of a word processor. The rules are the same
// in every dialect (D-46). Nothing where the word may be meant as it stands.
[[nodiscard]] std::optional<FoundSlip> slip_at(std::string_view line, std::size_t at);

}  // namespace trc
