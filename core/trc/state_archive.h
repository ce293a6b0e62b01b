#pragma once

#include <optional>

#include "core/nc/state/state_archive.h"
#include "core/trc/path_block.h"
#include "core/trc/result/summary.h"

namespace trc {

template <class Archive>
void serialize(Archive& archive, Compensation& compensation) {
  auto& [active, shift] = compensation;
  archive(active, shift);
}

template <class Archive>
void serialize(Archive& archive, PathBlock::Rejoin& rejoin) {
  auto& [point, start, cut_before, cut_after, leads_on_arc] = rejoin;
  archive(point, start, cut_before, cut_after, leads_on_arc);
}

// Written by hand: clang 14 thinks that a nested struct with default values has no default
// constructor, so that the archive cannot fill an optional of it.
template <class Archive>
void serialize_rejoin(Archive& archive, std::optional<PathBlock::Rejoin>& rejoin) {
  bool given = rejoin.has_value();
  archive(given);
  if (!given) return rejoin.reset();
  auto value = rejoin ? *rejoin : PathBlock::Rejoin{};
  archive(value);
  rejoin = value;
}

template <class Archive>
void serialize(Archive& archive, PathBlock& block) {
  auto& [programmed, role, origin, perpendicular_entry, perpendicular_exit, at_start, at_end,
         before_short, tangent_at_start, tangent_at_end, offset_start, offset_end, tool_path,
         tool_start, path_given, behind_tip, cut_at_start, cut_at_end, splittable, half_slot,
         largest_radius, masked, rejoin, unreachable, passive, passive_after_exit] = block;
  archive(programmed, role, origin, perpendicular_entry, perpendicular_exit, at_start, at_end,
          before_short, tangent_at_start, tangent_at_end, offset_start, offset_end, tool_path,
          tool_start, path_given, behind_tip, cut_at_start, cut_at_end, splittable, half_slot,
          largest_radius, masked, unreachable, passive, passive_after_exit);
  serialize_rejoin(archive, rejoin);
}

// The inverse path, recovered from the path, is not saved.
template <class Archive>
void serialize(Archive& archive, CompensatedBlock& block) {
  auto& [source, origin, plane, rapid, tangential, path, normal, feed, tracking, text, inverse] =
      block;
  archive(source, origin, plane, rapid, tangential, path, normal, feed, tracking, text);
  inverse.reset();
}

template <class Archive>
void serialize(Archive& archive, Summary& summary) {
  auto& [blocks_in, blocks_out, blocks_by_origin, programmed_length, compensated_length] = summary;
  archive(blocks_in, blocks_out, blocks_by_origin, programmed_length, compensated_length);
}

}  // namespace trc
