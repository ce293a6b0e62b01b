#pragma once

#include <span>

#include "core/verify/clearance.h"

namespace trc::support {

// What verify::measure_clearance has to find: every block of the path against every wall of its
// selection, one pair after the other.
[[nodiscard]] verify::ClearanceReport slow_verification(std::span<const Block> programmed,
                                                        std::span<const CompensatedBlock> path,
                                                        double allowed,
                                                        const LeadSettings& leads = {});

}  // namespace trc::support
