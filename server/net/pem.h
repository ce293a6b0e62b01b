#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <memory>
#include <string>

namespace trc::server {

// Owns an object of OpenSSL, which `free` gives back.
template <auto free>
struct Free {
  template <class Object>
  void operator()(Object* object) const {
    free(object);
  }
};
using BioPointer = std::unique_ptr<BIO, Free<BIO_free>>;
using X509Pointer = std::unique_ptr<X509, Free<X509_free>>;
using KeyPointer = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;

// Reads the text of a PEM file, which must outlive what is returned.
[[nodiscard]] inline BioPointer pem_reader(const std::string& pem) {
  return BioPointer(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

// The private key of a PEM file; null: there is none without a pass phrase, which nobody is asked
// for.
[[nodiscard]] inline KeyPointer private_key_in(const std::string& pem) {
  const auto no_pass_phrase = [](char* /*buffer*/, int /*size*/, int /*writing*/, void* /*user*/) {
    return -1;
  };
  return KeyPointer(
      PEM_read_bio_PrivateKey(pem_reader(pem).get(), nullptr, no_pass_phrase, nullptr));
}

}  // namespace trc::server
