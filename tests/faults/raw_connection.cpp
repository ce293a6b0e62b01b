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

constexpr std::uint8_t data_type = 0;
constexpr std::uint8_t headers_type = 1;
constexpr std::uint8_t reset_type = 3;
constexpr std::uint8_t settings_type = 4;
constexpr std::uint8_t end_headers = 4;

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
}

std::string frame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream,
                  std::string_view payload) {
  std::string bytes;
  put(bytes, static_cast<std::uint32_t>(payload.size()), 3);
  put(bytes, type, 1);
  put(bytes, flags, 1);
  put(bytes, stream, 4);
  return bytes.append(payload);
}

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

std::string greeting() {
  return "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame(settings_type, 0, 0, "");
}

std::string headers(std::uint32_t stream, std::string_view path) {
  return frame(headers_type, end_headers, stream,
               literal(":method", "POST") + literal(":scheme", "http") + literal(":path", path) +
                   literal(":authority", "localhost") + literal("te", "trailers") +
                   literal("content-type", "application/grpc"));
}

std::string reset(std::uint32_t stream) {
  constexpr std::uint32_t cancel = 8;
  std::string why;
  put(why, cancel, 4);
  return frame(reset_type, 0, stream, why);
}

std::string empty_data(std::uint32_t stream) { return frame(data_type, 0, stream, ""); }

}  // namespace http2
}  // namespace trc::faults
