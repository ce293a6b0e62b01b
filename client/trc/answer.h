#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/trc/result/compensated_block.h"
#include "proto/wire/diagnostic.h"

namespace trc::client {

// What has become certain since the last answer: text or blocks, as the setup
// asks, and behind it the diagnostics.
struct Answer {
  std::string text{};
  std::vector<CompensatedBlock> blocks{};
  std::vector<wire::ReceivedDiagnostic> diagnostics{};
};

// Gets the answers in order, on the caller's thread, while `feed` and `finish`
// wait for the server. False: no more is wanted, the stream is cancelled.
using AnswerSink = std::function<bool(const Answer&)>;

}  // namespace trc::client
