#pragma once

#include <string>

#include "client/c/trc.h"
#include "proto/wire/json.h"
#include "trc/v1/block.pb.h"

namespace trc::c {

// Writes a block of the caller's into an empty message. Returns what is wrong with it, as a
// sentence; empty: nothing.
[[nodiscard]] std::string write_block(const trc_block& block, wire::Json& json, v1::Block& message);

}  // namespace trc::c
