#pragma once

#include <optional>

#include "server/http/api.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// What is wrong with the query of a route: a parameter that comes twice, one that the route does
// not take, or one with a value it cannot have. Settings are read by read_settings.
[[nodiscard]] std::optional<v1::Problem> refuse_query(const Route& route, const Pairs& query);

}  // namespace trc::server::http
