#include "core/verify/selection_walls.h"

#include <algorithm>

namespace trc::verify {

SelectionWalls::SelectionWalls(const MeasuredPath& held, std::size_t begin, std::size_t end,
                               const ClearanceSettings& settings, Checkpoint& checkpoint)
    : held_(&held), begin_(begin), end_(end), tolerances_(settings.tolerances) {
  find_contour(checkpoint);
  const ContourView view = contour(checkpoint);
  if (changes_.empty())
    sides_.sides.push_back(find_walls(view, settings.leads, largest_radius()));
  else
    sides_ = find_walls(view, changes_, settings.leads, largest_radius());
  are_plain_ = sides_.sides.size() == 1 && sides_.sides.front().are_plain();
  tree_.emplace(held, begin, end, sides_, checkpoint);
  count_walls(checkpoint);
}

void SelectionWalls::count_walls(Checkpoint& checkpoint) {
  count_ = contour_.size();
  length_ = contour_length_;
  if (tree_->are_whole()) return;
  length_ = 0;
  auto pieces = held_->programmed().from(begin_);
  for (std::size_t place = begin_; place < end_; ++place) {
    checkpoint.pass();
    const ProgrammedPiece& block = pieces.next();
    if (!block.is_contour) continue;
    length_ += wall_of(block).length();
    if (sides_.is_lead(block.number)) --count_;
  }
}

void SelectionWalls::find_contour(Checkpoint& checkpoint) {
  const auto side_of = [&](const ProgrammedPiece& block) { return held_->rule_of(block).side; };
  auto pieces = held_->programmed().from(begin_);
  Side side = Side::off;
  for (std::size_t place = begin_; place < end_; ++place) {
    checkpoint.pass();
    const ProgrammedPiece& block = pieces.next();
    if (!block.is_contour) continue;
    if (!contour_.empty() && side != side_of(block)) changes_.push_back(contour_.size());
    side = side_of(block);
    contour_.push_back(static_cast<std::uint32_t>(place - begin_));
    contour_length_ += block.piece.length();
    const Vector step = (block.piece.end - block.piece.start).cwiseAbs();
    shortest_step_ = std::min(shortest_step_, std::max(step.x(), step.y()));
    has_roles_ = has_roles_ || block.role != ContourRole::unspecified;
  }
}

ContourView SelectionWalls::contour(Checkpoint& checkpoint) const {
  ContourView view{.count = contour_.size(), .segment = [this](std::size_t number) {
                     return segment_of(piece(number).piece);
                   }};
  if (has_roles_) view.role = [this](std::size_t number) { return piece(number).role; };
  if (!contour_.empty()) {
    view.tool_side = held_->rule_of(piece(0)).side;
    view.shift = view.tool_side == Side::left ? 1 : -1;
  }
  view.shortest_step = shortest_step_;
  view.tolerances = tolerances_;
  view.checkpoint = &checkpoint;
  return view;
}

double SelectionWalls::largest_radius() const {
  double radius = 0;
  for (std::size_t number = 0; number < contour_.size(); ++number) {
    radius = std::max(radius, held_->rule_of(piece(number)).radius);
    // Rule numbers only rise.
    if (piece(number).rule == piece(contour_.size() - 1).rule) break;
  }
  return radius;
}

Stretch SelectionWalls::part_of(const ProgrammedPiece& block) const {
  const double length = block.piece.length();
  if (sides_.is_lead(block.number)) return {};
  const auto part = sides_.part_of(block.number);
  return part ? Stretch{part->from, std::min(part->to, length)} : Stretch{0, length};
}

void SelectionWalls::move_to(const MeasuredPath& held, std::size_t begin, Checkpoint& checkpoint) {
  held_ = &held;
  end_ = begin + (end_ - begin_);
  begin_ = begin;
  tree_->move_to(held, begin, checkpoint);
}

bool KnownWalls::are_same(const std::vector<WallPiece>& pieces, const MeasuredPath& held,
                          std::size_t begin, Checkpoint& checkpoint) {
  auto others = held.programmed().from(begin);
  return std::all_of(pieces.begin(), pieces.end(), [&](const WallPiece& own) {
    checkpoint.pass();
    const ProgrammedPiece& other = others.next();
    return own.piece.start == other.piece.start && own.piece.end == other.piece.end &&
           own.piece.center == other.piece.center && own.piece.sweep == other.piece.sweep &&
           own.rule == other.rule && own.number == other.number &&
           own.is_contour == other.is_contour && own.side == held.rule_of(other).side &&
           own.role == other.role;
  });
}

const SelectionWalls& KnownWalls::of(const MeasuredPath& held, std::size_t begin, std::size_t end,
                                     const ClearanceSettings& settings, Checkpoint& checkpoint) {
  Known& known = known_[held.programmed()[begin].source.index];
  if (known.walls && known.pieces.size() == end - begin &&
      are_same(known.pieces, held, begin, checkpoint)) {
    known.walls->move_to(held, begin, checkpoint);
    if (known.walls->by_radius(settings.leads, checkpoint) == known.by_radius) return *known.walls;
  }
  known.pieces.clear();
  known.pieces.reserve(end - begin);
  auto pieces = held.programmed().from(begin);
  for (std::size_t number = begin; number < end; ++number) {
    checkpoint.pass();
    const ProgrammedPiece& piece = pieces.next();
    known.pieces.push_back({.piece = piece.piece,
                            .rule = piece.rule,
                            .number = piece.number,
                            .is_contour = piece.is_contour,
                            .side = held.rule_of(piece).side,
                            .role = piece.role});
  }
  known.walls = std::make_unique<SelectionWalls>(held, begin, end, settings, checkpoint);
  known.by_radius = known.walls->by_radius(settings.leads, checkpoint);
  return *known.walls;
}

}  // namespace trc::verify
