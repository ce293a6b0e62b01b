#pragma once

#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/gcode_words.h"

namespace trc {

// Refuses the word, at its place; `meaning` says why.
bool refuse_word(Reading& reading, const ProgramLine& line, const GcodeWord& word, Code code,
                 std::string_view meaning = {});

// Reads all words, also after one that is refused, so that every obstacle is reported. Stops at the
// largest number of reports, since each byte of a long line may be an obstacle.
bool read_gcode_words(Reading& reading, ProgramLine& line, BlockWords& block);

// Enters one word into `block`.
bool read_gcode_word(Reading& reading, const GcodeWord& word, ProgramLine& line, BlockWords& block);

}  // namespace trc
