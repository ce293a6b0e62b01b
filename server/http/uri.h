#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/http/exchange.h"

namespace trc::server::http {

// The path and the query of a request target, decoded; empty when the target is not an absolute
// path, or an escape in it is not a byte, or the path has a control character.
struct Target {
  std::string path{};
  Pairs query{};
};
[[nodiscard]] std::optional<Target> read_target(std::string_view target);

}  // namespace trc::server::http
