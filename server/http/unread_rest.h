#pragma once

#include <boost/beast/core.hpp>
#include <cstddef>
#include <functional>
#include <memory>

#include "server/http/body_reader.h"

namespace trc::server::http {

// What is left of a request that was answered before it had come. A connection that is closed while
// bytes of the client are unread is reset, and the answer may be lost with it.
class UnreadRest {
 public:
  UnreadRest(boost::beast::tcp_stream& stream, boost::beast::flat_buffer& buffer)
      : stream_(stream), buffer_(buffer) {}

  // Reads and forgets it until there is no more, or too much. `owner` of the stream lives until
  // then.
  void forget(const std::shared_ptr<void>& owner, const std::function<void()>& then) {
    buffer_.clear();
    stream_.async_read_some(
        buffer_.prepare(piece_bytes),
        [this, owner, then](boost::system::error_code fault, std::size_t bytes) {
          forgotten_bytes_ += bytes;
          if (fault || forgotten_bytes_ > most_bytes) return then();
          forget(owner, then);
        });
  }

 private:
  static constexpr std::size_t most_bytes = 4U << 20U;

  boost::beast::tcp_stream& stream_;
  boost::beast::flat_buffer& buffer_;
  std::size_t forgotten_bytes_ = 0;
};

}  // namespace trc::server::http
