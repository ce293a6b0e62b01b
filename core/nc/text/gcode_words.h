#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/text/words.h"

namespace trc {

// Cuts a line of a dialect of plain letters and numbers into words: that of Fanuc and of
// LinuxCNC. Unlike WordReader, which reads ISG's, it knows comments that do not nest, the `/`
// before a block to skip, `,R` and `,C`, and takes L and P for letters like all others.
struct GcodeWord {
  enum class Kind : std::uint8_t { end, comment, skip, address, fault };
  Kind kind = Kind::end;
  char letter = 0;          // upper case; `$`: the spindle of M03; `@`: polar coordinates, @ and ^
  bool comma = false;       // ,R ,C
  bool has_number = false;  // false only after N and O
  bool whole = false;       // without decimal point
  double value = 0;
  std::uint32_t begin = 0;  // bytes of the line
  std::uint32_t end = 0;
};

class GcodeReader {
 public:
  // Where blanks may stand. LinuxCNC ignores them: X1 0 is X10.
  enum class Blanks : std::uint8_t { between_words, in_numbers };
  explicit GcodeReader(std::string_view line, Blanks blanks = Blanks::between_words)
      : line_(line), blanks_(blanks) {}

  [[nodiscard]] GcodeWord next();
  // Says what is wrong after a word of kind `fault`; the next word may be asked for all the same.
  [[nodiscard]] const TextFault& fault() const { return fault_; }

 private:
  void skip_blanks();
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < line_.size() ? line_[at_ + ahead] : '\0';
  }
  [[nodiscard]] GcodeWord comment();
  [[nodiscard]] GcodeWord address(std::size_t begin);
  [[nodiscard]] GcodeWord name_of_program(GcodeWord word);
  [[nodiscard]] std::size_t blanks_behind_sign() const;
  std::size_t read_value(GcodeWord& word) const;
  [[nodiscard]] GcodeWord polar(std::size_t begin);
  [[nodiscard]] GcodeWord name(std::size_t begin);
  [[nodiscard]] GcodeWord fail(Code code, std::size_t begin, std::size_t end, std::string detail);

  std::string_view line_;
  Blanks blanks_;
  std::size_t at_ = 0;
  TextFault fault_{};
};

}  // namespace trc
