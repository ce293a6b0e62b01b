#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

// The German words of an Explanation; examples and options are the same in every language.
struct GermanExplanation {
  Code code{};
  std::string_view meaning;
  std::array<std::string_view, 3> causes{};  // as many as in English
};

// One of each row of the table of codes, in its order.
[[nodiscard]] std::span<const GermanExplanation> german_explanations();
// Null for a code that is not in the table.
[[nodiscard]] const GermanExplanation* german_explanation_of(Code code);

}  // namespace trc
