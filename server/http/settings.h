#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>
#include <string_view>

#include "server/http/exchange.h"
#include "trc/v1/http.pb.h"
#include "trc/v1/setup.pb.h"

namespace trc::server::http {

// The spellings of those that can be read, with commas between.
[[nodiscard]] std::string dialects();

// The setup the query parameters describe: those of `--set`, `dialect`, `unit`,
// `unknown_words`, `whole_numbers`, `decimals` and `name`. The problem
// when one cannot be taken. Where they name no language, it is the one that the header
// Accept-Language prefers.
[[nodiscard]] std::optional<v1::Problem> read_settings(const Pairs& query,
                                                       std::string_view accept_language,
                                                       v1::ProgramSetup& setup);

// Where the setup of a request in JSON or in Connect names no language, it is the one that the
// header Accept-Language prefers, too. A message without a setup stays as it is.
void prefer_language(std::string_view accept_language, google::protobuf::Message& message);

}  // namespace trc::server::http
