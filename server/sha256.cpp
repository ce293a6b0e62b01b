// A digest of the EVP interface cannot be saved half-way, but a resumed stream needs that.
#define OPENSSL_SUPPRESS_DEPRECATED

#include "server/sha256.h"

#include <openssl/sha.h>

#include <array>
#include <stdexcept>

#include "core/base/archive.h"

namespace trc::server {
namespace {

void check(int result) {
  if (result != 1) throw std::runtime_error("SHA-256 is not available");
}

template <class Archive, class State>
void serialize_state(Archive& archive, State& state) {
  for (auto& word : state.h) archive(word);
  archive(state.Nl, state.Nh);
  for (auto& word : state.data) archive(word);
  archive(state.num, state.md_len);
}

}  // namespace

Sha256::Sha256() : state_(std::make_unique<SHA256_CTX>()) { check(SHA256_Init(state_.get())); }

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  check(SHA256_Update(state_.get(), bytes.data(), bytes.size()));
  bytes_ += bytes.size();
}

std::string Sha256::digits() {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  check(SHA256_Final(digest.data(), state_.get()));
  std::string text;
  constexpr const char* names = "0123456789abcdef";
  for (const unsigned char byte : digest) {
    text += names[byte / 16];
    text += names[byte % 16];
  }
  return text;
}

void Sha256::save(StateWriter& archive) const {
  archive(bytes_);
  serialize_state(archive, *state_);
}

void Sha256::load(StateReader& archive) {
  archive(bytes_);
  serialize_state(archive, *state_);
  // With other values, OpenSSL would read beyond the end of the state.
  if (state_->num >= SHA256_CBLOCK || state_->md_len != SHA256_DIGEST_LENGTH)
    throw std::runtime_error("no state of a SHA-256");
}

}  // namespace trc::server
