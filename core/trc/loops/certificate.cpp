#include "core/trc/loops/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/trc/joints/joints.h"

namespace trc {
namespace {

// Half a turn on the square, less a margin for rounding.
constexpr double widest = 2 - 1e-6;

// The place where a direction meets a square with its corners on the axes, in quarters of a turn
// from the first axis, -2 to 2. It grows with the angle, by at most the same amount in rad, and by
// 2 in any half turn. An angle would be expensive.
double on_square(const Vector& direction) {
  const double size = std::abs(direction.x()) + std::abs(direction.y());
  return std::copysign(1 - direction.x() / size, direction.y());
}

}  // namespace

// Goes on by the shorter way round.
inline double Certificate::counted_on(double on_square) {
  double direction = turns_ + on_square;
  const double turn = direction - direction_;
  if (std::abs(turn) > 2) {
    const double full = std::copysign(4, turn);
    turns_ -= full;
    direction -= full;
  }
  return direction_ = direction;
}

// The length that outside corners add does not count: the proof is about equidistants without it.
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

void Certificate::clear() {
  first_of_chain_.clear();
  last_of_chain_.clear();
  directions_.clear();
  chain_ = middle_ = 0;
  direction_ = turns_ = shift_ = 0;
  up_to_middle_ = behind_middle_ = {};
}

void Certificate::drop_before(std::size_t block) {
  first_of_chain_.drop_before(block);
  // The current chain may begin in the dropped blocks.
  if (chain_ < block) begin_chain(block, size() - 1);
  last_of_chain_.drop_before(block);
}

void Certificate::append(const Block& block, Begin begin) {
  const std::size_t index = size();
  const double at_start = counted_on(on_square(block.tangent_at_start));
  const double at_end = block.sweep == 0 ? at_start : counted_on(on_square(block.tangent_at_end));
  const bool breaks = begin == Begin::behind_gap || block.shift_at_start != shift_;
  shift_ = block.shift_at_end;
  const std::size_t before = index > 0 ? index - 1 : 0;
  const bool is_left =
      block.left > tolerances_.same_point && block.shift_at_start == block.shift_at_end;
  const bool alone = !is_left || std::abs(block.sweep) >= widest_arc;
  if (breaks || alone) begin_chain(index, before);
  const Directions own{std::min(at_start, at_end), std::max(at_start, at_end)};
  directions_.push_back(own);
  behind_middle_.include(own);
  while (!alone && is_too_wide()) begin_chain(chain_ + 1, before);
  first_of_chain_.push_back(static_cast<HeldPath::Number>(chain_));
  if (alone) begin_chain(index + 1, index);
}

}  // namespace trc
