#include "core/nc/program/said_words.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

namespace trc::program {

// The words of a line with plain numbers.
struct LineWords {
  struct Word {
    char letter = 0;
    double value = 0;
    bool whole = false;  // without a decimal point
  };
  std::vector<Word> words{};
  bool may_be_skipped = false;
  bool is_text = false;  // it has a name, or a sign that begins no word

  [[nodiscard]] bool has(char letter, std::initializer_list<double> values) const {
    return std::ranges::any_of(words, [&](const Word& word) {
      return word.letter == letter && std::ranges::find(values, word.value) != values.end();
    });
  }
  [[nodiscard]] const Word* word(char letter) const {
    const auto found = std::ranges::find(words, letter, &Word::letter);
    return found == words.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool has(char letter) const { return word(letter) != nullptr; }
};

namespace {

LineWords words_of(std::string_view line) {
  LineWords found;
  for (std::size_t at = behind_blanks(line, 0); at < line.size() && line[at] != ';';
       at = behind_blanks(line, at)) {
    if (line[at] == '(') {
      at = behind_comment(line, at);
      if (at == 0) break;
      continue;
    }
    const char letter = upper(line[at++]);
    found.may_be_skipped |= letter == '/';
    if (!is_letter(letter)) continue;
    at = behind_blanks(line, at);
    found.is_text |= at < line.size() && is_letter(line[at]);
    bool whole = false;
    double value = 0;
    const std::size_t length = read_number(line.substr(std::min(at, line.size())), value, whole);
    if (length > 0) found.words.push_back({.letter = letter, .value = value, .whole = whole});
    at += length;
  }
  return found;
}

}  // namespace

void SaidWords::forget() {
  for (const char letter : letters) say(letter, {});
  placed_ = {};
  moves_ = incremental_ = moves_frame_ = has_length_ = true;
}

void SaidWords::take(std::string_view line) {
  const LineWords words = words_of(line);
  if (words.is_text || words.has('G', {4, 10})) return;
  // D and F of a cycle that mills by itself, and S of a limit, are not in force after it.
  const bool is_cycle = words.has('G', {12, 13, 35, 36, 37, 47, 70, 71, 72, 150});
  const bool limits_spindle = words.has('G', {50, 92});
  for (const char letter : letters) {
    const auto count = std::ranges::count(words.words, letter, &LineWords::Word::letter);
    if (count == 0 || (letter == 'S' && limits_spindle)) continue;
    const auto last = std::ranges::find(words.words.rbegin(), words.words.rend(), letter,
                                        &LineWords::Word::letter);
    const bool is_clear =
        !words.may_be_skipped && (count == 1 || letter == 'M') && (!is_cycle || letter == 'M');
    say(letter, is_clear ? std::optional(last->value) : std::nullopt);
  }
  take_modes(words);
  take_places(words);
}

void SaidWords::take_modes(const LineWords& words) {
  // The unit of values, and the register in force after G49, depend on the control.
  if (words.has('G', {20, 21, 70, 71}) && !words.has('F') && says('F')) say('F', {});
  if (words.has('G', {49}) && !words.has('H') && says('H')) say('H', {});
  if (words.has('G', {49}) && !words.may_be_skipped) has_length_ = false;
  has_length_ |= words.has('G', {43, 44, 43.1, 43.4, 43.5, 143, 234});
  if (words.has('G', {91})) incremental_ = true;
  if (words.has('G', {90})) incremental_ = words.may_be_skipped;
  moves_frame_ |= words.has('G', {7.1, 12.1, 16, 51, 51.1, 52, 53.1, 54.2, 54.4, 68, 68.2, 92, 92.1,
                                  101, 107, 112, 254, 268});
}

void SaidWords::take_places(const LineWords& words) {
  constexpr std::string_view axes = "XYZ";
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!words.has(axes[axis])) continue;
    moves_ = true;
    if (!incremental_ && !words.may_be_skipped) placed_.at(axis) = true;
  }
}

// The unit of a number without a decimal point depends on the control.
std::optional<RegisterSetting> register_set_by(std::string_view line, bool incremental) {
  if (!has_function(line, 'G', 10, 10)) return {};
  const LineWords words = words_of(line);
  const LineWords::Word* const number = words.word('P');
  const LineWords::Word* const value = words.word('R');
  const bool is_radius = words.has('L', {12});
  if (number == nullptr || value == nullptr || !(is_radius || words.has('L', {13}))) return {};
  constexpr double most_registers = 999;
  if (!is_whole(number->value) || number->value < 1 || number->value > most_registers) return {};
  constexpr std::int64_t radii = 13'000;
  constexpr std::int64_t wears = 12'000;
  const bool adds = words.has('G', {91}) || (incremental && !words.has('G', {90}));
  const bool is_clear = !words.may_be_skipped && !adds && (!value->whole || value->value == 0);
  return RegisterSetting{
      .variable = (is_radius ? radii : wears) + static_cast<std::int64_t>(number->value),
      .value = is_clear ? std::optional(value->value) : std::nullopt};
}

bool says_plainly(std::string_view line, char letter) { return words_of(line).has(letter); }

}  // namespace trc::program
