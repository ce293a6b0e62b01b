#pragma once

#include "core/trc/passes/loop_removal.h"

namespace trc {

// The short way into LoopRemoval: ShortWay gives it the blocks in the middle of a contour as the
// lines and arcs they are, after blocks of the same mode and compensation, without making path
// blocks of them.
//
// Functions that take a block return false once the stream must stop, and append to `out` the
// blocks that a window releases.
class LoopRemoval::PlainEntry {
 public:
  // `Programmed` and `Path` are Lines or Arcs.
  template <class Programmed, class Path>
  struct ContourBlock {
    const MotionBlock& block;
    const Programmed& programmed;  // its path
    const Path& path;              // of the tool
    HeldPath::Cuts cuts{};
    Certificate::Block course{};
    HeldPath::Reach reach{};
  };
  // The block that goes round the corner after a contour block.
  template <class Path>
  struct Transition {
    const Path& path;
    HeldPath::Reach reach{};
  };

  explicit PlainEntry(LoopRemoval& into) : into_(into) {}

  // Whether the middle of a contour is held, so that more of it may come.
  [[nodiscard]] bool is_open() const {
    return into_.phase_ == Phase::holding && into_.end_of_contour() > 0;
  }
  // Whether the next block may be given if it is like this one.
  [[nodiscard]] bool takes_more_like(const PathBlock& block) const {
    return into_.held_.path.follows_like(block);
  }
  // To be called before such a block is given.
  void go_on_like_last() { into_.held_.path.go_on_like_last(); }
  // Whether a block may release others.
  [[nodiscard]] bool has_window() const { return into_.window_ > 0; }

  template <class Programmed, class Path>
  bool take(const ContourBlock<Programmed, Path>& given, PathBlocks& out);
  // An inserted block: but for its path like the contour block before it, which has this source.
  template <class Path>
  bool take(const Transition<Path>& given, const Source& source, PathBlocks& out);
  // As `inserted`.
  template <class Path>
  bool take(const Transition<Path>& given, const MotionBlock& inserted, PathBlocks& out);

 private:
  [[nodiscard]] bool go_on_behind(HeldPath::Reach transition, PathBlocks& out) {
    into_.held_.gap = into_.held_.gap || transition == HeldPath::Reach::unreachable;
    return go_on(out);
  }
  [[nodiscard]] bool go_on(PathBlocks& out) { return !has_window() || into_.proceed(out); }

  LoopRemoval& into_;
};

template <class Programmed, class Path>
[[gnu::always_inline]] inline bool LoopRemoval::PlainEntry::take(
    const ContourBlock<Programmed, Path>& given, PathBlocks& out) {
  if (!into_.has_room_for(given.block.source)) return false;
  into_.held_.path.append_contour(given.block, given.programmed, given.path, given.cuts,
                                  given.reach);
  into_.note_contour_block(bounding_box(given.programmed), given.course);
  return go_on(out);
}

template <class Path>
[[gnu::always_inline]] inline bool LoopRemoval::PlainEntry::take(const Transition<Path>& given,
                                                                 const Source& source,
                                                                 PathBlocks& out) {
  if (!into_.has_room_for(source)) return false;
  into_.held_.path.append_transition(given.path, given.reach);
  return go_on_behind(given.reach, out);
}

template <class Path>
[[gnu::always_inline]] inline bool LoopRemoval::PlainEntry::take(const Transition<Path>& given,
                                                                 const MotionBlock& inserted,
                                                                 PathBlocks& out) {
  if (!into_.has_room_for(inserted.source)) return false;
  into_.held_.path.append_transition(inserted, given.path, given.reach);
  return go_on_behind(given.reach, out);
}

}  // namespace trc
