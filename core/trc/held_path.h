#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/numbered_queue.h"
#include "core/trc/path_block.h"

namespace trc {

// The compensated path of a selection as LoopRemoval holds it. Of a block it keeps what
// the walk asks about, apart from what it has in common with the block before it; a path
// block is made of it again when it leaves. So a selection of millions of blocks fits
// into memory, and what is asked about most into the caches.
//
// The blocks of the path are counted from the begin of the selection, and so are the
// programmed contour blocks.
class HeldPath {
 public:
  // There are many: numbers are as narrow as they can be.
  using Number = std::uint32_t;
  static constexpr std::size_t most_blocks = std::numeric_limits<Number>::max();

  // A contour block or one inserted between two.
  struct Block {
    Segment path{};     // of the tool
    Number number = 0;  // of the contour block, or of the one before it
    Number setting = 0;
    Role role = Role::contour;
    Origin origin = Origin::programmed;
    bool unreachable = false;
    bool apart = false;  // inserted, but not by the contour block before it: Apart

    [[nodiscard]] bool is_contour() const { return role == Role::contour; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(path, number, setting, role, origin, unreachable, apart);
    }
  };
  struct ContourBlock {
    Segment programmed{};
    double cut_at_start = 0;
    double cut_at_end = 0;
    std::uint64_t index = 0;  // index, n_word and line: its Source
    std::int64_t n_word = 0;
    std::uint32_t line = 0;
    Number block = 0;  // its path

    [[nodiscard]] Source source() const { return {index, n_word, line}; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(programmed, cut_at_start, cut_at_end, index, n_word, line, block);
    }
  };

  // Takes the riders out of the block.
  void append(PathBlock& block);
  [[nodiscard]] const NumberedQueue<Block>& blocks() const { return blocks_; }
  [[nodiscard]] const NumberedQueue<ContourBlock>& contour() const { return contour_; }
  // Of the tool, the smaller one where it changes, mm.
  [[nodiscard]] double radius_of_tool(std::size_t block) const { return setting(block).radius; }
  // Of a contour block, the larger one where it changes, mm.
  [[nodiscard]] double largest_radius(const ContourBlock& contour) const {
    const Setting& its = setting(contour.block);
    return std::max(std::abs(its.at_start.shift), std::abs(its.at_end.shift));
  }
  [[nodiscard]] const TrcMode& mode_of(std::size_t block) const { return *setting(block).mode; }
  // Across the plane, where the block starts, mm.
  [[nodiscard]] double height_of(std::size_t block) const { return setting(block).normal.from; }

  // Makes `block` what it was, with its riders; each one once, in ascending order. It is new, or
  // one that has been restored before.
  void restore(std::size_t number, PathBlock& block);
  [[nodiscard]] PathBlockPtr restored(std::size_t number);

  // Forgets contour blocks and their path.
  void forget_before(std::size_t contour_number);
  // Forgets blocks of the path, and of the contour what only they needed.
  void forget_path_before(std::size_t block);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(blocks_, contour_, settings_, riders_, apart_);
  }

 private:
  // What one block after the other has in common.
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
  struct Riders {
    std::size_t block = 0;
    std::vector<PassiveBlock> blocks{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, blocks);
    }
  };

  // What an inserted block does not have in common with the contour block before it: there is
  // none, or it is another one that has inserted it.
  struct Apart {
    std::size_t block = 0;
    double cut_at_start = 0;
    double cut_at_end = 0;
    std::uint64_t index = 0;
    std::int64_t n_word = 0;
    std::uint32_t line = 0;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(block, cut_at_start, cut_at_end, index, n_word, line);
    }
  };

  [[nodiscard]] const Setting& setting(std::size_t block) const {
    return settings_[blocks_[block].setting];
  }
  // That of the last block, where it is the same.
  [[nodiscard]] Number setting_of(const PathBlock& block);
  void note_contour_block(const PathBlock& block);
  [[nodiscard]] bool stands_apart(const PathBlock& inserted) const;
  void restore_apart(std::size_t number, PathBlock& block);

  NumberedQueue<Block> blocks_;
  NumberedQueue<ContourBlock> contour_;
  NumberedQueue<Setting> settings_;
  NumberedQueue<Riders> riders_;
  NumberedQueue<Apart> apart_;
};

}  // namespace trc
