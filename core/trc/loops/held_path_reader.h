#pragma once

#include <cstddef>

#include "core/trc/loops/held_path.h"

namespace trc {

// Reads consecutive blocks with the same setting and no data beyond it, their path, their contour
// block and the members below.
class HeldPath::Reader {
 public:
  Reader(const HeldPath& path, std::size_t block);
  // Goes on to the first or the next block. Returns false, and must not be used further, where that
  // block has another setting or data of its own.
  [[nodiscard]] bool next();

  [[nodiscard]] const Setting& setting() const { return setting_; }
  // Whether the present block is a contour block.
  [[nodiscard]] bool is_contour() const { return block_->role == Role::contour; }
  // If so it has lines_of(), and no path.
  [[nodiscard]] bool is_linear() const { return block_->linear; }
  [[nodiscard]] Origin origin() const { return block_->origin; }
  [[nodiscard]] Source source() const { return held::source_of(*contour_); }
  // Calls visit with its path, a Line or an Arc; and as HeldPath does, where it is a contour block.
  template <class Visit>
  [[nodiscard]] auto visit_path(Visit visit) const {
    return block_->is_arc ? visit(arc_of(*block_, *arc_)) : visit(line_of(*block_));
  }
  template <class Visit>
  [[nodiscard]] auto visit_programmed(Visit visit) const {
    if (!contour_->is_arc) return visit(line_of(*contour_));
    return visit(arc_of(*contour_, circle_->arc), circle_->cuts);
  }

 private:
  void read_contour() {
    contour_ = &contours_.next();
    if (contour_->is_arc) circle_ = &circles_.next();
  }

  Number kept_setting_;
  const Setting& setting_;
  NumberedQueue<KeptBlock>::Reader blocks_;
  NumberedQueue<KeptArc>::Reader arcs_;
  NumberedQueue<KeptContour>::Reader contours_;
  NumberedQueue<KeptCircle>::Reader circles_;
  const KeptBlock* block_ = nullptr;
  const KeptArc* arc_ = nullptr;
  const KeptContour* contour_ = nullptr;
  const KeptCircle* circle_ = nullptr;
};

[[gnu::always_inline]] inline HeldPath::Reader::Reader(const HeldPath& path, std::size_t block)
    : kept_setting_(path.blocks_[block].setting),
      setting_(path.settings_[kept_setting_]),
      blocks_(path.blocks_.from(block)),
      arcs_(path.arcs_.from(path.blocks_[block].arc)),
      contours_(path.contour_.from(path.number_of(block))),
      circles_(path.circles_.from(path.first_circle_of(block))) {
  if (!path.contour_.empty() && !path.is_contour(block)) read_contour();
}

[[gnu::always_inline]] inline bool HeldPath::Reader::next() {
  block_ = &blocks_.next();
  if (block_->setting != kept_setting_ || block_->has_own) return false;
  if (is_contour()) read_contour();
  if (block_->is_arc) arc_ = &arcs_.next();
  return true;
}

inline HeldPath::Reader HeldPath::read_from(std::size_t block) const {
  return Reader(*this, block);
}

}  // namespace trc
