#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/state.h"
#include "server/config/config.h"
#include "server/rpc/status.h"

namespace google::protobuf {
class Message;
}

namespace trc::server {

// Seals what a stream needs to go on elsewhere, and opens it again.
//
//     format, 5 bytes | build, 32 | setup, 32 | state | HMAC-SHA-256 of all before it, 32
//
// The state is that of the core (core/base/state.h): what it holds back and the modes in force.
// Only a server of the same build can read it, and only one with the same key accepts it; the
// server that gave the token is not needed. The digest of the setup keeps a stream from going on
// under other settings.
class ResumeTokens {
 public:
  // Of a setup message without its token.
  using Digest = std::array<std::uint8_t, 32>;

  ResumeTokens(std::string key, std::size_t most_bytes)
      : key_(std::move(key)), most_bytes_(most_bytes) {}

  [[nodiscard]] static Digest digest_of(const google::protobuf::Message& setup);

  // Empty when the token would be too large: then too much is held back for a token, and the client
  // goes on from an earlier one.
  [[nodiscard]] std::string seal(const Digest& setup,
                                 const std::function<void(StateWriter&)>& save) const;
  // The refusal of a token that cannot be used.
  [[nodiscard]] std::optional<Ending> open(std::string_view token, const Digest& setup,
                                           const std::function<void(StateReader&)>& load) const;

 private:
  std::string key_;
  std::size_t most_bytes_;
};

// The key of the file, which is made with a random one, for the owner only, when there is none; a
// random one without a file. The fault is one sentence.
struct ResumeKey {
  std::string key{};
  std::string fault{};
};
[[nodiscard]] ResumeKey resume_key(const std::string& path);

}  // namespace trc::server
