#pragma once

#include <cstdint>
#include <optional>

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"

namespace trc {

// What a program does to the corner after a motion: ,R ,C of Fanuc, RND= CHF= CHR= of Sinumerik,
// RND CHF of Heidenhain.
struct CornerCut {
  // open: a later line may still give the form.
  enum class Form : std::uint8_t { round, leg, width, open };
  Form form = Form::round;
  double size = 0;     // mm: the radius, how much either line loses, the length of the chamfer
  bool modal = false;  // applies to every corner

  template <class Archive>
  void serialize(Archive& archive) {
    archive(form, size, modal);
  }
};

struct CutCorner {
  Segment before{};  // a point where the corner consumes it all; so may `after` be
  Segment between{};
  Segment after{};
};

// Whether the contour runs back where it came from: no circle touches both motions there.
[[nodiscard]] bool turns_back(const Segment& before, const Segment& after);

// Nothing where the motions have no room for it, turn back or touch. Chamfers are made between
// lines only: controls differ in what a chamfer next to an arc is.
[[nodiscard]] std::optional<CutCorner> cut_corner(const Segment& before, const Segment& after,
                                                  const CornerCut& cut,
                                                  const Tolerances& tolerances);

}  // namespace trc
