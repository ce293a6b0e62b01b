#pragma once

#include <string>
#include <vector>

#include "core/base/entry_help.h"
#include "core/base/language.h"
#include "core/nc/state/dialect_name.h"

namespace trc::cli {

// How the program that was refused is written.
struct Writing {
  DialectName dialect = DialectName::isg;
  bool inch = false;
  Language language = Language::english;
};

// Proposals in place of a refused approach or retract, in words and as lines of the program:
//
//   the approach is 3.000 mm long and needs at least 5.000 mm; it may start at X-5 Y0
//   proposed entry, quarter circle, in mm: G0 X5 Y20, G1 X-15 Y20 with G41 or G42 as before, G3 X5
//   Y0 R20, G1
//
// For Klartext no lines are given, since it writes arcs and coordinates with other words.
[[nodiscard]] std::vector<std::string> lines_of(const EntryHelp& help, const Writing& writing);

}  // namespace trc::cli
