#pragma once

#include <string_view>

namespace trc {

// Names that the reader of Sinumerik knows, in capitals: of all others a program that computes
// thinks as of variables and subprograms.

// IF, DEF, GOTOF and the like.
[[nodiscard]] bool is_sinumerik_statement(std::string_view name);
// NORM, CIP, …, statements too.
[[nodiscard]] bool is_sinumerik_name(std::string_view name);
// MSG(…), CYCLE81(…) and the like.
[[nodiscard]] bool is_sinumerik_call(std::string_view name);
// CR=, RND=, …
[[nodiscard]] bool is_sinumerik_word(std::string_view name);
// $P_UIFR, $P_PFRAME and the like: what coordinates mean.
// L6, the change of tools as Siemens delivers it: only the machine has its text (D-64).
inline constexpr std::string_view standard_tool_change = "L6";

[[nodiscard]] bool is_sinumerik_frame(std::string_view name);
// One of these.
[[nodiscard]] bool is_sinumerik_word_of_any_kind(std::string_view name);

}  // namespace trc
