#include "core/nc/text/klartext_tool_words.h"

#include <algorithm>
#include <array>

#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"

namespace trc {
namespace {

using Kind = KlartextToolWord::Kind;
using Value = KlartextToolWord::Value;

constexpr std::string_view digits = "0123456789";

bool is_sign(char sign) { return sign == '+' || sign == '-'; }

}  // namespace

void KlartextToolReader::skip_blanks() {
  at_ = std::min(text_.find_first_not_of(' ', at_), text_.size());
}

// Longer names come first. DR2, the radius of a corner, needs a sign, `:`, Q or a blank after it:
// DR2.5 is DR and a number.
std::string_view KlartextToolReader::name_here() const {
  const std::string_view rest = text_.substr(at_);
  const std::size_t behind = rest.find_first_not_of(' ', std::min<std::size_t>(3, rest.size()));
  const char sign = behind == std::string_view::npos ? ' ' : rest[behind];
  if (rest.starts_with("DR2") && (is_sign(sign) || sign == ':' || sign == 'Q' || sign == ' '))
    return rest.substr(0, 3);
  constexpr std::array<std::string_view, 12> names{"DL", "DR", "FU", "FZ", "F", "S",
                                                   "L",  "R",  "M",  "X",  "Y", "Z"};
  const auto* const name =
      std::ranges::find_if(names, [&](std::string_view known) { return rest.starts_with(known); });
  return name == names.end() ? std::string_view() : *name;
}

bool KlartextToolReader::read_number_here(double& value) {
  const std::size_t length = read_klartext_number(text_.substr(at_), value);
  at_ += length;
  return length > 0;
}

// Q5, QL1; empty: no parameter.
std::string_view KlartextToolReader::read_parameter() {
  if (peek() != 'Q') return {};
  const std::size_t kind = std::string_view("LRS").find(peek(1)) != std::string_view::npos ? 2 : 1;
  const std::size_t end = std::min(text_.find_first_not_of(digits, at_ + kind), text_.size());
  if (end == at_ + kind) return {};
  const std::string_view parameter = text_.substr(at_, end - at_);
  at_ = end;
  return parameter;
}

void KlartextToolReader::read_value(KlartextToolWord& word) {
  const std::size_t behind_name = at_;
  skip_blanks();
  if (peek() == ':' && word.name == "DR2") ++at_;
  if (word.name == "S" && peek() == '(') {
    const std::size_t close = text_.find(')', at_);
    if (close == std::string_view::npos) return;
    at_ = close + 1;
    word.has = Value::other;
    return;
  }
  constexpr std::string_view automatic = "AUTO";
  if (word.name == "F" && text_.substr(at_).starts_with(automatic)) {
    at_ += automatic.size();
    word.has = Value::other;
    return;
  }
  word.negative = peek() == '-';
  if (is_sign(peek())) {
    ++at_;
    skip_blanks();
  }
  if (!is_sign(peek()) && read_number_here(word.value)) {
    word.has = Value::number;
    if (word.negative) word.value = -word.value;
  } else if (word.parameter = read_parameter(); !word.parameter.empty()) {
    word.has = Value::parameter;
  } else if (is_digit(peek())) {  // two decimal signs
    at_ = std::min(text_.find_first_not_of("0123456789.,", at_), text_.size());
  } else {
    at_ = behind_name;
  }
}

KlartextToolWord KlartextToolReader::next() {
  skip_blanks();
  KlartextToolWord word;
  const std::size_t begin = at_;
  if (begin >= text_.size()) return word;
  const auto unknown = [&] {
    at_ = std::min(text_.find(' ', begin), text_.size());
    word.kind = Kind::unknown;
  };
  if (peek() == '"') {
    const std::size_t close = text_.find('"', begin + 1);
    at_ = close + 1;
    word.kind = Kind::text;
    if (close == std::string_view::npos) unknown();
  } else if (is_digit(peek())) {
    word.kind = Kind::number;
    if (!read_number_here(word.value)) unknown();
  } else if (!read_parameter().empty()) {
    word.kind = Kind::parameter;
  } else if (word.name = name_here(); !word.name.empty()) {
    word.kind = Kind::name;
    at_ += word.name.size();
    const bool names_axis = word.name == "X" || word.name == "Y" || word.name == "Z";
    if (!names_axis) read_value(word);
  } else {
    unknown();
  }
  word.text = text_.substr(begin, at_ - begin);
  return word;
}

}  // namespace trc
