#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// They are accepted only in a line of their own, outside of contours. So no rule is needed for how
// they combine with other words of a line or with G40 … G42.
bool check_kept_modes(Reading& reading, ProgramLine& line, const BlockWords& block);

// M70 of LinuxCNC keeps what is in force, M72 brings it back, M71 forgets it (D-113).
bool apply_kept_modes(Reading& reading, const ProgramLine& line, const BlockWords& block);

}  // namespace trc
