#include "core/verify/measured_path.h"

#include <algorithm>
#include <cmath>

#include "core/verify/part_wall.h"
#include "core/verify/shape.h"
#include "core/verify/wall_tree.h"

namespace trc::verify {
namespace {

bool is_measured(Origin origin) {
  switch (origin) {
    case Origin::programmed:
    case Origin::transition:
    case Origin::radius_change:
    case Origin::kerf:
    case Origin::converted_circle:
      return true;
    case Origin::approach:
    case Origin::retract:
    case Origin::masked:
    case Origin::passthrough:
    case Origin::uncompensated:
      break;
  }
  return false;
}

}  // namespace

std::uint32_t MeasuredPath::number_of(const std::shared_ptr<const TrcMode>& shared) {
  if (shared == last_mode_ && !rules_.empty()) return static_cast<std::uint32_t>(rules_.size() - 1);
  last_mode_ = shared;
  const TrcMode& mode = *shared;
  const double required = mode.cutting_radius();
  const bool follows = !mode.options.suppress_trc && required > 0;
  const Rule rule{.selection = mode.selection_number,
                  .required = follows ? required : 0,
                  .radius = required,
                  .side = mode.cutting_side(),
                  .nominal = follows ? mode.nominal_radius : 0,
                  .plane = mode.plane,
                  .reverses = mode.options.reverse,
                  .follows = follows,
                  .joins_fine_steps = !mode.removes_loops()};
  if (rules_.empty() || rules_.back() != rule) rules_.push_back(rule);
  return static_cast<std::uint32_t>(rules_.size() - 1);
}

// The approach block is no contour, and neither is the block that carries the
// change to the other side, unless the side changes at its corner (REVERSE).
bool MeasuredPath::is_contour(const MotionBlock& block, Side side) const {
  const TrcMode& mode = *block.mode;
  const Rule* before = programmed_.empty() ? nullptr : &rule_of(programmed_.back());
  if (before == nullptr || before->selection != mode.selection_number)
    return mode.selection == Selection::perpendicular && !mode.tangential;
  if (before->side == side) return true;
  return mode.options.reverse;
}

void MeasuredPath::add(const MotionBlock& block) {
  if (!is_finite(block.path)) return;
  const std::uint32_t rule = number_of(block.mode);
  const Rule& own = rules_[rule];
  ProgrammedPiece* before = programmed_.empty() ? nullptr : &programmed_.back();
  const bool goes_on = before != nullptr && before->rule == rule;
  const bool contour = goes_on || is_contour(block, own.side);
  ProgrammedPiece& piece = programmed_.push_made([&] {
    return ProgrammedPiece{.piece = piece_of(block.path),
                           .source = block.source,
                           .rule = rule,
                           .is_contour = contour,
                           .from_anywhere = block.mode->from_anywhere,
                           .role = block.role};
  });
  if (own.nominal > 0) put_at_part(piece);
  if (before == nullptr) return;
  const Rule& rule_before = rule_of(*before);
  if (!goes_on && rule_before.selection != own.selection) return;
  piece.number = before->number + (before->is_contour ? 1 : 0);
  if (goes_on) return;
  before->crosses_behind = piece.is_contour && rule_before.side != own.side;
}

void MeasuredPath::put_at_part(ProgrammedPiece& last) {
  const Rule& rule = rules_[last.rule];
  PartWall wall = part_wall(last.piece, rule.side, rule.nominal);
  wall.exists = wall.exists && last.is_contour;
  // Short walls may end before they begin: then the wall before them is the neighbour.
  constexpr std::size_t most_gone = 64;
  const std::size_t end = programmed_.end() - 1;
  for (std::size_t place = end; place > programmed_.begin() && end - place < most_gone;) {
    ProgrammedPiece& before = programmed_[--place];
    const Rule& rule_before = rule_of(before);
    if (rule_before.selection != rule.selection || rule_before.side != rule.side) break;
    if (!before.is_contour) continue;
    PartWall wall_before{.piece = before.piece};
    end_at_corner(wall_before, wall, rule.side);
    before.piece = wall_before.piece;
    before.is_contour = wall_before.exists;
    if (before.is_contour) break;
    for (std::size_t behind = place + 1; behind < end; ++behind)
      programmed_[behind].number = before.number;
  }
  last.piece = wall.piece;
  last.is_contour = wall.exists;
}

void MeasuredPath::add_way(const CompensatedBlock& block) {
  if (block.normal.moves() || !is_finite(block.path)) return;
  std::size_t number = first_from(block.source);
  if (block.origin == Origin::retract) {
    if (number == programmed_.begin()) return;
    --number;
  } else if (number == programmed_.end() || programmed_[number].from_anywhere ||
             is_before(block.source, programmed_[number].source)) {
    return;
  }
  ways_.push_back({.piece = piece_of(block.path),
                   .height = block.normal.to,
                   .source = block.source,
                   .programmed = number});
}

void MeasuredPath::add(const CompensatedBlock& block) {
  if (block.origin == Origin::approach || block.origin == Origin::retract) return add_way(block);
  if (!is_measured(block.origin) || programmed_.empty() || !is_finite(block.path)) return;
  const ProgrammedPiece* stems_from = find(block.source);
  if (stems_from == nullptr) return;
  const bool inserted = block.origin == Origin::transition || block.origin == Origin::radius_change;
  if (inserted && stems_from->crosses_behind) return;
  path_.push_made([&] {
    return MeasuredPiece{.piece = piece_of(block.path),
                         .height = block.normal.to,
                         .programmed = last_,
                         .inserted = inserted,
                         .on_contour = block.origin == Origin::programmed};
  });
}

std::size_t MeasuredPath::first_from(const Source& source) const {
  std::size_t low = programmed_.begin();
  std::size_t high = programmed_.end();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (is_before(programmed_[middle].source, source))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

// The path follows the program, except at the seam of a closed contour: the next piece is near.
const ProgrammedPiece* MeasuredPath::find(const Source& source) {
  last_ = std::max(last_, programmed_.begin());
  // Usually it is the last piece found, or the next one.
  for (std::size_t number = last_; number < std::min(last_ + 2, programmed_.end()); ++number) {
    const ProgrammedPiece& piece = programmed_[number];
    if (piece.source.index != source.index || piece.source.part != source.part) continue;
    last_ = number;
    return &piece;
  }
  if (last_ >= programmed_.end() || is_before(source, programmed_[last_].source))
    last_ = first_from(source);
  for (; last_ < programmed_.end(); ++last_) {
    const ProgrammedPiece& piece = programmed_[last_];
    if (!is_before(piece.source, source)) return is_before(source, piece.source) ? nullptr : &piece;
  }
  return nullptr;
}

void MeasuredPath::forget_before(std::size_t number) {
  programmed_.drop_before(number);
  path_.drop_before(path_.end());
  std::erase_if(ways_, [&](const Way& way) { return way.programmed < number; });
  if (programmed_.empty()) rules_.clear();
}

std::size_t MeasuredPath::bytes() const {
  return programmed_.size() * sizeof(ProgrammedPiece) + path_.size() * sizeof(MeasuredPiece) +
         ways_.capacity() * sizeof(Way) + rules_.capacity() * sizeof(Rule) +
         WallTree::bytes_for(programmed_.size()) + programmed_.size() * sizeof(std::size_t);
}

}  // namespace trc::verify
