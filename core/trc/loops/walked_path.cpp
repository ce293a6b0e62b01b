#include "core/trc/loops/walked_path.h"

#include <algorithm>

namespace trc {

PathPiece WalkedPath::operator[](std::size_t number) const {
  const auto& [block, cut] = pieces_[number];
  if (cut != Kept::whole) return cuts_[cut];
  const Segment& segment = path_.block(block).path;
  return {
      .block = block, .to = length_of(segment), .start = start_of(segment), .end = end_of(segment)};
}

std::size_t WalkedPath::whole_in_a_row(std::size_t block, std::size_t most) const {
  most = std::min(most, pieces_.size());
  auto pieces = pieces_.from(begin());
  std::size_t count = 0;
  for (; count < most; ++count) {
    const Kept& kept = pieces.next();
    if (kept.cut != Kept::whole || kept.block != block + count) break;
  }
  return count;
}

void WalkedPath::add(const PathPiece& piece) {
  pieces_.push_back(
      {static_cast<HeldPath::Number>(piece.block), static_cast<HeldPath::Number>(cuts_.end())});
  cuts_.push_back(piece);
  if (finds_near_) note_box(piece.block);
}

void WalkedPath::truncate(std::size_t number) {
  for (std::size_t last = pieces_.end(); last-- > number;)
    if (pieces_[last].cut != Kept::whole) cuts_.truncate(pieces_[last].cut);
  pieces_.truncate(number);
  if (finds_near_) boxes_.truncate(number);
}

void WalkedPath::clear() {
  pieces_.clear();
  cuts_.clear();
  boxes_.clear();
}

void WalkedPath::note_box(std::size_t block) {
  boxes_.append(bounding_box(path_.block(block).path));
}

void WalkedPath::rebuild_boxes() {
  boxes_.clear(pieces_.begin());
  if (!finds_near_) return;
  for (std::size_t number = pieces_.begin(); number < pieces_.end(); ++number)
    note_box(pieces_[number].block);
}

}  // namespace trc
