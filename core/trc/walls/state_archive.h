#pragma once

#include "core/nc/state/state_archive.h"
#include "core/trc/walls/left_out.h"
#include "core/trc/walls/sided_walls.h"
#include "core/trc/walls/walls.h"

namespace trc {

template <class Archive>
void serialize(Archive& archive, Walls::Range& range) {
  auto& [first, end] = range;
  archive(first, end);
}

template <class Archive>
void serialize(Archive& archive, Walls::Part& part) {
  auto& [number, from, to] = part;
  archive(number, from, to);
}

template <class Archive>
void serialize(Archive& archive, Walls& walls) {
  auto& [leads, parts, rings, head, tail, touch, touch_of_rings, start_blocks_passed,
         overrun_blocks, blocks_per_lap, turns_in, turns_out, touch_of_turns] = walls;
  archive(leads, parts, rings, head, tail, touch, touch_of_rings, start_blocks_passed,
          overrun_blocks, blocks_per_lap, turns_in, turns_out, touch_of_turns);
}

template <class Archive>
void serialize(Archive& archive, SidedWalls& walls) {
  auto& [changes, sides] = walls;
  archive(changes, sides);
}

template <class Archive>
void serialize(Archive& archive, LeftOut& stretch) {
  auto& [first, last, length, of_walls, tool_radius, in_all, is_a_part] = stretch;
  archive(first, last, length, of_walls, tool_radius, in_all, is_a_part);
}

}  // namespace trc
