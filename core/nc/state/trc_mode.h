#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry/plane.h"

namespace trc {

// The side of the contour the tool runs on, seen along the direction of travel.
enum class Side : std::uint8_t { off, left, right };

constexpr Side opposite(Side side) {
  if (side == Side::off) return side;
  return side == Side::left ? Side::right : Side::left;
}

// How TRC is selected and deselected: G138, G139 (initial), G236 … G239.
enum class Selection : std::uint8_t {
  direct,         // G138
  indirect,       // G139
  on_path,        // G236
  perpendicular,  // G237
  inside_corner,  // G238
  without_block,  // G239
};

// What is inserted at outside corners: G25 (initial) or G26.
enum class Transition : std::uint8_t { linear, circular };

// G140 (initial): a contour violation stops. G141: what cannot be cut is masked.
enum class Masking : std::uint8_t { off, on };

// Where the programmed feed applies: at the tool centre (G10, initial), at the contact point of
// tool and contour (G11), or at the contact point on inside arcs only (CFIN, M110).
enum class FeedAdaptation : std::uint8_t { off, on, inside };

// SPLIT words: the feed of the parts next to the contour, rule 7.2.
struct SplitOption {
  enum class Where : std::uint8_t { off, pre, post, combined };
  Where where = Where::off;
  bool along_path = false;  // SPLIT_PATH; else distances count along `axis`
  std::uint8_t axis = 0;    // 0-based main axis of SPLIT's AX= / AXNR=
  double distance_1 = 0;    // mm
  double feed_1 = 0;        // mm/min
  double distance_2 = 0;    // mm; 0: one part only
  double feed_2 = 0;        // mm/min

  bool operator==(const SplitOption&) const = default;
};

// The `#TRC` options, one field per keyword (rule 7), with their defaults.
struct TrcOptions {
  bool conv_cir_to_lin = false;
  bool kerf_masking = false;
  bool reverse = false;
  bool ignore_cont_damage = false;
  bool remove_masked_blocks = false;
  bool ext_angle_block_intersection = false;
  bool g236_lin = false;
  double stretch_factor = 1;    // 1 … 9, real (D-07)
  double tangential_limit = 3;  // degrees, 0.1 … 3
  bool perpendicular_radius_change = false;
  bool gen_cir_block_in_corner = false;
  bool suppress_trc = false;
  bool inverse = false;
  SplitOption split{};

  bool operator==(const TrcOptions&) const = default;
};

// The modal state a motion block was programmed under. Each block carries a
// share of it, so that no pass has to ask anyone else.
struct TrcMode {
  Plane plane = Plane::xy;
  Side side = Side::off;   // after a negative radius has swapped it
  double tool_radius = 0;  // mm, never negative; distance from program to path (D-43)
  // Wear mode: the program is the centre path of a tool with this radius, mm; 0: the contour.
  double nominal_radius = 0;
  bool below_nominal = false;  // the tool is smaller than that: `side` is swapped for it
  // Counts the selections of the program from 1; 0 while off. Two blocks of one
  // side with different numbers have a deselection between them.
  std::uint32_t selection_number = 0;
  Selection selection = Selection::indirect;
  // The mode that was in force at the last G40; it governs the retract even when
  // another mode is programmed before the retract block (rule 1.10).
  Selection deselection = Selection::indirect;
  bool tangential = false;     // G05 in this block's selection or deselection
  bool from_anywhere = false;  // the block is an approach whose start nobody knows (D-170)
  // KONT: under `indirect` the way to and from an outside corner touches the circle round it, D-51.
  bool touches_corner_circle = false;
  Transition transition = Transition::linear;
  Masking masking = Masking::off;
  FeedAdaptation feed_adaptation = FeedAdaptation::off;
  double tangfeed_minimum = 0;  // #TANGFEED RMIN, mm; 0: adapt always
  TrcOptions options{};

  [[nodiscard]] bool active() const { return side != Side::off; }
  // G05 makes an arc of the selection or deselection block; SUPPRESS_TRC keeps the programmed path
  // (D-155).
  [[nodiscard]] bool becomes_arc() const { return tangential && !options.suppress_trc; }
  // Violating loops are taken out of the whole contour, instead of blocks masked one by one. Not
  // below the nominal radius of wear mode: a smaller tool keeps clear of the part wherever the
  // nominal one does, and the centre path it leaves towards the part is no wall.
  [[nodiscard]] bool removes_loops() const {
    return masking == Masking::on && options.remove_masked_blocks && !below_nominal;
  }
  // The radius that cuts where the path is `beside` mm away from the program: that distance, or in
  // wear mode the nominal radius changed by it.
  [[nodiscard]] double cutting_radius(double beside) const {
    if (nominal_radius == 0) return beside;
    return below_nominal ? nominal_radius - beside : nominal_radius + beside;
  }
  [[nodiscard]] double cutting_radius() const { return cutting_radius(tool_radius); }
  // The side of the contour that the tool cuts on: below the nominal radius the path has moved to
  // the other side.
  [[nodiscard]] Side cutting_side() const { return below_nominal ? opposite(side) : side; }
  // The radius on the part of an arc with this programmed radius.
  [[nodiscard]] double part_radius(double programmed, bool centre_on_tool_side) const {
    return centre_on_tool_side ? programmed + nominal_radius : programmed - nominal_radius;
  }
  bool operator==(const TrcMode&) const = default;
};

}  // namespace trc
