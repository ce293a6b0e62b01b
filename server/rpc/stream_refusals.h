#pragma once

#include <cstddef>
#include <optional>

#include "server/backend.h"
#include "server/rpc/status.h"
#include "server/rpc/stream_work.h"

namespace trc::server {

// Why a client gets no stream now; nothing where it may have one. Its own place has been taken.
[[nodiscard]] std::optional<Ending> refuse_crowd(const Backend& backend, const Peer& peer);
// All places are taken.
[[nodiscard]] Ending refuse_full(const Config& config);
// Of a request of so many bytes.
[[nodiscard]] Ending refuse_too_large(std::size_t bytes, const Config& config);
// Of a stream that waited for its client.
[[nodiscard]] Ending refuse_waiting(Refusal why, const Config& config);

// Takes no memory: short texts lie in the strings themselves.
[[nodiscard]] Turn end_for_want_of_memory() noexcept;

}  // namespace trc::server
