#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/numbered_queue.h"
#include "core/base/source.h"
#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"
#include "core/verify/piece.h"

namespace trc::verify {

// What was in force when a block was programmed, as far as measuring it asks.
struct Rule {
  std::uint32_t selection = 0;
  double required = 0;    // mm, the least distance of path and wall: what the tool cuts with
  double radius = 0;      // mm, of the tool
  Side side = Side::off;  // of the wall
  double nominal = 0;     // mm; above 0: wear mode, the walls are beside the program (part_wall.h)
  Plane plane = Plane::xy;
  bool reverses = false;          // REVERSE
  bool follows = false;           // the path follows the contour: no SUPPRESS_TRC, a tool radius
  bool joins_fine_steps = false;  // whose corners would leave nothing of them (rule 5.4)

  bool operator==(const Rule&) const = default;
};

struct ProgrammedPiece {
  Piece piece{};
  Source source{};
  std::uint32_t rule = 0;
  // In the contour of its selection, or of the contour block after it.
  std::uint32_t number = 0;
  bool is_contour = false;
  bool crosses_behind = false;  // what is inserted after it crosses the corner (REVERSE, D-22)
  bool from_anywhere = false;   // an approach whose start nobody knows (D-170)
  ContourRole role = ContourRole::unspecified;
};

// Whether the block of one stands before that of the other in the program.
[[nodiscard]] inline bool is_before(const Source& one, const Source& other) {
  return one.index != other.index ? one.index < other.index : one.part < other.part;
}

struct MeasuredPiece {
  Piece piece{};
  double height = 0;           // of its end across the plane, mm
  std::size_t programmed = 0;  // the number of the piece it stems from
  bool inserted = false;       // between that piece and the next one
  bool on_contour = false;     // it stands for that piece itself
};

// An approach or a retract at one height: where it leads is the program's business, but for walls.
struct Way {
  Piece piece{};
  double height = 0;  // mm
  Source source{};
  std::size_t programmed = 0;  // the number of the first or the last piece of its selection
};

// Programmed blocks under TRC and the path they have become, as little of both as measuring needs,
// until that is done.
class MeasuredPath {
 public:
  // A block under TRC, in the order of the program.
  void add(const MotionBlock& block);
  // A block of the path, after the programmed block it stems from. Motion that is not measured is
  // left out.
  void add(const CompensatedBlock& block);

  [[nodiscard]] const NumberedQueue<ProgrammedPiece>& programmed() const { return programmed_; }
  [[nodiscard]] const NumberedQueue<MeasuredPiece>& path() const { return path_; }
  [[nodiscard]] const std::vector<Way>& ways() const { return ways_; }
  [[nodiscard]] const Rule& rule_of(const ProgrammedPiece& piece) const {
    return rules_[piece.rule];
  }
  // The number of the first programmed piece that is not before this block.
  [[nodiscard]] std::size_t first_from(const Source& source) const;

  // Forgets the programmed pieces before this number, their ways, and all of the path.
  void forget_before(std::size_t number);

  // All it holds, and what the index over so much takes while it is measured.
  [[nodiscard]] std::size_t bytes() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(programmed_, path_, ways_, rules_, last_);
  }

 private:
  std::uint32_t number_of(const std::shared_ptr<const TrcMode>& mode);
  [[nodiscard]] bool is_contour(const MotionBlock& block, Side side) const;
  void add_way(const CompensatedBlock& block);
  // Of the last one: it becomes the wall it stands for in wear mode.
  void put_at_part(ProgrammedPiece& last);
  // The programmed piece that a path stems from; null: there is none.
  const ProgrammedPiece* find(const Source& source);

  NumberedQueue<ProgrammedPiece> programmed_;
  NumberedQueue<MeasuredPiece> path_;
  std::vector<Way> ways_;
  std::vector<Rule> rules_;
  std::shared_ptr<const TrcMode> last_mode_;  // that gave the last rule; none: not known
  std::size_t last_ = 0;                      // found: the path goes on there
};

}  // namespace trc::verify
