#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "client/trc/failure.h"
#include "trc/v1/trc_service.pb.h"

namespace grpc {
class Channel;
}

namespace trc::client {

// PEM files. Without any the connection is not encrypted.
struct TlsFiles {
  std::string ca{};    // of the server; empty with a certificate: the system's
  std::string cert{};  // of the client, together with `key`
  std::string key{};

  [[nodiscard]] bool any() const { return !ca.empty() || !cert.empty() || !key.empty(); }
};

// How a session goes on after it has lost its server or the connection. The output is that of an
// unbroken stream; the caller only sees a pause.
struct ResumePolicy {
  // Time without progress after which the session fails with the last failure. 0: at once.
  std::chrono::milliseconds patience{60'000};
  // Between attempts, doubling from the first to the longest.
  std::chrono::milliseconds first_wait{100};
  std::chrono::milliseconds longest_wait{5'000};
  // The most input kept in case the server needs it again. A selection held as a whole that exceeds
  // it cannot be resumed.
  std::size_t most_kept_bytes = std::size_t{256} << 20U;
  // Called before each wait with its reason, in the thread that uses the session.
  std::function<void(const Failure&)> waiting{};
};

struct ConnectionOptions {
  // A frozen or unplugged server is noticed after the sum of the two.
  std::chrono::milliseconds keepalive_time{30'000};
  std::chrono::milliseconds keepalive_timeout{10'000};
  ResumePolicy resume{};
  // Not shared with other connections of this process to the same address.
  bool separate = false;
};

// A way to a server, or to several that do for each other. Cheap to copy; a connection serves any
// number of sessions and re-establishes itself.
class Connection {
 public:
  // HOST:PORT, [IPV6]:PORT or unix:/path for one server, or a balancer. For several servers IP
  // addresses and ports with commas between, or dns:///NAME:PORT with a name that stands for all of
  // them: each session takes the next one that serves, and goes on at another when it is lost.
  // Fails when an address or a file is wrong, not when nobody listens: sessions find that out.
  [[nodiscard]] static std::optional<Failure> open(const std::string& address, const TlsFiles& tls,
                                                   std::optional<Connection>& connection,
                                                   const ConnectionOptions& options = {});
  // Through a channel that exists, an in-process one above all.
  explicit Connection(std::shared_ptr<grpc::Channel> channel, const ResumePolicy& resume = {})
      : channel_(std::move(channel)), resume_(resume) {}

  // The connection for sessions of another policy.
  [[nodiscard]] Connection with(const ResumePolicy& resume) const {
    Connection other = *this;
    other.resume_ = resume;
    return other;
  }

  [[nodiscard]] const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  [[nodiscard]] const ResumePolicy& resume_policy() const { return resume_; }

  // Waits until a server is connected. False when nobody is there, and for a channel that was
  // given.
  [[nodiscard]] bool reach() const;

  // Version, limits and tables of the server.
  [[nodiscard]] std::optional<Failure> server_info(std::chrono::milliseconds timeout,
                                                   v1::GetServerInfoResponse& info) const;
  // Whether the server takes new streams.
  [[nodiscard]] std::optional<Failure> health(std::chrono::milliseconds timeout,
                                              bool& serving) const;

 private:
  std::shared_ptr<grpc::Channel> channel_;
  ResumePolicy resume_;
  // The state of an in-process channel cannot be asked for.
  bool can_be_watched_ = false;
};

}  // namespace trc::client
