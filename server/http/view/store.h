#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/http/view/view.h"

namespace trc::server::http {

// The views somebody looks at. The one that was not asked for longest goes when there are too many,
// and each after a while; its page sends the program again.
class ViewStore {
 public:
  using Clock = std::chrono::steady_clock;

  ViewStore(std::size_t most, std::chrono::seconds lifetime) : most_(most), lifetime_(lifetime) {}

  // A name nobody can guess.
  [[nodiscard]] static std::string new_id();
  void add(std::shared_ptr<View> view);
  // Null when there is none of that name (any more).
  [[nodiscard]] std::shared_ptr<View> find(const std::string& id);
  void remove(const std::string& id);
  // Gives up the one that was not asked for longest. False when there is none.
  bool give_up_one();

 private:
  struct Kept {
    std::shared_ptr<View> view{};
    Clock::time_point asked{};
  };

  void forget_old(Clock::time_point now);

  const std::size_t most_;
  const std::chrono::seconds lifetime_;
  std::mutex mutex_;
  std::map<std::string, Kept> kept_;
};

}  // namespace trc::server::http
