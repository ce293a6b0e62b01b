#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/archive.h"
#include "core/nc/state/block.h"
#include "core/nc/state/program_line.h"

namespace cereal {

template <class Archive>
void serialize(Archive& archive, trc::Point& point) {
  archive(point.x(), point.y());
}

}  // namespace cereal

namespace trc {

template <class Archive>
void serialize(Archive& archive, Line& line) {
  auto& [start, end] = line;
  archive(start, end);
}

template <class Archive>
void serialize(Archive& archive, Arc& arc) {
  auto& [start, end, center, sweep] = arc;
  archive(start, end, center, sweep);
}

template <class Archive>
void serialize(Archive& archive, AxisTravel& travel) {
  auto& [from, to] = travel;
  archive(from, to);
}

template <class Archive>
void serialize(Archive& archive, SplitOption& split) {
  auto& [where, along_path, axis, distance_1, feed_1, distance_2, feed_2] = split;
  archive(where, along_path, axis, distance_1, feed_1, distance_2, feed_2);
}

template <class Archive>
void serialize(Archive& archive, TrcOptions& options) {
  auto& [conv_cir_to_lin, kerf_masking, reverse, ignore_cont_damage, remove_masked_blocks,
         ext_angle_block_intersection, g236_lin, stretch_factor, tangential_limit,
         perpendicular_radius_change, gen_cir_block_in_corner, suppress_trc, inverse, split] =
      options;
  archive(conv_cir_to_lin, kerf_masking, reverse, ignore_cont_damage, remove_masked_blocks,
          ext_angle_block_intersection, g236_lin, stretch_factor, tangential_limit,
          perpendicular_radius_change, gen_cir_block_in_corner, suppress_trc, inverse, split);
}

template <class Archive>
void serialize(Archive& archive, TrcMode& mode) {
  auto& [plane, side, tool_radius, nominal_radius, below_nominal, selection_number, selection,
         deselection, tangential, from_anywhere, touches_corner_circle, transition, masking,
         feed_adaptation, tangfeed_minimum, options] = mode;
  archive(plane, side, tool_radius, nominal_radius, below_nominal, selection_number, selection,
          deselection, tangential, from_anywhere, touches_corner_circle, transition, masking,
          feed_adaptation, tangfeed_minimum, options);
}

template <class Archive>
void serialize(Archive& archive, MotionBlock& block) {
  auto& [source, path, normal, feed, rapid, role, mode, tracking] = block;
  archive(source, path, normal, feed, rapid, role, mode, tracking);
}

template <class Archive>
void serialize(Archive& archive, PassiveBlock& block) {
  auto& [source, text, normal, feed, rapid, moves, mode, tracking] = block;
  archive(source, text, normal, feed, rapid, moves, mode, tracking);
}

// A line end lives as long as the program: it refers to one of these.
inline constexpr std::array<std::string_view, 4> line_ends{"", "\n", "\r\n", "\r"};

template <class Archive>
void serialize_line_end(Archive& archive, std::string_view& line_end) {
  std::uint8_t kind = 0;
  while (line_ends[kind] != line_end) ++kind;
  archive(kind);
  line_end = line_ends.at(kind);
}

template <class Archive>
void serialize(Archive& archive, WordRange& word) {
  auto& [begin, end, role] = word;
  archive(begin, end, role);
}

template <class Archive>
void serialize(Archive& archive, ProgramLine& line) {
  auto& [source, text, line_end, words, roles, names_other_axes, main_axes, has_words, is_motion,
         has_trc_words, ends_program, feed_it_takes, third_set, is_computed, calls_the_machine,
         motion, incremental, unit, feed_unit, absolute_center, plane, feed, klartext] = line;
  archive(source, text);
  serialize_line_end(archive, line_end);
  archive(words, roles, names_other_axes, main_axes, has_words, is_motion, has_trc_words,
          ends_program, feed_it_takes, third_set, is_computed, calls_the_machine, motion,
          incremental, unit, feed_unit, absolute_center, plane, feed, klartext);
}

}  // namespace trc
