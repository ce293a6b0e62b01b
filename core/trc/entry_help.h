#pragma once

#include <memory>

#include "core/base/entry_help.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/setup.h"

namespace trc::selection {

// Looks for ways that would do in place of a refused one:
//
//   the line, as long as it has to be      a quarter circle from about the tool side
//
//        start                                  start = C -------- A      |C E| = 1.2 … 5 R
//          \                                      |                |
//           \                                     |               /
//   ---------E======== contour                    E =====<=======  contour
//
// Where loops are removed and there is no way past the begin, the circle takes the place of the
// leads at the begin, too. Under G238 it is a start point that is free, near to the one programmed.
// A contour that begins in an inside corner has no way in but that of G238, which is proposed in
// place of G138 and G139.
// Each is compensated with the contour that is known, in a Compensator of its own, and its path
// measured against that: what is refused or comes nearer than the tool radius is not offered. Null:
// nothing is known of use.
//
// Only what was refused costs anything.
[[nodiscard]] std::shared_ptr<const EntryHelp> help_with(const RefusedWay& refused,
                                                         const CompensatorSetup& setup);

}  // namespace trc::selection
