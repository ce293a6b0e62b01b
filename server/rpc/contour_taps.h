#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "core/nc/state/block.h"

namespace grpc {
class CallbackServerContext;
}

namespace trc::server {

// Looks at the programmed contour while a stream compensates it, so that nobody needs to read the
// same text a second time. Called in the threads of that stream, one call at a time.
class ContourTap {
 public:
  virtual ~ContourTap() = default;
  virtual void take(std::span<const Block> blocks) = 0;
};

// The taps of this process that wait for their stream. A call names its tap in its metadata; names
// must be ones that nobody can guess: what comes over the network has none.
class ContourTaps {
 public:
  // The key of the metadata.
  static constexpr const char* metadata = "trc-contour-tap";

  void add(std::string name, std::weak_ptr<ContourTap> tap);
  // That of a call, which has it from then on; null: it has none.
  [[nodiscard]] std::shared_ptr<ContourTap> take(const grpc::CallbackServerContext& context);

 private:
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<ContourTap>> waiting_;
};

}  // namespace trc::server
