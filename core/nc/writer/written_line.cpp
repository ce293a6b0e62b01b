#include <algorithm>

#include "core/nc/text/characters.h"
#include "core/nc/writer/nc_writer.h"
#include "core/nc/writer/written_block.h"

// Makes lines of the output from words, with block number and line end.

namespace trc {
namespace {

// The digits after the point of a number at the end of the word.
int decimals_in(std::string_view word) {
  std::size_t begin = word.size();
  while (begin > 0 && is_digit(word[begin - 1])) --begin;
  return begin > 0 && word[begin - 1] == '.' ? static_cast<int>(word.size() - begin) : 0;
}

}  // namespace

// In a continued block words may follow a `;` comment, and each line may have an N word: the first
// one is that of the block.
void NcWriter::append(const ProgramLine& line, const WordRange& word) {
  if (word.role == WordRole::number && &word != &line.words.front()) {
    const auto first = std::ranges::find(line.words, WordRole::number, &WordRange::role);
    if (&*first != &word) return;
  }
  const bool ends_line = word.role == WordRole::comment && line.text[word.begin] == ';';
  TextBuffer& words = ends_line ? last_comment_ : words_;
  words.append(' ');
  if (word.role == WordRole::number && renumbers_) return append_number(line, word, words);
  words.append(line.word(word));
}

void NcWriter::write_line(const ProgramLine& line, std::string& out) {
  const auto number = renumbers_ ? std::ranges::find(line.words, WordRole::number, &WordRange::role)
                                 : line.words.end();
  if (number == line.words.end()) return write_text(line.text, line.line_end, out);
  begin_words();
  words_.append(std::string_view(line.text).substr(0, number->begin));
  append_number(line, *number, words_);
  words_.append(std::string_view(line.text).substr(number->end));
  write_text(words_.view(), line.line_end, out);
}

// The first number is that of the program.
void NcWriter::append_number(const ProgramLine& line, const WordRange& word, TextBuffer& words) {
  if (!numbered_ && line.source.number != Source::no_number)
    next_number_ = static_cast<std::uint64_t>(line.source.number);
  numbered_ = true;
  const char sign = line.text[word.begin];
  if (!is_digit(sign)) words.append(sign);
  words.append(take_number());
}

void NcWriter::append_number_of_inserted() {
  if (!renumbers_ || !numbered_) return;
  words_.append(klartext_ ? " " : " N");
  words_.append(take_number());
}

// All controls accept five digits (D-60).
std::string NcWriter::take_number() {
  constexpr std::uint64_t largest = 99'990;
  const std::uint64_t number = next_number_;
  next_number_ += klartext_ ? 1 : 10;
  if (next_number_ > largest && !klartext_) next_number_ = 10;
  return std::to_string(number);
}

void NcWriter::follow_decimals(const ProgramLine& line) {
  if (!follows_decimals_ || line.is_computed) return;
  int most = 0;
  for (const WordRange& range : line.words)
    if (range.role == WordRole::coordinate) most = std::max(most, decimals_in(line.word(range)));
  const int more = most - motions_.decimals_of(line.unit);
  if (more > 0)
    motions_.write_at_least(
        std::min(motions_.decimals_of(LengthUnit::mm) + more, limits_.decimals));
}

// A control that has read a number of the program reads others like it.
void NcWriter::follow_digits(const ProgramLine& line) {
  if (limits_.digits == LineLimits::any_number || line.is_computed) return;
  const int before = limits_.digits;
  for (const WordRange& range : line.words)
    if (range.role == WordRole::coordinate)
      limits_.digits = std::max(
          limits_.digits, static_cast<int>(std::ranges::count_if(line.word(range), is_digit)));
  if (limits_.digits > before) motions_.allow_digits(limits_.digits);
}

bool NcWriter::check_limits() {
  const std::size_t characters = words_.empty() ? 0 : words_.view().size() - 1;
  if (characters > limits_.characters)
    excess_ = {.of = Excess::Of::characters, .count = characters, .limit = limits_.characters};
  else if (motions_.digits_written() > 0)
    excess_ = {.of = Excess::Of::digits,
               .count = static_cast<std::size_t>(motions_.digits_written()),
               .limit = static_cast<std::size_t>(limits_.digits)};
  return !excess_;
}

void NcWriter::write_words(std::string_view line_end, std::string& out) {
  if (!last_comment_.empty()) words_.append(last_comment_.view());
  if (excess_ || !check_limits()) return;
  if (line_end.empty()) return write_text(words_.view().substr(1), line_end, out);
  end_line_before(out);
  if (line_end.size() == 1) {
    words_.append(line_end.front());
  } else {
    words_.append(line_end);
  }
  out += words_.view().substr(1);
  line_end_ = line_end;
}

void NcWriter::write_text(std::string_view text, std::string_view line_end, std::string& out) {
  if (excess_) return;
  end_line_before(out);
  out += text;
  out += line_end;
  if (!line_end.empty()) {
    line_end_ = line_end;
  } else {
    line_end_missing_ = text != byte_order_mark;
  }
}

}  // namespace trc
