#include "core/verify/disk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trc::verify {

// Start and end of an arc may lie on circles that differ a little.
Disk disk_of(const Piece& piece) {
  if (std::abs(piece.sweep) > std::numbers::pi)
    return {.center = piece.center,
            .radius = std::max(piece.radius(), (piece.end - piece.center).norm())};
  Disk disk{.center = 0.5 * (piece.start + piece.end),
            .radius = 0.5 * (piece.end - piece.start).norm()};
  if (piece.is_arc()) disk.radius += std::abs(piece.radius() - (piece.end - piece.center).norm());
  return disk;
}

}  // namespace trc::verify
