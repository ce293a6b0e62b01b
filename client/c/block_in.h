#pragma once

#include <string>

#include "client/c/trc.h"
#include "proto/wire/json.h"
#include "trc/v1/block.pb.h"

namespace trc::c {

// Writes a block of the caller into an empty message. Returns its fault as a sentence; empty: there
// is none.
[[nodiscard]] std::string write_block(const trc_block& block, wire::Json& json, v1::Block& message);

}  // namespace trc::c
