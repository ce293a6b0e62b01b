#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

// What is to be said of a code beside its row of the table: for those who ask what a message means.
struct Explanation {
  Code code{};
  std::string_view meaning;                  // sentences
  std::array<std::string_view, 3> causes{};  // what usually leads to it; empty behind the last
  // How to help oneself on the command line, with the names that has; empty: as the row says.
  std::string_view on_command_line{};
  std::string_view example{};     // an ISG program that raises it; empty: see `no_example`
  std::string_view options{};     // of `trc compensate`, which the example needs
  std::string_view no_example{};  // why there is none, a sentence
};

// One of each row of the table of codes, in its order.
[[nodiscard]] std::span<const Explanation> explanations();
// Null for a code that is not in the table.
[[nodiscard]] const Explanation* explanation_of(Code code);

// How to help oneself on the command line. Empty: as help_of() says.
[[nodiscard]] std::string_view help_on_command_line(Code code, Language language);

}  // namespace trc
