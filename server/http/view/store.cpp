#include "server/http/view/store.h"

#include <openssl/rand.h>

#include <array>
#include <utility>

#include "core/base/check.h"

namespace trc::server::http {

std::string ViewStore::new_id() {
  std::array<unsigned char, 16> bytes{};
  check(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) == 1, "there are random bytes");
  constexpr std::string_view digits = "0123456789abcdef";
  std::string id;
  for (const unsigned char byte : bytes) {
    id += digits[byte >> 4U];
    id += digits[byte & 15U];
  }
  return id;
}

void ViewStore::add(std::shared_ptr<View> view) {
  std::string id = view->said().id();
  const auto now = Clock::now();
  {
    const std::lock_guard lock(mutex_);
    forget_old(now);
    if (kept_.size() < most_) {
      kept_.insert_or_assign(std::move(id), Kept{.view = std::move(view), .asked = now});
      return;
    }
  }
  give_up_one();
  const std::lock_guard lock(mutex_);
  kept_.insert_or_assign(std::move(id), Kept{.view = std::move(view), .asked = now});
}

std::shared_ptr<View> ViewStore::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  forget_old(now);
  const auto found = kept_.find(id);
  if (found == kept_.end()) return nullptr;
  found->second.asked = now;
  return found->second.view;
}

void ViewStore::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(id);
  if (found == kept_.end()) return;
  found->second.view->give_up();
  kept_.erase(found);
}

bool ViewStore::give_up_one(const View* needed) {
  // Freeing a large view takes time, so it happens after the lock is released.
  std::shared_ptr<View> given_up;
  const std::lock_guard lock(mutex_);
  auto oldest = kept_.end();
  for (auto entry = kept_.begin(); entry != kept_.end(); ++entry) {
    const Kept& kept = entry->second;
    const bool is_older = oldest == kept_.end() || kept.asked < oldest->second.asked;
    if (kept.view.get() != needed && is_older) oldest = entry;
  }
  if (oldest == kept_.end()) return false;
  given_up = std::move(oldest->second.view);
  given_up->give_up();
  kept_.erase(oldest);
  return true;
}

void ViewStore::forget_old(Clock::time_point now) {
  std::erase_if(kept_, [&](const auto& entry) {
    const bool is_old = now - entry.second.asked > lifetime_;
    if (is_old) entry.second.view->give_up();
    return is_old;
  });
}

}  // namespace trc::server::http
