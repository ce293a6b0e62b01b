#pragma once

#include <type_traits>

#include "core/trc/loops/held_path.h"

// The appending functions of HeldPath for callers who know whether they append a Line or an Arc.

namespace trc {

template <class Programmed, class Path>
[[gnu::always_inline]] inline void HeldPath::append_contour(const MotionBlock& block,
                                                            const Programmed& programmed,
                                                            const Path& path, const Cuts& cuts,
                                                            Reach reach) {
  keep_contour(block, programmed, cuts);
  keep_path(path, note_setting_like_last(block), Role::contour, Origin::programmed, reach);
}

template <class Path>
[[gnu::always_inline]] inline void HeldPath::append_transition(const Path& path, Reach reach) {
  keep_path(path, last_setting(), Role::inserted, Origin::transition, reach);
}

template <class Path>
[[gnu::always_inline]] inline void HeldPath::append_transition(const MotionBlock& inserted,
                                                               const Path& path, Reach reach) {
  keep_path(path, note_setting_like_last(inserted), Role::inserted, Origin::transition, reach);
}

template <class Programmed>
[[gnu::always_inline]] inline void HeldPath::keep_contour(const MotionBlock& block,
                                                          const Programmed& programmed,
                                                          const Cuts& cuts) {
  has_roles_ = has_roles_ || block.role != ContourRole::unspecified;
  contour_.push_made([&] {
    return KeptContour{.start = programmed.start,
                       .end = programmed.end,
                       .index = block.source.index,
                       .n_word = block.source.number,
                       .line = block.source.line,
                       .block = static_cast<Number>(blocks_.end()),
                       .circle = static_cast<Number>(circles_.end()),
                       .is_arc = std::is_same_v<Programmed, Arc>,
                       .contour_role = block.role,
                       .part = block.source.part};
  });
  if constexpr (std::is_same_v<Programmed, Arc>)
    circles_.push_back({.arc = {programmed.center, programmed.sweep}, .cuts = cuts});
}

template <class Path>
[[gnu::always_inline]] inline HeldPath::KeptBlock& HeldPath::keep_path(const Path& path,
                                                                       Number setting, Role role,
                                                                       Origin origin, Reach reach) {
  const auto arc = static_cast<Number>(arcs_.end());
  if constexpr (std::is_same_v<Path, Arc>) arcs_.push_back({path.center, path.sweep});
  return blocks_.push_made([&] {
    return KeptBlock{.start = path.start,
                     .end = path.end,
                     .number = static_cast<Number>(contour_.end() > 0 ? contour_.end() - 1 : 0),
                     .setting = setting,
                     .arc = arc,
                     .role = role,
                     .origin = origin,
                     .is_arc = std::is_same_v<Path, Arc>,
                     .unreachable = reach == Reach::unreachable};
  });
}

[[gnu::always_inline]] inline HeldPath::Number HeldPath::note_setting_like_last(
    const MotionBlock& motion) {
  const Setting& last = settings_.back();
  const bool same = last.feed == motion.feed && last.normal == motion.normal &&
                    last.rapid == motion.rapid && last.tracking == motion.tracking;
  return same ? last_setting() : note_changed_setting(motion);
}

}  // namespace trc
