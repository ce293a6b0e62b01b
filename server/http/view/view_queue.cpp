#include "server/http/view/view_queue.h"

#include <algorithm>

namespace trc::server::http {
namespace {

// A few megabytes.
constexpr std::size_t most_blocks = 32'768;
// For one spare piece: the memory of a whole selection goes back to the system.
constexpr std::size_t most_spare_blocks = 4096;
constexpr std::size_t most_spares = 64;

std::size_t blocks_of(const ViewQueue::Piece& piece) {
  return std::visit([](const auto& blocks) { return blocks.size(); }, piece);
}

bool is_empty_spare(const ViewQueue::Piece& piece) {
  return std::visit([](const auto& blocks) { return blocks.capacity() == 0; }, piece);
}

}  // namespace

ViewQueue::Taker ViewQueue::put(Piece piece) {
  const std::lock_guard lock(mutex_);
  blocks_ += blocks_of(piece);
  waiting_.push_back(std::move(piece));
  return std::exchange(is_taken_, true) ? Taker::comes : Taker::wanted;
}

std::optional<ViewQueue::Piece> ViewQueue::take() {
  const std::lock_guard lock(mutex_);
  is_taken_ = !waiting_.empty();
  if (waiting_.empty()) return std::nullopt;
  Piece piece = std::move(waiting_.front());
  waiting_.pop_front();
  blocks_ -= blocks_of(piece);
  return piece;
}

bool ViewQueue::is_full() const {
  const std::lock_guard lock(mutex_);
  return blocks_ > most_blocks;
}

void ViewQueue::give_back(Piece piece) {
  const bool is_large = blocks_of(piece) > most_spare_blocks;
  std::visit([](auto& blocks) { blocks.clear(); }, piece);
  const std::lock_guard lock(mutex_);
  std::erase_if(spares_, is_empty_spare);
  if (!is_large && spares_.size() < most_spares) spares_.push_back(std::move(piece));
}

}  // namespace trc::server::http
