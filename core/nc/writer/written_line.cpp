#include "core/nc/text/characters.h"
#include "core/nc/writer/nc_writer.h"
#include "core/nc/writer/written_block.h"

// Makes lines of the output from words, with block number and line end.

namespace trc {

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

void NcWriter::write_words(std::string_view line_end, std::string& out) {
  if (!last_comment_.empty()) words_.append(last_comment_.view());
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
