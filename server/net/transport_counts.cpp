#include "server/net/transport_counts.h"

#include <grpc/grpc.h>
#include <grpc/support/alloc.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string_view>

namespace trc::server {
namespace {

// gRPC writes this JSON itself: names of machines and numbers, no text from outside.
class Text {
 public:
  explicit Text(char* text) : text_(text, &gpr_free) {}
  [[nodiscard]] std::string_view view() const {
    return text_ == nullptr ? std::string_view() : std::string_view(text_.get());
  }

 private:
  std::unique_ptr<char, decltype(&gpr_free)> text_;
};

// The text in quotes after `"name":`, searched from `at` on; `at` then lies at its end. Empty:
// there is no more.
std::string_view next(std::string_view text, std::string_view name, std::size_t& at) {
  const std::string key = '"' + std::string(name) + "\":\"";
  const std::size_t begin = text.find(key, at);
  if (begin == std::string_view::npos) return {};
  const std::size_t value = begin + key.size();
  const std::size_t end = text.find('"', value);
  if (end == std::string_view::npos) return {};
  at = end;
  return text.substr(value, end - value);
}

template <class Number>
Number number_in(std::string_view digits) {
  Number number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

std::uint64_t count_in(std::string_view text, std::string_view name) {
  std::size_t at = 0;
  return number_in<std::uint64_t>(next(text, name, at));
}

}  // namespace

std::optional<std::int64_t> TransportCounts::number_of(const std::string& peer) {
  auto found = numbers_.find(peer);
  if (found == numbers_.end() && !is_fresh_) {
    read_numbers();
    found = numbers_.find(peer);
  }
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

void TransportCounts::read_numbers() {
  constexpr std::string_view kind = "chttp2 ";
  constexpr std::intptr_t most = 100'000;
  is_fresh_ = true;
  numbers_.clear();
  const Text servers(grpc_channelz_get_servers(0));
  std::size_t at = 0;
  for (std::string_view id; !(id = next(servers.view(), "serverId", at)).empty();) {
    const Text sockets(grpc_channelz_get_server_sockets(number_in<std::intptr_t>(id), 0, most));
    std::size_t place = 0;
    for (std::string_view name; !(name = next(sockets.view(), "name", place)).empty();) {
      const std::string_view number = next(sockets.view(), "socketId", place);
      if (name.starts_with(kind))
        numbers_.insert_or_assign(std::string(name.substr(kind.size())),
                                  number_in<std::int64_t>(number));
    }
  }
}

std::optional<TransportCounts::Streams> TransportCounts::streams_of(std::int64_t number) {
  const Text socket(grpc_channelz_get_socket(number));
  if (socket.view().empty()) return std::nullopt;
  // A stream that ends during the count must not seem to have ended before it began.
  Streams streams{.started = count_in(socket.view(), "streamsStarted"),
                  .succeeded = count_in(socket.view(), "streamsSucceeded"),
                  .failed = count_in(socket.view(), "streamsFailed")};
  streams.started = std::max(streams.started, streams.succeeded + streams.failed);
  return streams;
}

}  // namespace trc::server
