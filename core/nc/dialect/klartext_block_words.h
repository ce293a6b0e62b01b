#pragma once

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Reads all words after the block number, also after one that is refused.
bool read_klartext_words(Reading& reading, ProgramLine& line, KlartextBlock& block);

}  // namespace trc
