#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/text/words.h"

namespace trc {

// A word of Klartext: a name and what stands after it.
struct KlartextWord {
  enum class Kind : std::uint8_t {
    end,
    name,      // alone: L, RL, FMAX
    value,     // with a number: X+10, IX-5, LEN12, R0
    sign,      // with a sign alone: DR+, R-
    variable,  // with a parameter or an expression: X+Q1
    number,    // a number without name
    text,      // "…"
    comment,   // ; …
    skip,      // leading /
    fault,
  };
  Kind kind = Kind::end;
  std::string name{};  // upper case
  double value = 0;
  bool negative = false;  // of a sign alone
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

// A number, with a decimal point or, as older controls write it, a comma (D-90). Returns the bytes
// it takes; 0 where there is none, or one with two decimal signs: 1,2,3 or 1.2,3.
[[nodiscard]] std::size_t read_klartext_number(std::string_view text, double& value);

// Cuts a block of Klartext into words. The lines of a continued block are given together, with
// their `~`. Words need no blanks between them where a number or RL, RR, R0 ends; blanks may stand
// between a name and its number.
class KlartextReader {
 public:
  explicit KlartextReader(std::string_view block) : block_(block) {}

  [[nodiscard]] KlartextWord next();
  // Says what is wrong after a word of kind `fault`.
  [[nodiscard]] const TextFault& fault() const { return fault_; }

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < block_.size() ? block_[at_ + ahead] : '\0';
  }
  void skip_blanks();
  [[nodiscard]] KlartextWord word(KlartextWord::Kind kind, std::size_t begin, std::size_t end);
  [[nodiscard]] KlartextWord named();
  [[nodiscard]] KlartextWord numbered(KlartextWord word);
  [[nodiscard]] KlartextWord fail(Code code, std::size_t begin, std::string detail);

  std::string_view block_;
  std::size_t at_ = 0;
  TextFault fault_{};
};

// Whether the block is a comment alone.
[[nodiscard]] bool is_klartext_comment(std::string_view block);

// Whether the block goes on after `line`, one physical line: it ends in `~` and is no comment.
[[nodiscard]] bool is_continued_klartext(std::string_view line);

}  // namespace trc
