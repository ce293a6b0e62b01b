#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/http/exchange.h"

namespace trc::server::http {

// A request target, decoded.
struct Target {
  std::string path{};  // "*": the server itself, of OPTIONS alone
  Pairs query{};
  // Of an absolute target, in lower case, and its host with the port; empty of another.
  std::string scheme{};
  std::string host{};
};
// Whether a text is host and port, such as [::1]:8080. A user name is not allowed in a request.
[[nodiscard]] bool is_authority(std::string_view text);

// None when the target is neither an absolute path nor an absolute URI (RFC 9112, 3.2), or an
// escape in it is not a byte, or the path has a control character, or there is a fragment, which
// clients never send.
[[nodiscard]] std::optional<Target> read_target(std::string_view method, std::string_view target);

}  // namespace trc::server::http
