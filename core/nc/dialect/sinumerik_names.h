#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace trc {

// Names that the reader of Sinumerik knows, in capitals. A program that computes takes all others
// for variables and subprograms.

// The meaning of a name that stands alone.
enum class SinumerikMeaning : std::uint8_t {
  technology,
  frame,       // TRANS, ROT, …
  unfollowed,  // transformations, scaling
  spline,      // and polynomials and involutes, up to the next G00 … G03
  spatial,     // TRC in space
  spatial_end,
  suppression,  // of TRC: CUTCONON
  unfollowed_end,
  single_move,  // SUPA
  modal_cycle,  // MCALL
  statement,    // IF, GOTOF, …: refused
  turning,
};

// Nothing: the name is not in the table. CIP, NORM and the like need more than the table holds.
[[nodiscard]] std::optional<SinumerikMeaning> meaning_of_sinumerik_name(std::string_view name);
// IF, DEF, GOTOF and the like.
[[nodiscard]] bool is_sinumerik_statement(std::string_view name);
// NORM, CIP, …, statements too.
[[nodiscard]] bool is_sinumerik_name(std::string_view name);

// MSG(…), CYCLE81(…) and the like.
[[nodiscard]] bool is_sinumerik_call(std::string_view name);
// CYCLE81(…), POCKET3(…): what they move only the control knows.
[[nodiscard]] bool is_sinumerik_cycle(std::string_view name);
// What a call of the language does to the axes that it names.
enum class SinumerikAxisCall : std::uint8_t {
  displaces,  // PRESETON, GET, TANGON
  couples,    // TRAILON: the first one follows another axis
  uncouples,  // TRAILOF
};
[[nodiscard]] std::optional<SinumerikAxisCall> axis_call_of_sinumerik(std::string_view name);
// MSG(…): does not affect the path.
[[nodiscard]] bool is_passing_sinumerik_call(std::string_view name);
// L6, the change of tools as Siemens delivers it: only the machine has its text (D-64).
inline constexpr std::string_view standard_tool_change = "L6";

// CR=, RND=, …
[[nodiscard]] bool is_sinumerik_word(std::string_view name);
// ADIS=, SPOS=, …: does not affect the path.
[[nodiscard]] bool is_passing_sinumerik_word(std::string_view name);
// FRC=, FRCM=: the feed of roundings and chamfers.
[[nodiscard]] bool is_sinumerik_corner_word(std::string_view name);
// $P_UIFR, $P_PFRAME and the like: change what coordinates mean.
[[nodiscard]] bool is_sinumerik_frame(std::string_view name);
// Why a word with a value is refused; empty: it is not.
[[nodiscard]] std::string_view refusal_of_sinumerik_word(std::string_view name);

// LEAD=, STAT=, …: words of the language that are refused. Names that are none of the language are
// variables of the machine.
[[nodiscard]] bool is_unread_sinumerik_word(std::string_view name);

// Whether it is a name, a call or a word as above.
[[nodiscard]] bool is_sinumerik_word_of_any_kind(std::string_view name);

}  // namespace trc
