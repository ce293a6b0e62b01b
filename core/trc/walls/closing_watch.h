#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry/box_tree.h"
#include "core/geometry/segment.h"
#include "core/trc/lead_settings.h"
#include "core/trc/walls/closing.h"
#include "core/trc/walls/walls.h"

namespace trc {

// Where a contour closes, for a window of N contour blocks, while more of it may come (D-158). What
// lies before and after the closing is a lead and no wall (D-38). That cannot be seen before the
// contour has come back to its start, or has ended: until then two blocks in each other's way are
// undecided if one of them may be a lead and some window shows both.
//
// Phases of a contour whose laps are shorter than the window:
//
//     open                          laps
//     lead-in, first lap, ...       ... second lap, ...                  end
//     blocks near the start may     blocks that follow the end of a lap
//     be the lead-in                may be the lead-out
class ClosingWatch {
 public:
  ClosingWatch(const LeadSettings& settings, std::size_t window)
      : settings_(settings), window_(window) {
    begin();
  }

  // A new contour begins.
  void begin();
  // The contour block with that number has come, for a tool of that radius, mm.
  void note(std::size_t number, const Segment& programmed, double tool_radius);

  // Whether more blocks have to come before it is known if one of these two contour blocks bars
  // the path of the other.
  [[nodiscard]] bool is_undecided(std::size_t one, std::size_t other) const;
  // Whether the contour has to be known from its first block on.
  [[nodiscard]] bool needs_begin() const { return phase_ == Phase::open; }
  // To be called after each block, while needs_begin(). Once the contour has gone round and goes on
  // along its start: its walls, without those of later laps. `contour`: all that has come, in the
  // boxes given.
  [[nodiscard]] std::optional<Walls> find_lead_in(const ContourView& contour, const BoxTree& boxes);
  // Where laps have been found: the block that the last lap begins with if leads follow it, else
  // the one before it.
  [[nodiscard]] std::optional<std::size_t> begin_of_last_lap() const {
    return phase_ == Phase::laps ? std::optional(lap_before_) : std::nullopt;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(tool_radius_, phase_, head_, head_is_complete_, behind_head_, behind_closing_,
            candidate_.is_found, candidate_.closes_with, candidate_.next_wall, candidate_.seen,
            candidate_.goes_along, scanned_, tries_, where_laps_begin_, lap_before_, last_lap_);
  }

 private:
  enum class Phase : std::uint8_t {
    open,  // the contour has not come back to its start
    laps,  // it has, and has gone on with another lap
    over,  // no window shows both its start and the next block
  };
  // Blocks that follow each other.
  struct BlockRun {
    std::size_t blocks = 0;
    double length = 0;  // mm

    template <class Archive>
    void serialize(Archive& archive) {
      archive(blocks, length);
    }
    void add(const Segment& block);
    // Whether a closing at one end of it is too far from the other end to close a contour there.
    [[nodiscard]] bool is_beyond_leads(double tool_radius) const;
  };
  // Where the contour seems to close. Whether the blocks that follow are a lead-out is open.
  struct Candidate {
    bool is_found = false;
    std::size_t closes_with = 0;  // this block
    std::size_t next_wall = 0;    // the next block after it should lie on this wall
    std::size_t seen = 0;         // the blocks before this one have been looked at
    bool goes_along = true;       // the blocks after it lie on the first walls
  };

  [[nodiscard]] std::size_t head_end() const { return head_.blocks; }
  void note_lap(std::size_t number, const Segment& programmed);
  // Looks for the block that closes the contour, from scanned_ on.
  void find_candidate(const ContourView& contour, const BoxTree& boxes);
  // Whether the block meets the first half of the contour near its start.
  [[nodiscard]] bool touches_head(const ContourView& contour, const BoxTree& boxes,
                                  std::size_t number) const;
  // Looks at the blocks after the candidate. Whether they are too many for a lead-out.
  [[nodiscard]] bool goes_on_behind_candidate(const ContourView& contour);
  [[nodiscard]] Walls begin_laps(const ContourView& contour);

  LeadSettings settings_;
  std::size_t window_;
  double tool_radius_ = 0;  // the largest one so far, mm

  Phase phase_ = Phase::over;
  BlockRun head_{};  // the first blocks, among which a closing is looked for
  bool head_is_complete_ = false;
  BlockRun behind_head_{};     // after the last block that may be seen with the head
  BlockRun behind_closing_{};  // after the candidate, or the start of the last lap
  Candidate candidate_{};
  std::size_t scanned_ = 0;
  int tries_ = 0;
  Point where_laps_begin_ = Point::Zero();
  std::size_t lap_before_ = 0;
  std::size_t last_lap_ = 0;
};

}  // namespace trc
