#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Words with a value after `=`, names, and the plain ones.
bool read_named_words(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
