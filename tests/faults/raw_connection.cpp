#include "tests/faults/raw_connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace trc::faults {

RawConnection::RawConnection(const std::string& address, const char* from)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  // A server that reads no more must not hold the test up.
  const timeval longest{.tv_sec = 2, .tv_usec = 0};
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof(longest));
  sockaddr_in own{};
  own.sin_family = AF_INET;
  inet_pton(AF_INET, from, &own.sin_addr);
  const bool bound = bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof(own)) == 0;
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(static_cast<in_port_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  connected_ =
      bound && connect(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0;
}

RawConnection::~RawConnection() { close(socket_); }

bool RawConnection::send_bytes(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool RawConnection::is_open() const {
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t size = ::recv(socket_, part.data(), part.size(), MSG_DONTWAIT);
    if (size == 0) return false;
    if (size < 0) return errno == EAGAIN;
  }
}

namespace http2 {
namespace {

// A header that is not remembered, without Huffman's code.
std::string literal(std::string_view name, std::string_view value) {
  std::string bytes(1, '\0');
  for (const std::string_view part : {name, value}) {
    bytes += static_cast<char>(part.size());
    bytes += part;
  }
  return bytes;
}

}  // namespace

std::string number(std::uint32_t value, int count) {
  std::string bytes;
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
  return bytes;
}

std::string frame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream,
                  std::string_view payload) {
  return number(static_cast<std::uint32_t>(payload.size()), 3) + number(type, 1) +
         number(flags, 1) + number(stream, 4) + std::string(payload);
}

std::string greeting(std::string_view settings_payload) {
  return "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame(settings, 0, 0, settings_payload);
}

std::string header_block(std::string_view path) {
  return literal(":method", "POST") + literal(":scheme", "http") + literal(":path", path) +
         literal(":authority", "localhost") + literal("te", "trailers") +
         literal("content-type", "application/grpc");
}

std::string headers(std::uint32_t stream, std::string_view path) {
  return frame(headers_frame, end_headers, stream, header_block(path));
}

std::string reset(std::uint32_t stream) {
  constexpr std::uint8_t reset_frame = 3;
  constexpr std::uint32_t cancel = 8;
  return frame(reset_frame, 0, stream, number(cancel, 4));
}

std::string empty_data(std::uint32_t stream) { return frame(data, 0, stream, ""); }

std::string message(std::uint32_t stream, std::string_view payload) {
  constexpr std::size_t largest = 16384;
  const std::string whole =
      '\0' + number(static_cast<std::uint32_t>(payload.size()), 4) + std::string(payload);
  std::string bytes;
  for (std::size_t at = 0; at < whole.size(); at += largest)
    bytes += frame(data, 0, stream, std::string_view(whole).substr(at, largest));
  return bytes;
}

}  // namespace http2
}  // namespace trc::faults
