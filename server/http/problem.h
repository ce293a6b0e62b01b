#pragma once

#include <grpcpp/support/status.h>

#include <string>
#include <string_view>

#include "server/http/exchange.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// The problem behind the status of an RPC: reason and fields come from its details. A program that
// is refused is 422, a request that cannot be taken 400.
[[nodiscard]] v1::Problem problem_of(const grpc::Status& status);

// The most fields at fault in one problem.
inline constexpr int most_fields = 20;

// A problem that only HTTP has.
[[nodiscard]] v1::Problem problem(unsigned status, std::string_view reason, std::string_view title,
                                  std::string_view detail);

// Answers with it, as application/problem+json, in the language that Accept-Language prefers.
void answer_problem(Exchange& exchange, v1::Problem problem, const Pairs& headers = {});

}  // namespace trc::server::http
