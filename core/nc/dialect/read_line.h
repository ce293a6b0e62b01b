#pragma once

#include "core/nc/dialect/reading.h"

namespace trc {

// Reads a whole line and its words, and tells the state what they mean. Returns whether reading
// goes on.
bool read_line(Reading& reading, ProgramLine& line);

}  // namespace trc
