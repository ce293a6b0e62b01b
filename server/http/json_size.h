#pragma once

#include <optional>
#include <string_view>

#include "server/config/config.h"
#include "server/rpc/status.h"

namespace trc::server::http {

// Reading JSON takes long where it has many objects or values, however short they are: what has
// more of them than a batch may need is refused before.
[[nodiscard]] std::optional<Ending> refuse_size(std::string_view json, const Config& config);

}  // namespace trc::server::http
