#include "server/rpc/run_taps.h"

#include <grpcpp/grpcpp.h>

#include <utility>

namespace trc::server {

void RunTaps::add(std::string name, std::weak_ptr<RunTap> tap) {
  const std::lock_guard lock(mutex_);
  // Expired taps belong to calls that never came.
  std::erase_if(waiting_, [](const auto& entry) { return entry.second.expired(); });
  waiting_.insert_or_assign(std::move(name), std::move(tap));
}

std::shared_ptr<RunTap> RunTaps::take(const grpc::CallbackServerContext& context) {
  const auto named = context.client_metadata().find(metadata);
  if (named == context.client_metadata().end()) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto found = waiting_.find(std::string(named->second.data(), named->second.size()));
  if (found == waiting_.end()) return nullptr;
  std::shared_ptr<RunTap> tap = found->second.lock();
  waiting_.erase(found);
  return tap;
}

}  // namespace trc::server
