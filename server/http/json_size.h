#pragma once

#include <optional>
#include <string_view>

#include "server/config/config.h"
#include "server/rpc/status.h"

namespace trc::server::http {

// Reading JSON takes long where it has many objects or values, however short they are: JSON with
// more of them than a batch can need is refused beforehand.
[[nodiscard]] std::optional<Ending> refuse_size(std::string_view json, const Config& config);

}  // namespace trc::server::http
