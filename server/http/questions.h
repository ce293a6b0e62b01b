#pragma once

#include <optional>

#include "server/http/api.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// The fault in the query of a route: a repeated parameter, one that the route does not take, or one
// with an invalid value. Settings are read by read_settings.
[[nodiscard]] std::optional<v1::Problem> refuse_query(const Route& route, const Pairs& query);

}  // namespace trc::server::http
