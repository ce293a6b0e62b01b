#pragma once

#include <memory_resource>
#include <optional>
#include <span>

#include "core/trc/walls/closing.h"

namespace trc {

// What an overrun goes along: the begin of the contour, or that of the last lap, as laps may differ
// at their corners.
enum class Overruns { along_the_begin, along_the_last_lap };

// Where a contour closes, of the meetings of its ends that it may close in; `all`: all of them,
// from the outermost one inward, among which an overrun may begin.
[[nodiscard]] std::optional<Closing> search_inward(const ContourView& contour,
                                                   std::span<const EndsMeeting> may_close,
                                                   std::span<const EndsMeeting> all,
                                                   double tolerance, Overruns overruns,
                                                   std::pmr::memory_resource* memory);

}  // namespace trc
