#include "core/trc/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/trc/joints.h"

namespace trc {
namespace {

// Half a turn, less what rounding may do to the sum of many turns.
constexpr double widest = std::numbers::pi - 1e-6;

// Whether something is left of the block between its inside corners. What outside
// corners add does not count: the proof is about equidistants without it.
bool is_left(const PathBlock& block, double same_point) {
  if (block.unreachable || block.at_start != block.at_end) return false;
  const double left =
      left_of_block(block, std::max(block.cut_at_start, 0.0), std::max(block.cut_at_end, 0.0));
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  return left * (arc != nullptr ? radius_of(*arc) : 1) > same_point;
}

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

void Certificate::begin_chain(std::size_t block, std::size_t last) {
  chain_ = block;
  while (last_of_chain_.end() < block)
    last_of_chain_.push_back(static_cast<HeldPath::Number>(last));
  while (!least_.empty() && least_.front().block < block) least_.pop_front();
  while (!greatest_.empty() && greatest_.front().block < block) greatest_.pop_front();
}

void Certificate::drop_before(std::size_t block) {
  first_of_chain_.drop_before(block);
  // Chains that go on from dropped blocks may.
  if (chain_ < block) begin_chain(block, size() - 1);
  last_of_chain_.drop_before(block);
}

void Certificate::append(const PathBlock& block, bool apart) {
  const std::size_t index = size();
  const auto* arc = std::get_if<Arc>(&block.programmed.path);
  const double at_start = direction_ + turn_of_chain(tangent_, block.tangent_at_start);
  const double at_end = at_start + (arc != nullptr ? arc->sweep : 0);
  tangent_ = block.tangent_at_end;
  direction_ = at_end;
  const bool breaks = apart || block.at_start.shift != shift_;
  shift_ = block.at_end.shift;
  const std::size_t before = index > 0 ? index - 1 : 0;
  if (breaks) begin_chain(index, before);
  const bool alone =
      !is_left(block, tolerances_.same_point) || std::abs(at_end - at_start) >= widest;
  if (alone) {
    begin_chain(index, before);
    first_of_chain_.push_back(static_cast<HeldPath::Number>(index));
    begin_chain(index + 1, index);
    return;
  }
  const Extreme least{index, std::min(at_start, at_end)};
  const Extreme greatest{index, std::max(at_start, at_end)};
  while (!least_.empty() && least_.back().direction >= least.direction) least_.pop_back();
  while (!greatest_.empty() && greatest_.back().direction <= greatest.direction)
    greatest_.pop_back();
  least_.push_back(least);
  greatest_.push_back(greatest);
  while (greatest_.front().direction - least_.front().direction >= widest)
    begin_chain(chain_ + 1, before);
  first_of_chain_.push_back(static_cast<HeldPath::Number>(chain_));
}

}  // namespace trc
