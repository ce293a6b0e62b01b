#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/http/view/view.h"

namespace trc::server::http {

// The views in use. The one unused for the longest time is dropped when there are too many, and
// each after a while; its page then sends the program again.
class ViewStore {
 public:
  using Clock = std::chrono::steady_clock;

  ViewStore(std::size_t most, std::chrono::seconds lifetime) : most_(most), lifetime_(lifetime) {}

  // A name that cannot be guessed.
  [[nodiscard]] static std::string new_id();
  void add(std::shared_ptr<View> view);
  // Null when there is none of that name (any more).
  [[nodiscard]] std::shared_ptr<View> find(const std::string& id);
  void remove(const std::string& id);
  // Drops the view unused for the longest time, but not `needed`. False when there is none.
  bool give_up_one(const View* needed = nullptr);

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
