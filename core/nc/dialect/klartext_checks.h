#pragma once

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Checks the words against the modes in force, and whether the block is followed.
bool check_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block);

// Checks which words need another one, and which exclude each other.
bool check_words_together(Reading& reading, const ProgramLine& line, const KlartextBlock& block);

// RND and CHF where a contour begins or ends: what comes before them or after them is no motion of
// the contour (D-171). Also while the text after a fault is only searched for further ones.
bool check_corners_at_ends(Reading& reading, const ProgramLine& line, const KlartextBlock& block);

// As in the G code dialects: RND may not round into the approach, which TRC makes another line.
bool check_corner_before(Reading& reading, const ProgramLine& line, const KlartextBlock& block);

}  // namespace trc
