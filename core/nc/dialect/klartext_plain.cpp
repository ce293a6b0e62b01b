#include "core/nc/dialect/klartext_plain.h"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_checks.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/decimal.h"

// Reads the most common blocks of Klartext: those with only a line, an arc or a pole.

namespace trc {
namespace {

using Statement = KlartextStatement;

constexpr bool is_blank(char sign) { return sign == ' ' || sign == '\t'; }

// Walks along a line with blanks between its words.
class PlainWords {
 public:
  explicit PlainWords(std::string_view line)
      : line_(line), at_(line.data()), end_(line.data() + line.size()) {}

  // False at the end of the line.
  bool go_to_next() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    begin_ = at_;
    return at_ != end_;
  }
  [[nodiscard]] std::uint32_t begin() const { return place_of(begin_); }
  [[nodiscard]] std::uint32_t end() const { return place_of(at_); }
  [[nodiscard]] char sign() const { return at_ == end_ ? '\0' : *at_; }
  // Must not be called at the end of the line.
  char take_any() { return *at_++; }
  bool take(char sign) {
    if (at_ == end_ || *at_ != sign) return false;
    ++at_;
    return true;
  }
  bool take(std::string_view text) {
    if (!std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(text))
      return false;
    at_ += text.size();
    return true;
  }
  bool take_number(double& value) {
    bool whole = false;
    return trc::take_number(line_, at_, value, whole) && std::isfinite(value);
  }
  // Digits alone, up to the count that a number holds exactly.
  bool take_digits(std::int64_t& value) {
    constexpr int most = 15;
    value = 0;
    int digits = 0;
    for (; at_ != end_ && *at_ >= '0' && *at_ <= '9' && digits <= most; ++at_, ++digits)
      value = 10 * value + (*at_ - '0');
    return digits > 0 && digits <= most;
  }
  [[nodiscard]] bool ends_here() const { return at_ == end_ || is_blank(*at_); }

 private:
  [[nodiscard]] std::uint32_t place_of(const char* at) const {
    return static_cast<std::uint32_t>(at - line_.data());
  }

  std::string_view line_;
  const char* at_;
  const char* end_;
  const char* begin_ = nullptr;  // of the word
};

Statement statement_at(PlainWords& words) {
  if (words.take('L')) return Statement::straight;
  if (!words.take('C')) return Statement::none;
  if (words.take('R')) return Statement::radius_arc;
  return words.take('C') ? Statement::center : Statement::circle;
}

std::string_view name_of(Statement statement) {
  switch (statement) {
    case Statement::straight:
      return "L";
    case Statement::center:
      return "CC";
    case Statement::radius_arc:
      return "CR";
    default:
      return "C";
  }
}

// The meaning of the letters of a word, up to its number if it has one.
struct PlainWord {
  WordRole role = WordRole::coordinate;
  bool increment = false;
  std::optional<KlartextBlock::Value>* value = nullptr;
};

bool take_name(const Reading& reading, PlainWords& words, KlartextBlock& block, PlainWord& word) {
  switch (words.take_any()) {
    case 'I':
      word.increment = true;
      if (words.sign() < 'X' || words.sign() > 'Z') return false;
      word.value = &block.end[static_cast<std::size_t>(words.take_any() - 'X')];
      return true;
    case 'X':
      word.value = &block.end[0];
      return true;
    case 'Y':
      word.value = &block.end[1];
      return true;
    case 'Z':
      word.value = &block.end[2];
      return true;
    case 'F':
      word.role = WordRole::feed;
      word.value = &block.feed;
      if (words.sign() != 'M') return !block.rapid;
      word.role = WordRole::motion;
      word.value = nullptr;
      return !block.feed && words.take("MAX") && !std::exchange(block.rapid, true);
    case 'D':
      if (!words.take('R') || !is_arc_of(block.statement) || block.clockwise) return false;
      block.clockwise = words.sign() == '-';
      return words.take('-') || words.take('+');
    case 'R':
      word.value = &block.radius;
      if (block.is(KlartextStatement::radius_arc)) return true;
      word.value = nullptr;
      word.role = words.sign() != '0' || reading.contour_open() ? WordRole::trc : WordRole::mode;
      if (!block.is(KlartextStatement::straight) || block.side) return false;
      block.side = words.sign() == 'L' ? Side::left : words.sign() == 'R' ? Side::right : Side::off;
      block.side_begin = words.begin();
      return words.take('0') || words.take('L') || words.take('R');
    default:
      return false;
  }
}

// Reads a plain block in one pass: afterwards the block and the words of the line are as the
// general reader leaves them, and the words fit together. False for any other block, valid or not:
// then `block` is meaningless.
bool read_plain_klartext(const Reading& reading, ProgramLine& line, KlartextBlock& block) {
  PlainWords words(line.text);
  const auto add_word = [&](WordRole role) {
    line.words.push_back({.begin = words.begin(), .end = words.end(), .role = role});
    line.roles |= bit(role);
  };
  const auto not_plain = [&] {
    line.words.clear();
    line.roles = 0;
    return false;
  };
  if (reading.ended || reading.klartext_modes.feed_per_turn || !words.go_to_next()) return false;
  std::int64_t number = Source::no_number;
  if (words.sign() >= '0' && words.sign() <= '9') {
    if (!words.take_digits(number) || !words.ends_here()) return false;
    add_word(WordRole::number);
    if (!words.go_to_next()) return not_plain();
  }
  block.statement = statement_at(words);
  if (block.is(KlartextStatement::none) || !words.ends_here()) return not_plain();
  block.name = name_of(block.statement);
  block.begin = words.begin();
  add_word(WordRole::motion);

  while (words.go_to_next()) {
    PlainWord word;
    if (!take_name(reading, words, block, word)) return not_plain();
    if (word.value != nullptr) {
      if (*word.value) return not_plain();
      KlartextBlock::Value taken{.increment = word.increment, .begin = words.begin()};
      if (!words.take_number(taken.value)) return not_plain();
      *word.value = taken;
    }
    if (!words.ends_here()) return not_plain();
    add_word(word.role);
  }
  if (block.radius && block.radius->value == 0) return not_plain();  // R0
  const bool arc = is_arc_of(block.statement);
  const bool by_radius = block.is(KlartextStatement::radius_arc);
  if ((arc && !block.clockwise) || (by_radius && !block.radius)) return not_plain();
  line.source.number = number;
  return true;
}

}  // namespace

std::optional<bool> take_plain_klartext(Reading& reading, ProgramLine& line) {
  KlartextBlock block;
  if (!read_plain_klartext(reading, line, block)) return {};
  reading.klartext_modes.after_number = line.source.number != Source::no_number;
  const bool readable = check_klartext(reading, line, block);
  return take_klartext(reading, line, block,
                       readable ? KlartextCheck::passed : KlartextCheck::failed);
}

}  // namespace trc
