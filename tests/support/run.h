#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/session/path_session.h"
#include "core/trc/result/compensated_block.h"
#include "tests/support/contours.h"
#include "tests/support/slow_trc.h"

namespace trc::support {

// What came out of a session, whole or up to the error that stopped it.
struct Outcome {
  std::vector<CompensatedBlock> blocks{};
  std::vector<Diagnostic> diagnostics{};
  bool stopped = false;

  // The error that stopped the session, or nothing.
  [[nodiscard]] const Diagnostic* error() const;
};

// No block is a lead, any share may be masked, and of a bow tie all is a wall however small it is:
// random contours run over themselves.
[[nodiscard]] CompensatorSetup all_walls();

// A PathSession fed with motions in the plane of its mode, from a start point.
// Modal words go to `program()` in between.
class Channel {
 public:
  // `mode` holds before the first block; its side counts as off.
  Channel(const TrcMode& mode, const Point& start, std::size_t batch = 1,
          const CompensatorSetup& compensator = all_walls());

  [[nodiscard]] ProgramState& program() { return session_.program(); }
  // The place of the next item, with `ordinal` as its number.
  [[nodiscard]] Source place(std::size_t ordinal) const {
    return {.index = index_, .number = static_cast<std::int64_t>(ordinal)};
  }

  // A motion to the end of `segment`; the other axes move where a value is given.
  void move(const Segment& segment, std::size_t ordinal, std::optional<double> third = {},
            std::optional<double> tracking = {});
  void pass(const std::string& text, std::size_t ordinal);
  // For modal words: `goes_on` is what the ProgramState answered.
  void note(bool goes_on) { running_ = running_ && goes_on; }

  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] const std::vector<CompensatedBlock>& blocks() const { return outcome_.blocks; }
  // Ends the program.
  Outcome finish(std::size_t ordinal);

 private:
  void item_given(bool goes_on);

  Plane plane_;
  std::size_t batch_;
  PathSession session_;
  Outcome outcome_{};
  Answers answers_;
  std::uint64_t index_ = 0;
  std::size_t items_ = 0;
  bool running_ = true;
};

// How a contour is given to a PathSession.
struct Feeding {
  // Compensates after every so many items; 0: only at the end.
  std::size_t batch = 1;
  // Text passed after the block with this ordinal (0: approach); empty: none.
  std::function<std::vector<std::string>(std::size_t ordinal)> texts{};
  // End position of the third main axis and of tracking axis A, block by block.
  std::function<double(std::size_t ordinal)> third{};
  std::function<double(std::size_t ordinal)> tracking{};
  CompensatorSetup compensator = all_walls();
  // Called after each block with its ordinal and what has come out so far.
  std::function<void(std::size_t ordinal, const std::vector<CompensatedBlock>& out)> watch{};
};

// With `nominal_radius` in the mode its tool radius is what the tool differs from that (D-43).
// Compensates one selection: G41 or G42 with the approach block, G40 with the
// retract block. Coordinates are in the plane of `mode`; `Source::number` of a
// block is its ordinal (0: approach, 1 … n: contour, n + 1: retract).
[[nodiscard]] Outcome compensate(const Contour& contour, const TrcMode& mode,
                                 const Feeding& feeding = {});

// The blocks that move in the plane, shorter ones than `shortest` mm left out.
[[nodiscard]] std::vector<CompensatedBlock> moving(const std::vector<CompensatedBlock>& blocks,
                                                   double shortest = 0);

// A sentence about the first joint that is not shared bit for bit (plane, third
// main axis and tracking axes), or nothing.
[[nodiscard]] std::string first_gap(const std::vector<CompensatedBlock>& blocks);

// A sentence about the first difference, or nothing. Blocks without length may
// be missing on either side (D-13). `tolerance` in mm.
[[nodiscard]] std::string difference(const std::vector<CompensatedBlock>& actual,
                                     const std::vector<SlowBlock>& expected, double tolerance);

// The first difference of two results of the core; `map` is applied to `expected` first.
[[nodiscard]] std::string difference(const std::vector<CompensatedBlock>& actual,
                                     const std::vector<CompensatedBlock>& expected,
                                     const Motion& map, double tolerance);

// The first difference in geometry; the roles of the blocks may differ.
[[nodiscard]] std::string geometric_difference(std::vector<CompensatedBlock> actual,
                                               std::vector<SlowBlock> expected, double tolerance);

// Equal bit for bit.
[[nodiscard]] bool same(const Outcome& a, const Outcome& b);

[[nodiscard]] SlowPoint wide(const Point& p);
[[nodiscard]] Point narrow(const SlowPoint& p);

// Directions of travel at the ends, unit vectors.
[[nodiscard]] Vector start_tangent(const Segment& segment);
[[nodiscard]] Vector end_tangent(const Segment& segment);

// One line of text: N number, origin, geometry in mm and degrees.
[[nodiscard]] std::string text_of(const CompensatedBlock& block);
[[nodiscard]] std::string text_of(const std::vector<CompensatedBlock>& blocks);
[[nodiscard]] std::string name_of(Origin origin);

}  // namespace trc::support
