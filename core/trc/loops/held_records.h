#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/trc/path_block.h"

// The records in which HeldPath keeps its blocks.

namespace trc::held {

// There are many, so numbers are as narrow as possible.
using Number = std::uint32_t;

// Whether any part of a block can be travelled, as in PathBlock.
enum class Reach : std::uint8_t { reachable, unreachable };

// Data that consecutive blocks have in common.
struct Setting {
  std::shared_ptr<const TrcMode> mode{};
  double feed = 0;
  AxisTravel normal{};
  TrackingTravel tracking{};
  Compensation at_start{};
  Compensation at_end{};
  bool rapid = false;
  bool perpendicular_entry = false;
  bool perpendicular_exit = false;
  double radius = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mode, feed, normal, tracking, at_start, at_end, rapid, perpendicular_entry,
            perpendicular_exit, radius);
  }
};

// The cuts of corners from the equidistant of an arc, as in PathBlock. Those of lines are not
// needed.
struct Cuts {
  double at_start = 0;
  double at_end = 0;
};

// Most blocks are lines; the further data of an arc lie elsewhere.
struct KeptBlock {
  Point start = Point::Zero();
  Point end = Point::Zero();
  Number number = 0;
  Number setting = 0;
  Number arc = 0;  // its own, or the next one
  Role role = Role::contour;
  Origin origin = Origin::programmed;
  bool is_arc : 1 = false;
  bool unreachable : 1 = false;
  bool has_own : 1 = false;  // inserted, but not by the contour block before it: OwnData
  bool linear : 1 = false;   // an arc lines stand in place of: lines_of()

  template <class Archive>
  void serialize(Archive& archive) {
    bool its_arc = is_arc;
    bool its_unreachable = unreachable;
    bool its_own = has_own;
    bool its_linear = linear;
    archive(start, end, number, setting, arc, role, origin, its_arc, its_unreachable, its_own,
            its_linear);
    is_arc = its_arc;
    unreachable = its_unreachable;
    has_own = its_own;
    linear = its_linear;
  }
};

struct KeptArc {
  Point center = Point::Zero();
  double sweep = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(center, sweep);
  }
};

struct KeptContour {
  Point start = Point::Zero();
  Point end = Point::Zero();
  std::uint64_t index = 0;  // index, n_word, line and part: its Source
  std::int64_t n_word = 0;
  std::uint32_t line = 0;
  Number block = 0;
  Number circle = 0;  // its own, or the next one
  bool is_arc = false;
  ContourRole contour_role = ContourRole::unspecified;
  std::uint8_t part = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(start, end, index, n_word, line, block, circle, is_arc, contour_role, part);
  }
};

struct KeptCircle {
  KeptArc arc{};
  Cuts cuts{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(arc, cuts.at_start, cuts.at_end);
  }
};

struct PassiveBehind {
  std::size_t block = 0;
  std::vector<PassiveBlock> blocks{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(block, blocks);
  }
};

// Data of an inserted block that differ from the contour block before it: there is none, or another
// block has inserted it.
struct OwnData {
  std::size_t block = 0;
  Cuts cuts{};
  Source source{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(block, cuts.at_start, cuts.at_end, source);
  }
};

inline Source source_of(const KeptContour& kept) {
  return {.index = kept.index, .number = kept.n_word, .line = kept.line, .part = kept.part};
}
// For path blocks and contour blocks.
template <class Kept>
Line line_of(const Kept& kept) {
  return {.start = kept.start, .end = kept.end};
}
template <class Kept>
Arc arc_of(const Kept& kept, const KeptArc& arc) {
  return {.start = kept.start, .end = kept.end, .center = arc.center, .sweep = arc.sweep};
}

}  // namespace trc::held
