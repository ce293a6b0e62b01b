#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "trc/v1/trc_service.pb.h"

namespace trc::client {

// How much goes into one request. Until the server has said what it takes (`accepted`), which it
// does behind the first one, as much as every server takes (`max-message-bytes` from 4096 up).
class MessageSize {
 public:
  void take(const v1::StreamAccepted& accepted) {
    if (accepted.max_message_bytes() > 0) most_bytes_ = accepted.max_message_bytes();
  }

  // Bytes of text: enough to cost nothing, with room for the fields around them.
  [[nodiscard]] std::size_t text_bytes() const {
    return static_cast<std::size_t>(std::min<std::uint64_t>(most_bytes_, 64U * 1024U)) - 64;
  }

  // Blocks: where a further one costs next to nothing, and more only adds delay; any server takes
  // as many in a batch (D-58). A plain block takes 45 bytes, one with many axes is counted here.
  [[nodiscard]] std::size_t blocks() const {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(most_bytes_ / 128, 1, 1024));
  }

 private:
  std::uint64_t most_bytes_ = 4096;
};

}  // namespace trc::client
