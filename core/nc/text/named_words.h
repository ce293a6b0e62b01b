#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/text/words.h"

namespace trc {

// Cuts a line of Sinumerik's language into words: letters with numbers (X10, X=10, S1=500), names
// with values (CR=5, T="MILL"), names alone (NORM) and calls (CYCLE81(…)).
struct NamedWord {
  enum class Kind : std::uint8_t {
    end,
    comment,
    label,
    skip,
    address,
    assignment,
    name,
    call,
    fault
  };
  // X=AC(…): absolute; X=IC(…): a difference, whatever G90 and G91 say.
  enum class Reference : std::uint8_t { modal, absolute, incremental };

  Kind kind = Kind::end;
  char letter = 0;       // address: upper case
  int index = -1;        // address: 1 of S1=500
  std::string name{};    // upper case
  bool is_text = false;  // the value is a text in quotes
  // The value is a variable: Z=_HOME, X=R5; or a frame: $P_UIFR[1]=CTRANS(X,10).
  bool is_variable = false;
  bool whole = false;
  double value = 0;
  Reference reference = Reference::modal;
  bool is_way_round = false;  // DC(…), ACP(…), ACN(…): which way a turning axis goes
  std::uint32_t begin = 0;    // bytes of the line
  std::uint32_t end = 0;
};

class NamedWordReader {
 public:
  explicit NamedWordReader(std::string_view line) : line_(line) {}

  [[nodiscard]] NamedWord next();
  // Says what is wrong after a word of kind `fault`; the next word may be asked for all the same.
  [[nodiscard]] const TextFault& fault() const { return fault_; }

 private:
  void skip_blanks();
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < line_.size() ? line_[at_ + ahead] : '\0';
  }
  [[nodiscard]] NamedWord address();
  [[nodiscard]] NamedWord name();
  [[nodiscard]] bool read_value(NamedWord& word);
  [[nodiscard]] bool read_variable();
  [[nodiscard]] bool read_frame();
  [[nodiscard]] bool read_value_of_control();
  [[nodiscard]] bool is_assigned() const;
  [[nodiscard]] bool read_plain_number(NamedWord& word);
  [[nodiscard]] std::size_t end_of_call(std::size_t begin) const;
  [[nodiscard]] NamedWord fail(Code code, std::size_t begin, std::string detail);

  std::string_view line_;
  std::size_t at_ = 0;
  TextFault fault_{};
};

}  // namespace trc
