#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/base/source.h"
#include "core/geometry/segment.h"
#include "core/nc/state/trc_mode.h"

namespace trc {

// Absolute start and end of one axis in one block, mm (or the axis' own unit).
struct AxisTravel {
  double from = 0;
  double to = 0;

  [[nodiscard]] bool moves() const { return from != to; }
  bool operator==(const AxisTravel&) const = default;
};

// One entry per tracking axis of the session, in the order of its setup; empty
// when the session has none or none was ever programmed.
using TrackingTravel = std::vector<AxisTravel>;

// Whether a block bounds material, where its programmer says so (D-38).
enum class ContourRole : std::uint8_t { unspecified, wall, lead };

// A relevant block: it moves in the compensation plane. Absolute, mm, circles
// checked.
struct MotionBlock {
  Source source{};
  Segment path{};
  AxisTravel normal{};  // the third main axis, across the plane
  double feed = 0;      // mm/min as programmed; 0: none programmed yet
  bool rapid = false;
  ContourRole role = ContourRole::unspecified;
  std::shared_ptr<const TrcMode> mode{};
  TrackingTravel tracking{};
};

// A passive block (rule 10.1): technology words, dwell, motion
// across the plane, tracking axes alone, no length (D-29). It keeps its place.
struct PassiveBlock {
  Source source{};
  std::string text{};  // passed through, never interpreted; may be empty
  AxisTravel normal{};
  double feed = 0;
  bool rapid = false;
  bool moves = false;  // third main axis or tracking axes travel
  std::shared_ptr<const TrcMode> mode{};
  TrackingTravel tracking{};
};

using Block = std::variant<MotionBlock, PassiveBlock>;

// Source::index of the block.
[[nodiscard]] inline std::uint64_t index_of(const Block& block) {
  const auto* motion = std::get_if<MotionBlock>(&block);
  return motion != nullptr ? motion->source.index : std::get<PassiveBlock>(block).source.index;
}

}  // namespace trc
