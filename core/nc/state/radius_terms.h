#pragma once

#include "core/nc/state/trc_mode.h"

namespace trc {

// A row of the tool table; a radius alone is one.
struct ToolRow {
  ToolRow(double tool_radius = 0, double tool_wear = 0) : radius(tool_radius), wear(tool_wear) {}

  double radius;  // mm; negative swaps the side
  double wear;    // mm, by which the tool is larger

  bool operator==(const ToolRow&) const = default;
};

// The parts of the tool radius in force (D-43), mm.
struct RadiusTerms {
  double radius = 0;  // as programmed; negative swaps the side
  double wear = 0;
  double allowance = 0;
  double nominal = 0;  // above 0: wear mode, the program is the centre path of such a tool
  // By which the control enlarges the coordinates of the program in the plane, but not the tool: in
  // the program it has its sizes divided by this (D-175).
  double scale = 1;

  // Distance from the program to the path; negative: on the side opposite to the programmed one.
  [[nodiscard]] double beside() const {
    const double size = nominal > 0 || radius >= 0 ? radius : -radius;
    const double sum = (size + wear + allowance) / scale;
    return nominal > 0 || radius >= 0 ? sum : -sum;
  }
  // The radius that cuts, allowance included.
  [[nodiscard]] double effective() const { return scaled_nominal() + beside(); }
  [[nodiscard]] double scaled_nominal() const { return nominal / scale; }

  bool operator==(const RadiusTerms&) const = default;
};

// Enters the radius of these terms into `mode`, for a program that selects `side`.
void give_radius(const RadiusTerms& terms, Side side, TrcMode& mode);

}  // namespace trc
