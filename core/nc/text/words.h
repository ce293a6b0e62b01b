#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {

enum class WordKind : std::uint8_t {
  end,       // of the line
  comment,   // ( … ) or ; …
  address,   // a letter and its number
  number,    // a number without letter (G04 2.5)
  variable,  // V.G.WZ_AKT.R= or V.G.WZR=, the tool radius
  command,   // #…, up to a comment outside its brackets
  skip,      // /, and the number of its switch
  fault,
};

struct Word {
  WordKind kind = WordKind::end;
  char letter = 0;            // address: upper case
  bool whole = false;         // the number has neither decimal point nor fraction
  bool has_argument = false;  // G159=3, S2=500: the number after the sign
  bool relative = false;      // a variable: itself and `value`
  double value = 0;
  double argument = 0;
  std::uint32_t begin = 0;  // bytes of the line
  std::uint32_t end = 0;
};

// What is wrong with the text, and where.
struct TextFault {
  Code code = Code::nc_syntax;
  std::uint32_t begin = 0;  // byte of the line
  std::string detail{};
  Slip slip{};
};

// Cuts one block of NC text into words, one after the other, in one pass over
// the bytes. The lines of a continued block are given together, with their `\`.
//
// Words need no blanks between them; blanks may stand between a letter, its `=`
// and its number. A no-break space is a blank: text copied from a manual holds it.
// A comment in parentheses nests and ends in its line (900009). Numbers are
// decimal without exponent: E is a letter of its own. After `=` they may be computed: X=100/2,
// Y=4 + 5.
class WordReader {
 public:
  enum class CommentBytes : std::uint8_t { utf8, any };
  explicit WordReader(std::string_view line, CommentBytes comment_bytes = CommentBytes::utf8)
      : line_(line),
        at_(line.data()),
        end_(line.data() + line.size()),
        comment_bytes_(comment_bytes) {}

  [[nodiscard]] Word next();
  // Says what is wrong after a word of kind `fault`.
  [[nodiscard]] const TextFault& fault() const { return fault_; }

 private:
  void pass_blanks();
  [[nodiscard]] bool skip_blanks();
  [[nodiscard]] bool skip_line_end();
  Word subprogram_call(const char* begin);
  [[nodiscard]] Word address();
  [[nodiscard]] Word number_alone();
  [[nodiscard]] Word comment();
  [[nodiscard]] Word command();
  [[nodiscard]] Word variable();
  [[nodiscard]] std::string variable_name();
  [[nodiscard]] bool sum(const std::string& variable, Word& word);
  [[nodiscard]] Word other_sign();
  [[nodiscard]] bool number(double& value, bool& whole);
  // Takes a view, so that words without a fault need no string.
  [[nodiscard]] Word fail(Code code, const char* at, std::string_view detail);
  [[nodiscard]] bool goes_on_as_expression();
  [[nodiscard]] Word expression(const char* begin, Word word);
  [[nodiscard]] Word no_number(const Word& word);
  [[nodiscard]] Word no_text(const char* begin, std::size_t bad);
  [[nodiscard]] std::uint32_t place_of(const char* at) const {
    return static_cast<std::uint32_t>(at - line_.data());
  }
  [[nodiscard]] char peek() const { return at_ == end_ ? ' ' : *at_; }

  std::string_view line_;
  const char* at_;
  const char* end_;
  CommentBytes comment_bytes_;
  TextFault fault_{};
};

// Whether N, T or D can have this number: whole and exact in a double.
inline constexpr double largest_whole = 1e15;
[[nodiscard]] inline bool is_whole(double value) {
  return value >= 0 && value <= largest_whole && value == std::floor(value);
}

// A decimal number at the start of `text`: sign, digits, point. Returns how many
// bytes it takes; 0 when there is none. Correctly rounded. Infinite when it is
// larger than any double.
[[nodiscard]] std::size_t read_number(std::string_view text, double& value, bool& whole);

// A number of Sinumerik, where 5EX1 is 50.
[[nodiscard]] std::size_t read_named_number(std::string_view text, double& value, bool& whole);

// S[M3 REV1000], S2[POS=90 M19] of ISG, from the S on: after the bracket; 0: it is a number or an
// expression.
[[nodiscard]] std::size_t behind_spindle_words(std::string_view text);

// #SUPPRESS OFFSETS [ZERO] of ISG, from the # on: after its name and its brackets, where the words
// of its motion begin; 0: it is another command.
[[nodiscard]] std::size_t behind_suppressed_offsets(std::string_view text);

// V.G.NP[1].V.X, V.G.NP_AKT.ALL and V.G.NP_DEFAULT of ISG: zero offsets.
[[nodiscard]] bool begins_zero_offset(std::string_view text);

// The place of the first byte that no text may have: a control character other than tab and line
// end, or a byte that is not UTF-8. npos when there is none.
[[nodiscard]] std::size_t first_byte_that_is_no_text(std::string_view text);
// first_byte_that_is_no_text() for UTF-8 alone.
[[nodiscard]] std::size_t first_byte_that_is_no_utf8(std::string_view text);

// Whether the block goes on after `line`, one physical line: it ends in `\`
// outside a comment and is no program name.
[[nodiscard]] bool is_continued(std::string_view line);

}  // namespace trc
