#pragma once

#include <optional>

#include "core/nc/dialect/reading.h"

namespace trc {

// Whether the program goes on after the block; nothing where the block is not plain.
std::optional<bool> take_plain_klartext(Reading& reading, ProgramLine& line);

}  // namespace trc
