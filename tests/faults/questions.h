#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>

namespace trc::faults {

// A channel with a connection of its own.
[[nodiscard]] std::shared_ptr<grpc::Channel> channel_to(const std::string& address);
// Whether the server serves somebody else now.
[[nodiscard]] bool serves(const std::string& address);
// A metric of the server, or -1.
[[nodiscard]] double metric(const std::string& admin, const std::string& name);

}  // namespace trc::faults
