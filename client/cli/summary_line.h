#pragma once

#include <string>

#include "core/base/language.h"
#include "core/base/length_unit.h"
#include "proto/wire/path_item.h"

namespace trc::cli {

// The result of a program in one line without line end: "1,204 blocks, 3 masked, clearance 6.000
// mm at N120, 0.04 s". The blocks are those that came out; the clearance is the smallest that
// was measured, in the unit of the setup, and left out where nothing was; seconds are as on a
// watch.
[[nodiscard]] std::string summary_line(const wire::PathSummary& summary, LengthUnit unit,
                                       double seconds, Language language);

// No block was compensated, and no warning says why.
[[nodiscard]] bool compensates_nothing(const wire::PathSummary& summary);

}  // namespace trc::cli
