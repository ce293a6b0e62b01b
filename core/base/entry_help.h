#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/diagnostic.h"

namespace trc {

// A block of a proposed way; it starts at the end of the block before. An arc if it has a
// centre.
struct ProposedBlock {
  DiagnosticPoint end{};
  std::optional<DiagnosticPoint> center{};
  double sweep = 0;  // rad, as Arc::sweep
};

// Motions to be programmed in place of the refused one: one of them is the approach or retract, as
// the refused one was; a motion between it and the contour belongs to the contour.
struct EntryProposal {
  enum class Shape : std::uint8_t {
    line,
    quarter_circle,
    inside_corner,  // a line under G238, which the contour begins and closes in an inside corner
                    // for
  };

  Shape shape = Shape::line;
  DiagnosticPoint start{};
  std::vector<ProposedBlock> blocks{};  // two at the most
};

// Proposals in place of a selection or deselection block that was refused. Each has been
// compensated, and keeps clear of the contour as far as that was known.
struct EntryHelp {
  bool leaves = false;          // the way off the contour, else the one to it
  std::uint8_t third_axis = 2;  // the one across the plane: 0 X, 1 Y, 2 Z
  double given_length = 0;      // mm, of the block that was refused
  double needed_length = 0;     // mm; 0: not its length is at fault
  std::uint32_t tried_on = 0;   // so many contour blocks were known
  // Number of leads next to the refused block, which the proposals replace as well.
  std::uint32_t replaced = 0;
  // Number of leads at the other end of the contour, which have to be removed with them.
  std::uint32_t left_out = 0;
  // A point close to the programmed start of the block (the end, where it leaves) at which it could
  // start (end), with nothing else changed.
  std::optional<DiagnosticPoint> legal{};
  std::vector<EntryProposal> proposals{};  // one of a shape at the most
};

}  // namespace trc
