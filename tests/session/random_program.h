#pragma once

#include <cstdint>
#include <string>

namespace trc::support {

// A program of motions in every spelling the reader knows: planes, G90 and G91,
// G161 and G162, mm and inch, arcs and full circles, third axis and tracking
// axes, modal words left out, technology and comments in between.
//
// Seeds give the same program everywhere. With `compensated`, stretches of it run under
// G41 or G42 with radii small against the contour; a few are refused all the same.
[[nodiscard]] std::string random_program(std::uint64_t seed, bool compensated);

}  // namespace trc::support
