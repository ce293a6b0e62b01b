#pragma once

#include <optional>
#include <vector>

#include "core/base/source.h"
#include "core/nc/state/block.h"
#include "core/nc/state/corner_cut.h"

namespace trc {

// A motion whose end is to be cut and the blocks behind it, until the next motion in the plane is
// known. Blocks wait here for the first motion behind a lead too.
class HeldCorner {
 public:
  [[nodiscard]] bool waits() const { return cut_.has_value(); }
  // In Klartext a line of its own may still say what becomes of the corner.
  [[nodiscard]] bool is_open() const { return cut_ && cut_->form == CornerCut::Form::open; }
  // Where it cannot be cut, that is an error.
  [[nodiscard]] bool is_asked_for() const { return cut_ && !is_open() && !cut_->modal; }

  // Of one that waits:
  [[nodiscard]] const CornerCut& cut() const { return *cut_; }
  [[nodiscard]] MotionBlock& before() { return *std::get_if<MotionBlock>(&blocks_.front()); }
  // Where the program says it.
  [[nodiscard]] const Source& source() { return source_ ? *source_ : before().source; }
  // The block that the corner becomes may not stand for the motion behind it.
  [[nodiscard]] bool has_own_line_or_feed() const { return source_ || feed_ != 0; }

  // The motion is among the blocks already.
  void open() { cut_ = CornerCut{.form = CornerCut::Form::open}; }
  void close(const CornerCut& cut, double feed, const Source& source) {
    cut_ = cut;
    source_ = source;
    feed_ = feed;
  }
  void hold(Block&& motion, const CornerCut& cut, double feed) {
    cut_ = cut;
    feed_ = feed;
    blocks_.push_back(std::move(motion));
  }

  // Into the motion, and behind it the corner itself, unless it takes all of the motion behind:
  // that has become the corner then.
  void put_in(const CutCorner& corner, double same_point);
  void release(std::vector<Block>& to);
  [[nodiscard]] std::vector<Block>& blocks() { return blocks_; }
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(cut_, source_, feed_, blocks_);
  }

 private:
  std::optional<CornerCut> cut_{};
  std::optional<Source> source_{};  // of a line of its own
  double feed_ = 0;                 // mm/min; 0: that of the motion
  std::vector<Block> blocks_{};
};

}  // namespace trc
