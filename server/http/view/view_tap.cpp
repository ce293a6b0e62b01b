#include "server/http/view/view_tap.h"

#include <optional>
#include <utility>
#include <variant>

namespace trc::server::http {

ViewTap::ViewTap(std::shared_ptr<ViewBuilder> builder, Help help)
    : builder_(std::move(builder)), help_(std::move(help)) {}

void ViewTap::take_contour(std::span<const Block> blocks) {
  std::vector<Block> piece = queue_.spare<Block>();
  piece.assign(blocks.begin(), blocks.end());
  give(std::move(piece));
}

void ViewTap::take_path(std::vector<CompensatedBlock>& blocks) {
  std::vector<CompensatedBlock> piece = queue_.spare<CompensatedBlock>();
  piece.swap(blocks);
  give(std::move(piece));
}

void ViewTap::finish() {
  while (put_in_next()) {
  }
}

void ViewTap::close() {
  const std::lock_guard lock(giving_);
  closed_ = true;
}

void ViewTap::give(ViewQueue::Piece piece) {
  const std::lock_guard lock(giving_);
  if (closed_) return;
  if (queue_.put(std::move(piece)) == ViewQueue::Taker::wanted)
    help_.compute([self = shared_from_this()] {
      while (self->put_in_next()) self->help_.pass();
    });
  while (queue_.is_full() && put_in_next()) {
  }
}

bool ViewTap::put_in_next() {
  const std::lock_guard lock(putting_in_);
  std::optional<ViewQueue::Piece> piece = queue_.take();
  if (!piece) return false;
  if (const auto* contour = std::get_if<std::vector<Block>>(&*piece))
    builder_->take_contour(*contour);
  else
    builder_->take_path(std::get<std::vector<CompensatedBlock>>(*piece));
  queue_.give_back(std::move(*piece));
  return true;
}

}  // namespace trc::server::http
