#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

namespace trc {

// DISR=, DISCL=, FAD= and DISRP=.
bool read_soft_word(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

// Decides whether the block leads to or from a contour, or is copied as a block without TRC.
bool take_soft_lead(Reading& reading, ProgramLine& line, BlockWords& block);

// The motions from P0 to P4, each a block of its own.
bool approach_softly(Reading& reading, ProgramLine& line, BlockWords& block);

// The contour begins where this block ends: that of the approach itself, or the next motion.
bool begin_contour_of_approach(Reading& reading, ProgramLine& line, BlockWords& block);

// The motions from P4 to P0; G40 comes after them.
bool depart_softly(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
