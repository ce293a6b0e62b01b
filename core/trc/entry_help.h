#pragma once

#include <memory>

#include "core/base/entry_help.h"
#include "core/trc/result/refused_way.h"
#include "core/trc/setup.h"

namespace trc::selection {

// Looks for ways in place of a refused one:
//
//   the line, as long as it has to be      a quarter circle from about the tool side
//
//        start                                  start = C -------- A      |C E| = 1.2 … 5 R
//          \                                      |                |
//           \                                     |               /
//   ---------E======== contour                    E =====<=======  contour
//
// Where loops are removed and the start cannot be passed, the circle also replaces the leads
// at the start. Under G238 the proposal is a free start point near the programmed one. A
// contour that begins in an inside corner can only be entered as under G238, which is
// proposed in place of G138 and G139. Each proposal is compensated with the known contour,
// in a Compensator of its own, and its path is measured against it: a proposal that is
// refused or comes nearer than the tool radius is not offered. Null: there is no useful
// proposal.
//
// It takes time only after a refusal.
[[nodiscard]] std::shared_ptr<const EntryHelp> help_with(const RefusedWay& refused,
                                                         const CompensatorSetup& setup);

}  // namespace trc::selection
