#pragma once

#include <memory_resource>
#include <vector>

#include "core/geometry/segment.h"

namespace trc {

// A place where two blocks of a contour touch or cross.
struct Contact {
  double along_first = 0;   // mm from the start of the one
  double along_second = 0;  // and of the other
  double gap = 0;           // mm between the two places
  Point point = Point::Zero();
};

// Finds where the two cross, and where an end of one is within `tolerance` of the other. For a
// common stretch these are its two ends.
void find_contacts(const Segment& first, const Segment& second, double tolerance,
                   std::pmr::vector<Contact>& found);

}  // namespace trc
