#pragma once

#include "core/nc/state_archive.h"
#include "core/trc/compensator.h"
#include "core/trc/path_block.h"

namespace trc {

template <class Archive>
void serialize(Archive& archive, Compensation& compensation) {
  auto& [active, shift] = compensation;
  archive(active, shift);
}

template <class Archive>
void serialize(Archive& archive, PathBlock::Rejoin& rejoin) {
  auto& [point, cut_before, cut_after] = rejoin;
  archive(point, cut_before, cut_after);
}

template <class Archive>
void serialize(Archive& archive, PathBlock& block) {
  auto& [programmed, role, origin, perpendicular_entry, perpendicular_exit, at_start, at_end,
         tangent_at_start, tangent_at_end, offset_start, offset_end, tool_path, tool_start,
         path_given, cut_at_start, cut_at_end, splittable, masked, rejoin, unreachable, riders,
         riders_after_exit] = block;
  archive(programmed, role, origin, perpendicular_entry, perpendicular_exit, at_start, at_end,
          tangent_at_start, tangent_at_end, offset_start, offset_end, tool_path, tool_start,
          path_given, cut_at_start, cut_at_end, splittable, masked, rejoin, unreachable, riders,
          riders_after_exit);
}

template <class Archive>
void serialize(Archive& archive, Summary& summary) {
  auto& [blocks_in, blocks_out, blocks_by_origin, programmed_length, compensated_length,
         smallest_clearance] = summary;
  archive(blocks_in, blocks_out, blocks_by_origin, programmed_length, compensated_length,
          smallest_clearance);
}

}  // namespace trc
