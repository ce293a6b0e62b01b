#pragma once

#include "core/nc/state/trc_mode.h"

namespace trc {

// A row of the tool table; a radius alone is one.
struct ToolRow {
  ToolRow(double tool_radius = 0, double tool_wear = 0) : radius(tool_radius), wear(tool_wear) {}

  double radius;  // mm; negative swaps the side
  double wear;    // mm, what the tool is larger by

  bool operator==(const ToolRow&) const = default;
};

// The parts of the tool radius in force (D-43), mm.
struct RadiusTerms {
  double radius = 0;  // as programmed; negative swaps the side
  double wear = 0;
  double allowance = 0;
  double nominal = 0;  // above 0: wear mode, the program is the centre path of such a tool

  // How far the path is beside the program; negative: on the side that was not programmed.
  [[nodiscard]] double beside() const {
    const double size = nominal > 0 || radius >= 0 ? radius : -radius;
    const double sum = size + wear + allowance;
    return nominal > 0 || radius >= 0 ? sum : -sum;
  }
  // What the tool cuts with, allowance included.
  [[nodiscard]] double effective() const { return nominal + beside(); }

  bool operator==(const RadiusTerms&) const = default;
};

// A radius of such terms for a program that says `side`, as it is in force.
void give_radius(const RadiusTerms& terms, Side side, TrcMode& mode);

}  // namespace trc
