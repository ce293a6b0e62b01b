#pragma once

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/klartext_words.h"

namespace trc {

// Reads an M word.
bool read_klartext_function(Reading& reading, const KlartextWord& word, ProgramLine& line,
                            KlartextBlock& block);

}  // namespace trc
