#include "server/net/trial_handshake.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/obj_mac.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>

#include <array>
#include <memory>
#include <string>
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
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using Context = std::unique_ptr<SSL_CTX, Free<SSL_CTX_free>>;
using Connection = std::unique_ptr<SSL, Free<SSL_free>>;

Bio reader_of(const std::string& pem) {
  return Bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

std::string last_error() {
  std::array<char, 256> text{};
  const char* const reason = ERR_reason_error_string(ERR_peek_last_error());
  if (reason == nullptr) ERR_error_string_n(ERR_peek_last_error(), text.data(), text.size());
  ERR_clear_error();
  return reason == nullptr ? std::string(text.data()) : std::string(reason);
}

Context context_as_of_grpc() {
  Context context(SSL_CTX_new(TLS_method()));
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(context.get(),
                          "ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-ECDSA-AES256-GCM-SHA384:"
                          "ECDHE-RSA-AES128-GCM-SHA256:ECDHE-RSA-AES256-GCM-SHA384");
  int curve = NID_X9_62_prime256v1;
  SSL_CTX_set1_groups(context.get(), &curve, 1);
  return context;
}

bool take(SSL_CTX& context, const std::string& chain, const std::string& key) {
  const Bio certificates = reader_of(chain);
  const Certificate own(PEM_read_bio_X509(certificates.get(), nullptr, nullptr, nullptr));
  if (own == nullptr || SSL_CTX_use_certificate(&context, own.get()) != 1) return false;
  while (Certificate next{PEM_read_bio_X509(certificates.get(), nullptr, nullptr, nullptr)})
    if (SSL_CTX_add1_chain_cert(&context, next.get()) != 1) return false;
  ERR_clear_error();  // the end of the file is one
  const Key secret(PEM_read_bio_PrivateKey(reader_of(key).get(), nullptr, nullptr, nullptr));
  return secret != nullptr && SSL_CTX_use_PrivateKey(&context, secret.get()) == 1;
}

bool waits(const SSL* connection, int result) {
  return result == 1 || SSL_get_error(connection, result) == SSL_ERROR_WANT_READ;
}

}  // namespace

std::string fault_of_handshake(const std::string& chain, const std::string& key) {
  ERR_clear_error();
  const Context of_server = context_as_of_grpc();
  const Context of_client = context_as_of_grpc();
  if (!take(*of_server, chain, key)) return last_error();
  SSL_CTX_set_verify(of_client.get(), SSL_VERIFY_NONE, nullptr);
  const Connection server(SSL_new(of_server.get()));
  const Connection client(SSL_new(of_client.get()));
  BIO* at_server = nullptr;
  BIO* at_client = nullptr;
  if (BIO_new_bio_pair(&at_server, 0, &at_client, 0) != 1) return last_error();
  SSL_set_bio(server.get(), at_server, at_server);
  SSL_set_bio(client.get(), at_client, at_client);
  SSL_set_accept_state(server.get());
  SSL_set_connect_state(client.get());
  constexpr int most_rounds = 20;
  for (int round = 0; round < most_rounds; ++round) {
    const int asked = SSL_do_handshake(client.get());
    if (!waits(client.get(), asked)) return last_error();
    const int answered = SSL_do_handshake(server.get());
    if (!waits(server.get(), answered)) return last_error();
    if (asked == 1 && answered == 1) return {};
  }
  return "the handshake comes to no end";
}

}  // namespace trc::server
