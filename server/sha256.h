#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/state.h"

struct SHA256state_st;

namespace trc::server {

// SHA-256 of data given piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  // 64 hexadecimal digits; nothing may be added afterwards.
  [[nodiscard]] std::string digits();

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  // Saves its state to go on elsewhere; the archive is as private as the data given.
  void save(StateWriter& archive) const;
  void load(StateReader& archive);

 private:
  std::unique_ptr<SHA256state_st> state_;
  std::uint64_t bytes_ = 0;
};

}  // namespace trc::server
