#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/state/block.h"

namespace trc {

// The length that a refused block needs under G236, mm along itself, and that a line in its last
// (first) direction would need; none: no length is enough, or the length is not at fault.
struct NeededLength {
  std::optional<double> along_itself{};
  std::optional<double> straight{};
};

struct WayIn {
  NeededLength needed{};
};

struct WayOut {
  NeededLength needed{};
  // The cut of the corner before it from the last contour block, as in PathBlock.
  double cut_at_start = 0;
};

// A way in under G238, which needs no length but a free start.
struct WayIntoCorner {
  Point target = Point::Zero();      // where it meets the equidistant
  bool starts_on_tool_side = false;  // of the first block, as it then has to (rule 3.5)
};

// A way in where loops are removed; the leads at the start of the contour are left out.
struct WayPastLeads {
  bool at_begin = false;      // nothing of the contour can be travelled
  std::size_t leads_in = 0;   // number of leads left out
  std::size_t leads_out = 0;  // number of blocks at the end that are no walls
};

// A way in that is not at fault: the whole contour is known, and begins and closes in an inside
// corner, where the tool has no room beside the start (rule 3.2).
struct WayBesideCorner {};

// The facts that the pass refusing a selection or deselection block knows, for finding a way in its
// place.
struct RefusedWay {
  // A way in: the selection block and the contour after it as far as it is known. A way out: the
  // last contour block and the deselection block.
  std::vector<MotionBlock> blocks{};
  double shift = 0;  // mm to the left of the contour; negative: right
  std::variant<WayIn, WayOut, WayIntoCorner, WayPastLeads, WayBesideCorner> kind{};

  [[nodiscard]] bool leaves() const { return std::holds_alternative<WayOut>(kind); }
  [[nodiscard]] NeededLength needed_length() const {
    if (const auto* in = std::get_if<WayIn>(&kind)) return in->needed;
    if (const auto* out = std::get_if<WayOut>(&kind)) return out->needed;
    return {};
  }
  // Without any where loops are kept.
  [[nodiscard]] WayPastLeads leads() const {
    const auto* past = std::get_if<WayPastLeads>(&kind);
    return past != nullptr ? *past : WayPastLeads{};
  }
};

}  // namespace trc
