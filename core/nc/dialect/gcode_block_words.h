#pragma once

#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/gcode_words.h"

namespace trc {

// At the place of the word; `meaning` says why.
bool refuse_word(Reading& reading, const ProgramLine& line, const GcodeWord& word, Code code,
                 std::string_view meaning = {});

// All words are read, also behind one that is refused, so that every obstacle is told: up to as
// many as are told at all, since each byte of a long line may be one.
bool read_gcode_words(Reading& reading, ProgramLine& line, BlockWords& block);

// One word takes its place in `block`.
bool read_gcode_word(Reading& reading, const GcodeWord& word, ProgramLine& line, BlockWords& block);

}  // namespace trc
