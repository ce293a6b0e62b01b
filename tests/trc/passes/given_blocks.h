#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/trc/corner/offsets.h"
#include "core/trc/path_block.h"

// Blocks as a pass is given them, for tests of one pass alone.

namespace trc::support {

// The tool of radius `radius` left of the contour.
inline TrcMode left_of_contour(double radius) {
  TrcMode mode;
  mode.side = Side::left;
  mode.tool_radius = radius;
  mode.selection_number = 1;
  mode.selection = Selection::direct;
  mode.transition = Transition::circular;
  return mode;
}

// A block of a contour, with what Offset knows of it.
inline PathBlockPtr contour_block(const Segment& programmed, const TrcMode& mode) {
  auto block = std::make_unique<PathBlock>();
  block->role = Role::contour;
  block->origin = Origin::programmed;
  block->programmed.path = programmed;
  block->programmed.feed = 100;
  block->programmed.mode = std::make_shared<const TrcMode>(mode);
  block->at_start = block->at_end = {.active = true, .shift = shift_of_tool(mode)};
  give_offsets(*block);
  return block;
}

// From where the tool is to the start of the contour.
inline PathBlockPtr approach_block(const Line& programmed, const TrcMode& mode) {
  PathBlockPtr block = contour_block(programmed, mode);
  block->role = Role::approach;
  block->origin = Origin::approach;
  block->at_start = {};
  block->tool_start = programmed.start;
  return block;
}

// What comes out of a pass for these blocks, and nothing after them.
template <class P>
PathBlocks all_from(P& pass, PathBlocks blocks) {
  PathBlocks out;
  for (PathBlockPtr& block : blocks)
    if (!pass.feed(std::move(block), out)) return out;
  static_cast<void>(pass.drain(out));
  return out;
}

// Those of one mode share it, as they do when they are read.
template <class... Blocks>
PathBlocks in_a_row(Blocks... blocks) {
  PathBlocks row;
  (row.push_back(std::move(blocks)), ...);
  for (PathBlockPtr& block : row)
    if (block->mode() == row.front()->mode()) block->programmed.mode = row.front()->programmed.mode;
  return row;
}

inline void expect_point(const Point& point, double x, double y) {
  EXPECT_NEAR(point.x(), x, 1e-7);
  EXPECT_NEAR(point.y(), y, 1e-7);
}

}  // namespace trc::support
