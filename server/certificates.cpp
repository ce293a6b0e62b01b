#include "server/certificates.h"

#include <openssl/bio.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <utility>

namespace trc::server {
namespace {

template <auto free>
struct Free {
  template <class Object>
  void operator()(Object* object) const {
    free(object);
  }
};
using Bio = std::unique_ptr<BIO, Free<BIO_free>>;
using X509Pointer = std::unique_ptr<X509, Free<X509_free>>;
using KeyPointer = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;

// Empty when it cannot be read.
std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Bio reader_of(const std::string& pem) {
  return Bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

X509Pointer first_certificate(const std::string& pem) {
  return X509Pointer(PEM_read_bio_X509(reader_of(pem).get(), nullptr, nullptr, nullptr));
}

// Nobody is asked for a pass phrase.
int no_pass_phrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*user*/) { return -1; }

std::int64_t seconds_of(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? static_cast<std::int64_t>(timegm(&parts)) : 0;
}

std::string fault_of(const Certificates::Files& files, Certificate& read) {
  const X509Pointer first = first_certificate(read.chain);
  if (first == nullptr) return "tls-cert-file: '" + files.chain + "' holds no certificate";
  const KeyPointer key(
      PEM_read_bio_PrivateKey(reader_of(read.key).get(), nullptr, no_pass_phrase, nullptr));
  if (key == nullptr) return "tls-key-file: '" + files.key + "' holds no key without pass phrase";
  if (X509_check_private_key(first.get(), key.get()) != 1)
    return "tls-key-file: '" + files.key + "' does not belong to '" + files.chain + "'";
  if (!files.client_authorities.empty() && first_certificate(read.client_authorities) == nullptr)
    return "tls-client-ca-file: '" + files.client_authorities + "' holds no certificate";
  read.expires_s = seconds_of(X509_get0_notAfter(first.get()));
  return {};
}

}  // namespace

Certificates::Reload Certificates::reload(std::string& fault) {
  Certificate read{.chain = content_of(files_.chain), .key = content_of(files_.key)};
  if (!files_.client_authorities.empty())
    read.client_authorities = content_of(files_.client_authorities);

  const auto before = current();
  if (before != nullptr && before->chain == read.chain && before->key == read.key &&
      before->client_authorities == read.client_authorities)
    return Reload::unchanged;
  fault = fault_of(files_, read);
  if (!fault.empty()) return Reload::refused;
  read.version = before == nullptr ? 1 : before->version + 1;
  const std::lock_guard lock(mutex_);
  current_ = std::make_shared<const Certificate>(std::move(read));
  return Reload::taken;
}

std::shared_ptr<const Certificate> Certificates::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

}  // namespace trc::server
