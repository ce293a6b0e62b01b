#pragma once

#include <openssl/evp.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace trc::server {

// SHA-256 of what is given piece by piece.
class Sha256 {
 public:
  Sha256();

  void add(std::string_view bytes);
  // 64 hexadecimal digits; nothing may be added afterwards.
  [[nodiscard]] std::string digits();

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
  std::uint64_t bytes_ = 0;
};

}  // namespace trc::server
