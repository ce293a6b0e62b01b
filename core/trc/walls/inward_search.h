#pragma once

#include <memory_resource>
#include <optional>
#include <span>

#include "core/trc/walls/closing.h"

namespace trc {

// The blocks that an overrun goes along: those at the start of the contour, or of the last lap, as
// laps may differ at their corners.
enum class Overruns { along_the_begin, along_the_last_lap };

// Meetings from the outermost one inward.
struct MeetingsOfEnds {
  std::span<const EndsMeeting> may_close{};  // the contour may close in one of these
  std::span<const EndsMeeting> all{};        // an overrun may begin in one of these
};

// Finds where a contour closes.
[[nodiscard]] std::optional<Closing> search_inward(const ContourView& contour,
                                                   const MeetingsOfEnds& meetings, double tolerance,
                                                   Overruns overruns,
                                                   std::pmr::memory_resource* memory);

}  // namespace trc
