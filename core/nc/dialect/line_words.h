#pragma once

#include <cstdint>

#include "core/nc/state/program_line.h"

namespace trc {

// Records the role of a word, of any type with `begin` and `end`.
template <class Word>
void add(ProgramLine& line, const Word& word, WordRole role) {
  line.words.push_back({.begin = word.begin, .end = word.end, .role = role});
}

// Where the first word of a line begins; 0: the line has none, as with an end sign only.
[[nodiscard]] inline std::uint32_t begin_of_words(const ProgramLine& line) {
  return line.words.empty() ? 0 : line.words.front().begin;
}

// Words of `role` turn out not to affect the path.
inline void take_for_technology(ProgramLine& line, WordRole role) {
  for (WordRange& word : line.words)
    if (word.role == role) word.role = WordRole::technology;
}

}  // namespace trc
