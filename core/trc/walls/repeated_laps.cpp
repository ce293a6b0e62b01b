#include "core/trc/walls/repeated_laps.h"

#include <cmath>
#include <variant>

#include "core/base/tolerances.h"

namespace trc {
namespace {

bool are_same(const Segment& one, const Segment& other, const Tolerances& tolerances) {
  const double near = tolerances.on_contour;
  const auto* arc = std::get_if<Arc>(&one);
  const auto* other_arc = std::get_if<Arc>(&other);
  if ((arc == nullptr) != (other_arc == nullptr)) return false;
  if ((start_of(one) - start_of(other)).norm() > near) return false;
  if ((end_of(one) - end_of(other)).norm() > near) return false;
  return arc == nullptr || ((arc->center - other_arc->center).norm() <= near &&
                            std::signbit(arc->sweep) == std::signbit(other_arc->sweep));
}

bool repeats(const ContourView& contour, std::size_t blocks) {
  for (std::size_t number = blocks; number < contour.count; ++number) {
    contour.pass();
    if (!are_same(contour.segment(number), contour.segment(number - blocks), contour.tolerances))
      return false;
  }
  return true;
}

}  // namespace

std::optional<RepeatedLaps> repeated_laps(const ContourView& contour) {
  // If the first block comes again this often without the contour repeating itself, the search
  // ends.
  constexpr int most_tries = 8;
  if (contour.count < 2) return std::nullopt;
  const Segment first = contour.segment(0);
  int tries = 0;
  for (std::size_t blocks = 1; blocks < contour.count && tries < most_tries; ++blocks) {
    contour.pass();
    if (!are_same(contour.segment(blocks), first, contour.tolerances)) continue;
    ++tries;
    if (repeats(contour, blocks))
      return RepeatedLaps{.blocks = blocks, .last = (contour.count - 1) / blocks * blocks};
  }
  return std::nullopt;
}

}  // namespace trc
