#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/state/program_setup.h"

namespace trc::program {

// The beginning of a line of Sinumerik: a `/`, a block number, a label.
struct NamedHead {
  bool to_skip = false;
  std::int64_t number = -1;  // of N10 or :10; -1: none
  std::size_t number_begin = 0;
  std::size_t number_end = 0;
  std::string label{};  // in capitals; empty: none
  std::size_t label_begin = 0;
  std::size_t behind = 0;  // the first sign after all
};
[[nodiscard]] NamedHead named_head_of(std::string_view line);

// The name of letters, digits and `_` at `at`, in capitals; empty: none begins there.
[[nodiscard]] std::string name_at(std::string_view line, std::size_t at);
// Whether the line is over at `at`, but for blanks and a comment.
[[nodiscard]] bool is_named_line_over(std::string_view line, std::size_t at);
// Where the word stands as a separate word, from `at` on, outside of texts and comments; npos:
// nowhere. `word` is in capitals; with WordEnd::open more letters may follow.
enum class WordEnd : std::uint8_t { whole, open };
[[nodiscard]] std::size_t place_of_word(std::string_view line, std::size_t at,
                                        std::string_view word, WordEnd end);
// The position after the bracket that closes the one at `at`; 0: none. Quoted texts are skipped.
[[nodiscard]] std::size_t behind_bracket(std::string_view line, std::size_t at);

// Whether the line has a variable, an expression, a statement, or a call of a subprogram.
[[nodiscard]] bool sinumerik_computes(const ProgramSetup& setup, std::string_view line);

// The name of the file that a header line "%_N_PART_MPF" begins: PART_MPF, in capitals. Empty: it
// is no header line.
[[nodiscard]] std::string file_of_header(std::string_view line);
inline constexpr std::string_view main_program_ending = "_MPF";
inline constexpr std::string_view subprogram_ending = "_SPF";
// The name of the program that a header line "%_N_PART_MPF" begins: PART, in capitals. Empty: it is
// no header line.
[[nodiscard]] std::string program_of_header(std::string_view line);

}  // namespace trc::program
