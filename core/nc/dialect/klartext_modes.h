#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/segment.h"
#include "core/nc/dialect/klartext_effects.h"
#include "core/nc/state/program_state.h"

namespace trc {

// The number of contours selected before a label, and before its LBL 0.
struct ContoursOfLabel {
  std::uint64_t before = 0;
  std::optional<std::uint64_t> behind{};
  std::uint32_t steps = 0;                                   // of KlartextModes::section, before it
  KlartextEffects leaves{.unsure = KlartextMode::anything};  // known after its LBL 0

  // `now`: the present number, used where no LBL 0 has come yet.
  [[nodiscard]] bool has_contour(std::uint64_t now) const { return behind.value_or(now) != before; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(before, behind, steps, leaves);
  }
};
// Further modes of a program in Klartext.
struct KlartextModes {
  // Where the last motion in the plane stands in its contour.
  enum class ContourStart : std::uint8_t {
    none,       // within it, or there is none
    to_come,    // after RL or RR without a motion
    by_motion,  // it is the motion with RL or RR
    by_lead,    // it is APPR
  };

  std::optional<Point> pole{};           // CC, mm, in the plane
  Source pole_lost{};                    // by what, where it is not known; line 0: none was given
  AxisBits pole_across = 0;              // of a CC across the plane: its axes
  std::optional<double> polar_radius{};  // PR, mm
  std::optional<Vector> tangent{};       // after the last motion in the plane, of any length
  bool rapid = false;                    // the last motion was one with FMAX
  double feed_before = 0;                // in force before the block
  double called_feed = 0;                // F AUTO, mm/min
  bool feed_of_control = false;          // in force, with a value that only the control knows: FQ5
  bool feed_per_turn = false;            // M136
  bool modal_cycle = false;              // M89
  std::uint32_t unfollowed = 0;  // scales coordinates or guides the tool: bits of KlartextLead
  // Those of them that scale the plane by one factor, and that factor (D-175).
  std::uint32_t scaling = 0;
  double scale = 1;
  // Of TOOL CALL.
  std::optional<std::int64_t> tool{};
  double radius_delta = 0;   // DR, mm
  std::string open_delta{};  // DR+Q5 of a parameter whose value is not known
  // Q parameters that the program has set to a number since the last label or call.
  std::map<std::string, double, std::less<>> parameters{};
  std::string tool_name{};  // in quotes, or a parameter
  WordPlace tool_place{};
  std::string only_tool_name{};
  // How many contours have been selected, and which labels were called before their LBL was
  // read.
  std::uint64_t contours = 0;
  std::map<std::string, ContoursOfLabel> labels{};
  std::map<std::string, std::uint32_t> calls{};
  std::uint32_t called_section = 0;        // the line that called it; 0: not in one
  std::vector<std::string> open_labels{};  // up to the next LBL 0
  KlartextSection section{};
  std::uint32_t unfollowed_call = 0;  // the line of a call whose effects nobody knows
  std::uint32_t tool_of_label = 0;    // the line of a call that has changed the tool
  std::uint32_t jump = 0;             // the line of the first jump to a label
  // Labels whose contours cycle 14 or CONTOUR DEF names, with the line that does, and that line
  // while one of them is read.
  std::map<std::string, std::uint32_t> labels_of_cycles{};
  std::uint32_t cycle_section = 0;
  WordPlace open_corner{};        // RND, CHF whose next motion is still to come
  bool behind_corner = false;     // no motion has come since RND or CHF
  bool after_number = false;      // the line before is a block with a number, or the rest of one
  bool after_blank = false;       // BLK FORM was the last block
  bool program_is_cycle = false;  // one that may be called without its name (D-175)
  bool in_columns = false;        // blocks with a number go on in indented lines without one
  ContourStart start{};
  // RND, CHF of a contour whose next motion is still to come.
  WordPlace corner_in_contour{};
  std::string corner_name{};
  // Contours selected before the last CC outside of contours: that CC is in the output.
  std::optional<std::uint64_t> pole_said{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(pole, polar_radius, tangent, rapid, called_feed, feed_per_turn, modal_cycle, unfollowed,
            tool, radius_delta, open_delta, parameters, tool_name, tool_place, only_tool_name,
            contours, labels, calls, called_section, open_labels, section, unfollowed_call,
            tool_of_label, jump, labels_of_cycles, cycle_section, pole_across, open_corner,
            feed_of_control, behind_corner, pole_said, pole_lost, start, corner_in_contour,
            corner_name, after_number, scaling, scale, after_blank, in_columns, program_is_cycle);
  }
  // The modes of `unfollowed` in which no contour is compensated.
  [[nodiscard]] std::uint32_t uncompensated() const { return unfollowed & ~scaling; }
};

}  // namespace trc
