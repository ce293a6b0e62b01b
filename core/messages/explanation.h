#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

// The explanation of a code in addition to its row, for users who ask what a message means.
struct Explanation {
  Code code{};
  std::string_view meaning;                  // sentences
  std::array<std::string_view, 3> causes{};  // what usually leads to it; empty after the last
  // The remedy in the names of the command line; empty: the row applies.
  std::string_view on_command_line{};
  std::string_view example{};  // a program that raises it, of ISG unless the options say otherwise
  // Of `trc compensate`, which the example needs, as a shell takes them.
  std::string_view options{};
  // A part of the example that repeats too often to be shown in full; empty: none.
  std::string_view repeated{};
  std::uint32_t times = 1;
};

// One of each row of the table of codes, in its order.
[[nodiscard]] std::span<const Explanation> explanations();
// Null for a code that is not in the table.
[[nodiscard]] const Explanation* explanation_of(Code code);

// The whole example.
[[nodiscard]] std::string example_of(const Explanation& explanation);

// The remedy on the command line. Empty: that of help_of() applies.
[[nodiscard]] std::string_view help_on_command_line(Code code, Language language);

}  // namespace trc
