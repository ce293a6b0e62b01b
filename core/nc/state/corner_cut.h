#pragma once

#include <cstdint>
#include <optional>

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"

namespace trc {

// What a program does to the corner behind a straight motion: ,R ,C of Fanuc, RND= CHF= CHR= of
// Sinumerik.
struct CornerCut {
  enum class Form : std::uint8_t { round, leg, width };
  Form form = Form::round;
  double size = 0;  // mm: the radius, how much either line loses, the length of the chamfer

  template <class Archive>
  void serialize(Archive& archive) {
    archive(form, size);
  }
};

struct CutCorner {
  Point end_before = Point::Zero();
  Point start_after = Point::Zero();
  Segment between{};
};

// Nothing where the lines have no room for it, or turn back.
[[nodiscard]] std::optional<CutCorner> cut_corner(const Line& before, const Line& after,
                                                  const CornerCut& cut,
                                                  const Tolerances& tolerances);

}  // namespace trc
