#pragma once

#include <optional>
#include <vector>

#include "core/base/source.h"
#include "core/nc/state/block.h"
#include "core/nc/state/corner_cut.h"

namespace trc {

// Holds a motion whose end is to be cut, and the blocks after it, until the next motion in the
// plane is known. Blocks also wait here for the first motion after a lead.
class HeldCorner {
 public:
  [[nodiscard]] bool waits() const { return cut_.has_value(); }
  // In Klartext the next line may still say how the corner is cut.
  [[nodiscard]] bool is_open() const { return cut_ && cut_->form == CornerCut::Form::open; }
  // If it cannot be cut, that is an error.
  [[nodiscard]] bool is_asked_for() const { return cut_ && !is_open() && !cut_->modal; }

  // Only while a corner waits:
  [[nodiscard]] const CornerCut& cut() const { return *cut_; }
  [[nodiscard]] MotionBlock& before() { return *std::get_if<MotionBlock>(&blocks_.front()); }
  // Where the program says it.
  [[nodiscard]] const Source& source() { return source_ ? *source_ : before().source; }
  // The block of the corner must then not replace the motion after it.
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

  // Shortens the motion and adds the corner after it, unless the corner consumes the whole motion
  // that follows: the caller has made that the corner then.
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
