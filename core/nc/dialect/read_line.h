#pragma once

#include "core/nc/dialect/reading.h"

namespace trc {

// Reads a whole line, its words and what they say, and tells the state what it means.
// Returns whether reading goes on.
bool read_line(Reading& reading, ProgramLine& line);

}  // namespace trc
