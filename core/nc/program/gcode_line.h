#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/program/expression.h"
#include "core/nc/text/characters.h"

namespace trc::program {

// A word of a line of plain letters and numbers whose values may be computed.
struct ComputedWord {
  enum class Kind : std::uint8_t { address, comment, skip };
  Kind kind = Kind::address;
  char letter = 0;  // upper case
  bool computed = false;
  bool left_out = false;
  Value value{};
  std::size_t begin = 0;  // bytes of the line; with the comma of `,R`
  std::size_t end = 0;
  std::string instead{};  // of a comment whose text changes

  [[nodiscard]] bool is(char with_letter, double number) const {
    return kind == Kind::address && letter == with_letter && value.number == number;
  }
};

// The beginning of a line: a `/` and an N word.
struct LineHead {
  bool to_skip = false;
  std::int64_t number = -1;  // -1: none
  std::size_t number_begin = 0;
  std::size_t number_end = 0;
  std::size_t behind = 0;  // the first sign after both
};
[[nodiscard]] LineHead head_of(std::string_view line);

// The end of the text read up to `at`, without the blanks before `at`.
[[nodiscard]] inline std::size_t end_without_blanks(std::string_view line, std::size_t begin,
                                                    std::size_t at) {
  return begin + without_blanks_behind(line.substr(begin, at - begin)).size();
}
// The position after the comment that begins at `at`; 0: it has no end.
[[nodiscard]] std::size_t behind_comment(std::string_view line, std::size_t at);
// Whether nothing but comments stands from `at` on.
[[nodiscard]] bool is_over(std::string_view line, std::size_t at);
// The comments from `at` on, a blank between.
[[nodiscard]] std::string comments_of(std::string_view line, std::size_t at);
// Whether the word stands there, whatever its case.
[[nodiscard]] bool has_word_at(std::string_view line, std::size_t at, std::string_view word);
// How much of the word stands there, two letters at least, as FANUC has it: WHILE, WH; 0: it does
// not.
[[nodiscard]] std::size_t length_of_word_at(std::string_view line, std::size_t at,
                                            std::string_view word);
// Whether the letter stands in the line with one of the two numbers, whatever decimals that has,
// outside of comments.
[[nodiscard]] bool has_function(std::string_view line, char letter, int first, int second);

enum class PointStyle : std::uint8_t {
  as_whole,    // 30
  with_point,  // 30.
};

// Decimals of a computed value where nothing demands fewer: its error is at most 5e-9.
inline constexpr int decimals_of_values = 8;
// The shortest decimal number that reads back to the value, with at most so many decimals.
void append_value(std::string& out, double value, PointStyle style,
                  int decimals = decimals_of_values);
// With so many decimals, whatever the size; a value below 0 keeps its sign where all digits are 0.
void append_exactly(std::string& out, double value, int decimals);

}  // namespace trc::program
