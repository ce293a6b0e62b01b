#pragma once

#include "server/config/config.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {

// GetServerInfo: what the server is, its limits and the tables of what it knows.
void describe(const Config& config, v1::GetServerInfoResponse& response);

}  // namespace trc::server
