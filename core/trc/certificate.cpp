#include "core/trc/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/trc/joints.h"

namespace trc {
namespace {

// Half a turn, less what rounding may do to the sum of many turns.
constexpr double widest = std::numbers::pi - 1e-6;

// The turn from one unit vector to another. Most turns are small: an angle is dear, and the series
// of the arc tangent is as exact where the tangent is below 1/16, as its next term is below a
// rounding there.
double turn_of_chain(const Vector& before, const Vector& after) {
  const double sine = cross(before, after);
  const double cosine = before.dot(after);
  if (!(std::abs(sine) < cosine / 16)) return turn_between(before, after);
  const double tangent = sine / cosine;
  const double square = tangent * tangent;
  const double late = 1.0 / 9 - square * (1.0 / 11 - square / 13);
  return tangent *
         (1 - square * (1.0 / 3 - square * (1.0 / 5 - square * (1.0 / 7 - square * late))));
}

}  // namespace

// What outside corners add does not count: the proof is about equidistants without it.
Certificate::Block Certificate::block_of(const PathBlock& block) {
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  const double extent =
      left_of_block(block, std::max(block.cut_at_start, 0.0), std::max(block.cut_at_end, 0.0));
  const double left = extent * (arc != nullptr ? radius_of(*arc) : 1);
  return {.tangent_at_start = block.tangent_at_start,
          .tangent_at_end = block.tangent_at_end,
          .sweep = arc != nullptr ? arc->sweep : 0,
          .left = block.unreachable ? 0 : left,
          .shift_at_start = block.at_start.shift,
          .shift_at_end = block.at_end.shift};
}

void Certificate::begin_chain(std::size_t block, std::size_t last) {
  chain_ = block;
  while (last_of_chain_.end() < block)
    last_of_chain_.push_back(static_cast<HeldPath::Number>(last));
  directions_.drop_before(block);
  if (block > middle_) move_middle_to_end();
  up_to_middle_ = directions_from(block);
}

void Certificate::move_middle_to_end() {
  Directions behind;
  for (std::size_t number = directions_.end(); number-- > chain_;) {
    Directions& directions = directions_[number];
    directions.include(behind);
    behind = directions;
  }
  middle_ = directions_.end();
  behind_middle_ = {};
}

inline bool Certificate::is_too_wide() const {
  Directions all = behind_middle_;
  all.include(up_to_middle_);
  return all.greatest - all.least >= widest;
}

void Certificate::drop_before(std::size_t block) {
  first_of_chain_.drop_before(block);
  // Chains that go on from dropped blocks may.
  if (chain_ < block) begin_chain(block, size() - 1);
  last_of_chain_.drop_before(block);
}

void Certificate::append(const Block& block, bool apart) {
  const std::size_t index = size();
  const double at_start = direction_ + turn_of_chain(tangent_, block.tangent_at_start);
  const double at_end = at_start + block.sweep;
  tangent_ = block.tangent_at_end;
  direction_ = at_end;
  const bool breaks = apart || block.shift_at_start != shift_;
  shift_ = block.shift_at_end;
  const std::size_t before = index > 0 ? index - 1 : 0;
  const bool is_left =
      block.left > tolerances_.same_point && block.shift_at_start == block.shift_at_end;
  const bool alone = !is_left || std::abs(at_end - at_start) >= widest;
  if (breaks || alone) begin_chain(index, before);
  const Directions own{std::min(at_start, at_end), std::max(at_start, at_end)};
  directions_.push_back(own);
  behind_middle_.include(own);
  while (!alone && is_too_wide()) begin_chain(chain_ + 1, before);
  first_of_chain_.push_back(static_cast<HeldPath::Number>(chain_));
  if (alone) begin_chain(index + 1, index);
}

}  // namespace trc
