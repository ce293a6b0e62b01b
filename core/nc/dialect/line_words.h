#pragma once

#include <cstdint>

#include "core/nc/state/program_line.h"

namespace trc {

// Notes what a word is: of any kind that says where it begins and ends.
template <class Word>
void add(ProgramLine& line, const Word& word, WordRole role) {
  line.words.push_back({.begin = word.begin, .end = word.end, .role = role});
}

// Where the first word of a line begins; 0: the line has none, as with a sign of its end alone.
[[nodiscard]] inline std::uint32_t begin_of_words(const ProgramLine& line) {
  return line.words.empty() ? 0 : line.words.front().begin;
}

// Words of `role` turn out to say nothing about the path.
inline void take_for_technology(ProgramLine& line, WordRole role) {
  for (WordRange& word : line.words)
    if (word.role == role) word.role = WordRole::technology;
}

}  // namespace trc
