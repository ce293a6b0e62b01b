#include "server/sha256.h"

#include <array>
#include <stdexcept>

namespace trc::server {
namespace {

void check(int result) {
  if (result != 1) throw std::runtime_error("SHA-256 is not available");
}

}  // namespace

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  check(context_ ? EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) : 0);
}

void Sha256::add(std::string_view bytes) {
  check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
  bytes_ += bytes.size();
}

std::string Sha256::digits() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  check(EVP_DigestFinal_ex(context_.get(), digest.data(), &size));
  std::string text;
  constexpr const char* names = "0123456789abcdef";
  for (unsigned int i = 0; i < size; ++i) {
    text += names[digest[i] / 16];
    text += names[digest[i] % 16];
  }
  return text;
}

}  // namespace trc::server
