#pragma once

#include <string>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/g_function.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Enters each word into `block`.
bool read_isg_words(Reading& reading, ProgramLine& line, BlockWords& block);

// G54, with the reason why it is refused.
[[nodiscard]] std::string named(const GFunction& function, std::string_view why);

}  // namespace trc
