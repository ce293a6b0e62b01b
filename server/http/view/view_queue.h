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

// What a stream has given to a view and nobody has put in yet: one thread gives, another one takes,
// and the stream goes on in the meantime. Pieces come out in the order they went in.
class ViewQueue {
 public:
  // Blocks of the contour or of the path.
  using Piece = std::variant<std::vector<Block>, std::vector<CompensatedBlock>>;

  enum class Taker {
    comes,   // somebody takes what waits
    wanted,  // nobody does: somebody has to be sent, once
  };
  Taker put(Piece piece);
  // None: nothing waits, and whoever took has gone.
  [[nodiscard]] std::optional<Piece> take();
  // So much waits that whoever gives had better take some of it.
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
