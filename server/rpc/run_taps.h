#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/nc/state/block.h"
#include "core/trc/result/compensated_block.h"

namespace grpc {
class CallbackServerContext;
}

namespace trc::server {

// Gets the results of a program directly from the stream that compensates it, within one process:
// the contour as it is read, and the path in place of messages, which would be read back at once.
// Called in the threads of that stream, one call at a time, and not after the stream has ended.
class RunTap {
 public:
  virtual ~RunTap() = default;
  // Called before take_path() with the blocks made from this contour.
  virtual void take_contour(std::span<const Block> blocks) = 0;
  // May keep the blocks, and leaves others or none in their place.
  virtual void take_path(std::vector<CompensatedBlock>& blocks) = 0;
};

// The taps of this process that wait for their stream. A call names its tap in its metadata; names
// must be ones that nobody can guess: what comes over the network has none.
class RunTaps {
 public:
  // The key of the metadata.
  static constexpr const char* metadata = "trc-run-tap";

  void add(std::string name, std::weak_ptr<RunTap> tap);
  // The tap of a call, which owns it from then on; null: it has none.
  [[nodiscard]] std::shared_ptr<RunTap> take(const grpc::CallbackServerContext& context);

 private:
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<RunTap>> waiting_;
};

}  // namespace trc::server
