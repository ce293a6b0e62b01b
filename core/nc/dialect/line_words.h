#pragma once

#include "core/nc/state/program_line.h"

namespace trc {

// Notes what a word is: of any kind that says where it begins and ends.
template <class Word>
void add(ProgramLine& line, const Word& word, WordRole role) {
  line.words.push_back({.begin = word.begin, .end = word.end, .role = role});
}

}  // namespace trc
