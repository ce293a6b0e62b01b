#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/source.h"
#include "core/geometry/segment.h"
#include "core/nc/state/program_state.h"

namespace trc {

// DISCL=, mm.
struct SoftClearance {
  double distance = 0;
  bool absolute = false;  // a coordinate of the third axis

  template <class Archive>
  void serialize(Archive& archive) {
    archive(distance, absolute);
  }
};

// G147 and the like, until the block that ends where the contour begins.
struct SoftApproach {
  Lead lead{};
  std::optional<double> height{};  // of the contour, mm: the third axis
  std::optional<SoftClearance> clearance{};
  bool along_the_lead = true;  // G340
  double feed = 0;             // FAD, mm/min; 0: none
  bool rapid = false;          // how the tool came before
  double feed_before = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lead, height, clearance, along_the_lead, feed, rapid, feed_before);
  }
};

// What M70 of LinuxCNC keeps for M72.
struct KeptModes {
  bool inch = false;
  bool incremental = false;
  bool absolute_center = false;
  std::int16_t feed_mode = 94;
  double feed = 0;  // mm/min
  Plane plane = Plane::xy;
  std::int64_t work_offset = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(inch, incremental, absolute_center, feed_mode, feed, plane, work_offset);
  }
};

// A function under which coordinates mean something else. Several may be in force, each up to an
// end of its own.
struct UnfollowedMode {
  std::int32_t function = 0;  // in tenths
  std::uint32_t line = 0;
  std::string meaning{};
  std::string frame{};     // of Sinumerik: the one that scales, $P_UIFR[1]
  bool is_motion = false;  // G33 and the like: in force up to the next motion function

  template <class Archive>
  void serialize(Archive& archive) {
    archive(function, line, meaning, frame, is_motion);
  }
};

// What a program of a dialect of plain letters and numbers has in force besides.
struct GcodeModes {
  bool cycle = false;  // each position is one of a drilling cycle
  std::vector<UnfollowedMode> unfollowed{};
  bool points_seen = false;          // a coordinate had a decimal point
  bool turning = false;              // a word that only lathes have has been seen
  bool y_seen = false;               // a Y word has
  bool dimension_uncertain = false;  // the last G90 or G91 may be skipped
  bool motion_uncertain = false;     // the last G00 … G03 may be
  // In which line a tool, the data of tools, or how the contour is reached and its corners are
  // rounded was said, where that may be skipped; 0: in none.
  std::uint32_t skipped_tool = 0;
  std::uint32_t skipped_tool_data = 0;
  std::uint32_t skipped_approach = 0;
  std::uint32_t skipped_next_tool = 0;  // T in front of M06
  std::uint32_t skipped_feed = 0;       // F
  AxisBits offset_axes = 0;             // of the plane, by G43.1 of LinuxCNC
  std::optional<KeptModes> kept{};
  std::uint32_t feed_mode_line = 0;  // of the last G93 … G95
  bool program_named = false;        // by an O word
  std::uint8_t turned = 0;           // bits of unfollowed.cpp: coordinates are rotated or mirrored
  // The work offset that the program has selected, as take_work_offset() counts them; 0: not known.
  std::int64_t work_offset = 0;
  bool dynamic_offset = false;  // G254: the zero point goes with the turning axes
  std::int64_t next_tool = 0;   // T
  std::int64_t spindle_tool = 0;
  bool tool_named = false;     // by a T word
  bool spindle_empty = false;  // T0 M06
  WordPlace next_tool_place{};
  WordPlace spindle_tool_place{};
  WordPlace edge_place{};                      // of the last D word; with a new tool none
  bool edge_of_next_tool = false;              // D stands beside the last T word
  std::optional<std::int64_t> missing_tool{};  // of the last D word, which the table has not
  std::string tool_name{};                     // of T="…"
  std::string only_tool_name{};
  bool tangent_arcs = false;      // CT
  bool tangents_written = false;  // its word is in the output no longer
  bool leaves_contour = false;    // the last motion in the plane was one of a contour
  WordPlace open_corner{};        // a rounding whose next motion is still to come
  double modal_rounding = 0;      // RNDM=, mm
  double corner_feed = 0;         // FRCM=, mm/min
  // Of FANUC: the last D word, and whether it stands in the output.
  std::optional<double> last_register{};
  bool register_comes_out = true;
  bool enters_parameters = false;  // G10 L50 and L52, up to G11
  WordPlace register_place{};
  double edge = 1;             // of the tool, Sinumerik: D; 0: none
  bool changes_by_m6 = false;  // T only prepares a tool
  std::string call{};          // the last one of what only the machine has
  WordPlace call_place{};
  bool contour_seen = false;  // one has been selected
  // Since then:
  bool tool_said = false;            // by T, D or a radius
  bool call_behind_contour = false;  // `call`, which may have changed the tool
  // Of ISG: V.G.WZ_AKT.R stands behind the last T or D; a call has come behind that.
  bool only_radius_said = false;
  bool radius_doubtful = false;
  bool tool_awaits_call = false;
  std::optional<std::string> unknown_call{};  // the first one; empty: it has been told
  std::optional<Source> modal_cycle{};
  // The one register that stands for the radius of the setup, where it has no tools.
  std::optional<std::int64_t> only_register{};
  std::optional<std::int64_t> only_spindle_tool{};  // of FANUC without D words
  bool tooth_feed = false;                          // FZ= of Sinumerik, until F
  // Of polar coordinates, in the plane, in the unit of the program; without: not followed.
  std::optional<Point> pole{Point::Zero()};
  std::optional<double> polar_angle{};  // degrees
  std::optional<double> polar_radius{};
  bool polar_rewritten = false;  // one of them stands in a line that is written anew
  int soft_direction = 140;
  bool soft_in_space = true;                    // G340
  std::optional<SoftApproach> soft_approach{};  // its contour begins with the next motion

  [[nodiscard]] bool is_unfollowed(std::int32_t function) const {
    return std::ranges::find(unfollowed, function, &UnfollowedMode::function) != unfollowed.end();
  }
  // Whether it was in force.
  bool end_unfollowed(std::int32_t function) {
    return std::erase_if(unfollowed, [function](const UnfollowedMode& mode) {
             return mode.function == function;
           }) > 0;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(cycle, unfollowed, points_seen, turning, y_seen, dimension_uncertain, skipped_tool,
            skipped_tool_data, skipped_approach, turned, dynamic_offset, next_tool, spindle_tool,
            tool_name, edge, changes_by_m6, only_register, only_spindle_tool, tooth_feed, pole,
            polar_angle, polar_radius, polar_rewritten, missing_tool, only_tool_name, tangent_arcs,
            tool_named, spindle_empty, modal_rounding, soft_direction, soft_in_space, soft_approach,
            next_tool_place, spindle_tool_place, edge_place, edge_of_next_tool, offset_axes, call,
            call_place, contour_seen, tool_said, call_behind_contour, leaves_contour, open_corner,
            only_radius_said, radius_doubtful, tool_awaits_call, unknown_call, modal_cycle,
            last_register, register_comes_out, enters_parameters, register_place, tangents_written,
            corner_feed, work_offset, program_named, feed_mode_line, kept, motion_uncertain,
            skipped_next_tool, skipped_feed);
  }
};

}  // namespace trc
