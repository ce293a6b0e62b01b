#pragma once

#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/code_words.h"

namespace trc {

// At the place of the word; `meaning` says why.
bool refuse_code(Reading& reading, const ProgramLine& line, const CodeWord& word, Code code,
                 std::string_view meaning = {});

// All words are read, also behind one that is refused, so that every obstacle is told: up to as
// many as are told at all, since each byte of a long line may be one.
bool read_code_words(Reading& reading, ProgramLine& line, BlockWords& block);

// One word takes its place in `block`.
bool read_code_word(Reading& reading, const CodeWord& word, ProgramLine& line, BlockWords& block);

}  // namespace trc
