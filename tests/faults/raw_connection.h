#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace trc::faults {

// A TCP connection to a loopback port that sends what it is told.
class RawConnection {
 public:
  // Comes from that address of the loopback network: each is a peer of its own.
  explicit RawConnection(const std::string& address, const char* from = "127.0.0.1");
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  [[nodiscard]] bool connected() const { return connected_; }
  // False when the other side has gone, or reads nothing for two seconds.
  bool send_bytes(std::string_view bytes) const;
  // Reads and forgets what has come. False when the other side has closed the connection.
  [[nodiscard]] bool is_open() const;

 private:
  int socket_;
  bool connected_ = false;
};

// The parts of HTTP/2 that a client may misuse.
namespace http2 {

enum Type : std::uint8_t {
  data = 0,
  headers_frame = 1,
  priority = 2,
  settings = 4,
  ping = 6,
  goaway = 7,
  window_update = 8,
  continuation = 9,
};
constexpr std::uint8_t end_headers = 4;

// So many bytes of a number, the most significant one first.
std::string number(std::uint32_t value, int count);
std::string frame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream,
                  std::string_view payload);
// The preface and SETTINGS, empty unless told.
std::string greeting(std::string_view settings_payload = "");
// What the HEADERS of a call hold.
std::string header_block(std::string_view path);
// The HEADERS of a call, without an end of the stream.
std::string headers(std::uint32_t stream, std::string_view path);
std::string reset(std::uint32_t stream);
// DATA without a byte.
std::string empty_data(std::uint32_t stream);
// A message of gRPC, in frames that every server takes.
std::string message(std::uint32_t stream, std::string_view payload);

}  // namespace http2
}  // namespace trc::faults
