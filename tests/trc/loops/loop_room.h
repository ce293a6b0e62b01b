#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/trc/loops/held_path.h"
#include "core/trc/loops/obstacles.h"
#include "core/trc/loops/walked_path.h"

// The rooms of loop removal, for tests of one alone: a contour of lines with the path of a tool of
// radius 1 left of it.

namespace trc {

class LoopRoom : public ::testing::Test {
 protected:
  using Nearness = Obstacles::Nearness;

  // A contour block, and a part of the line beside it as its path.
  void hold(const Line& programmed, const Line& tool_path) {
    PathBlock block = block_in(Role::contour, Origin::programmed);
    block.programmed.path = programmed;
    block.tangent_at_start = block.tangent_at_end = tangent_at_start(programmed);
    block.tool_path = tool_path;
    block.cut_at_start = (tool_path.start - programmed.start).dot(block.tangent_at_start);
    block.cut_at_end = (programmed.end - tool_path.end).dot(block.tangent_at_start);
    block.passive = std::move(passive_);
    passive_.clear();
    const Certificate::Block course = Certificate::block_of(block);
    path_.append(block);
    obstacles_.append(course, Certificate::Begin::joined, bounding_box(programmed));
  }
  // Along these corners, of which each takes `cut` off the paths of its blocks.
  void hold(const std::vector<Point>& corners, double cut = 0) {
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Line programmed{.start = corners[i], .end = corners[i + 1]};
      const Vector along = (programmed.end - programmed.start).normalized();
      const Vector across = left_of(along);
      hold(programmed, Line{.start = programmed.start + across + cut * along,
                            .end = programmed.end + across - cut * along});
    }
  }
  // A quarter of a circle round an outside corner.
  void hold_quarter_round(const Point& corner, const Point& start, const Point& end) {
    PathBlock block = block_in(Role::inserted, Origin::transition);
    block.programmed.source.index = path_.end_of_contour() - 1;
    block.tool_path =
        Arc{.start = start, .end = end, .center = corner, .sweep = -std::numbers::pi / 2};
    path_.append(block);
  }

  // A way that turns back to its first block, whose path it bars at x = 6.
  void hold_hook() { hold({{0, 0}, {10, 0}, {10, 5}, {6, 5}, {6, 0.5}}); }

  // Down into a slot from x = 10 on, 5 deep, and up again. Blocks of the path: 1 and 5 go round its
  // outside corners, 2 and 4 down and up, 3 across.
  void hold_slot(double width) {
    const double right = 10 + width;
    hold(Line{.start = {0, 0}, .end = {10, 0}}, Line{.start = {0, 1}, .end = {10, 1}});
    hold_quarter_round({10, 0}, {10, 1}, {11, 0});
    hold(Line{.start = {10, 0}, .end = {10, -5}}, Line{.start = {11, 0}, .end = {11, -4}});
    hold(Line{.start = {10, -5}, .end = {right, -5}},
         Line{.start = {11, -4}, .end = {right - 1, -4}});
    hold(Line{.start = {right, -5}, .end = {right, 0}},
         Line{.start = {right - 1, -4}, .end = {right - 1, 0}});
    hold_quarter_round({right, 0}, {right - 1, 0}, {right, 1});
    hold(Line{.start = {right, 0}, .end = {20, 0}}, Line{.start = {right, 1}, .end = {20, 1}});
  }
  // Too narrow for the tool by half: the paths round its outside corners cross in this point.
  void hold_narrow_slot() { hold_slot(1); }
  const Point crossing_{10.5, std::sqrt(0.75)};
  static constexpr double along_first_ = std::numbers::pi / 6;   // of block 1, up to there
  static constexpr double along_second_ = std::numbers::pi / 3;  // of block 5

  Tolerances tolerances_{};
  Checkpoint checkpoint_{{}};
  std::shared_ptr<const TrcMode> mode_ = std::make_shared<const TrcMode>();
  std::vector<PassiveBlock> passive_;  // programmed after the next contour block
  HeldPath path_;
  Obstacles obstacles_{path_, 0, tolerances_, checkpoint_};
  WalkedPath walked_{path_, true};

 private:
  [[nodiscard]] PathBlock block_in(Role role, Origin origin) const {
    PathBlock block;
    block.role = role;
    block.origin = origin;
    block.programmed.source.index = path_.end_of_contour();
    block.programmed.mode = mode_;
    block.at_start = block.at_end = {.active = true, .shift = 1};
    return block;
  }
};

}  // namespace trc
