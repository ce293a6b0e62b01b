#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"

namespace trc::server::http {

// Pieces that a stream has given to a view and that are not in it yet: one thread gives, another
// one takes, and the stream goes on meanwhile. Pieces come out in the order they went in.
class ViewQueue {
 public:
  // Blocks of the contour or of the path.
  using Piece = std::variant<std::vector<Block>, std::vector<CompensatedBlock>>;

  enum class Taker {
    comes,   // a thread takes the pieces
    wanted,  // no thread does: one has to be started, once
  };
  Taker put(Piece piece);
  // None: no piece waits, and the taking thread is done.
  [[nodiscard]] std::optional<Piece> take();
  // So many wait that the giving thread should take some itself.
  [[nodiscard]] bool is_full() const;

  // Memory of pieces that were put in, to be used again.
  template <class OfPiece>
  [[nodiscard]] std::vector<OfPiece> spare() {
    const std::lock_guard lock(mutex_);
    for (Piece& piece : spares_) {
      auto* blocks = std::get_if<std::vector<OfPiece>>(&piece);
      if (blocks == nullptr || blocks->capacity() == 0) continue;
      return std::exchange(*blocks, {});
    }
    return {};
  }
  void give_back(Piece piece);

 private:
  mutable std::mutex mutex_;
  std::deque<Piece> waiting_;
  std::size_t blocks_ = 0;  // that wait
  bool is_taken_ = false;
  std::vector<Piece> spares_;
};

}  // namespace trc::server::http
