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

// The preface and empty SETTINGS.
std::string greeting();
// The HEADERS of a call, without an end of the stream.
std::string headers(std::uint32_t stream, std::string_view path);
std::string reset(std::uint32_t stream);
// DATA without a byte.
std::string empty_data(std::uint32_t stream);

}  // namespace http2
}  // namespace trc::faults
