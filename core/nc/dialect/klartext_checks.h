#pragma once

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// What the words must be as the program stands, and whether the block is followed.
bool check_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block);

// Which words need another, and which exclude each other.
bool check_words_together(Reading& reading, const ProgramLine& line, const KlartextBlock& block);

// As for the dialects of G code: the approach is another line than the one that RND rounds into.
bool check_corner_before(Reading& reading, const ProgramLine& line, const KlartextBlock& block);

}  // namespace trc
