#include "server/net/trial_handshake.h"

#include <openssl/err.h>
#include <openssl/obj_mac.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "server/net/pem.h"

namespace trc::server {
namespace {

using Context = std::unique_ptr<SSL_CTX, Free<SSL_CTX_free>>;
using Connection = std::unique_ptr<SSL, Free<SSL_free>>;

// The message "certificate verify failed" of OpenSSL does not name the fault of the certificate.
std::string fault_of_client(const SSL* client, const std::string& otherwise) {
  const auto result = SSL_get_verify_result(client);
  return result == X509_V_OK ? otherwise : X509_verify_cert_error_string(result);
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
  const BioPointer certificates = pem_reader(chain);
  const X509Pointer own(PEM_read_bio_X509(certificates.get(), nullptr, nullptr, nullptr));
  if (own == nullptr || SSL_CTX_use_certificate(&context, own.get()) != 1) return false;
  while (X509Pointer next{PEM_read_bio_X509(certificates.get(), nullptr, nullptr, nullptr)})
    if (SSL_CTX_add1_chain_cert(&context, next.get()) != 1) return false;
  ERR_clear_error();  // the end of the file is one
  const KeyPointer secret = private_key_in(key);
  return secret != nullptr && SSL_CTX_use_PrivateKey(&context, secret.get()) == 1;
}

// Makes the client trust the end of the chain. It checks everything else as any client does: the
// purpose and the strength of the certificates. Dates have messages of their own.
bool trust_end_of(const std::string& chain, SSL_CTX& client) {
  const BioPointer certificates = pem_reader(chain);
  X509Pointer end;
  while (X509Pointer next{PEM_read_bio_X509(certificates.get(), nullptr, nullptr, nullptr)})
    end = std::move(next);
  ERR_clear_error();  // reading past the last certificate sets an error
  X509_STORE* const trusted = SSL_CTX_get_cert_store(&client);
  X509_VERIFY_PARAM_set_flags(SSL_CTX_get0_param(&client),
                              X509_V_FLAG_PARTIAL_CHAIN | X509_V_FLAG_NO_CHECK_TIME);
  SSL_CTX_set_verify(&client, SSL_VERIFY_PEER, nullptr);
  return end != nullptr && X509_STORE_add_cert(trusted, end.get()) == 1;
}

bool waits(const SSL* connection, int result) {
  return result == 1 || SSL_get_error(connection, result) == SSL_ERROR_WANT_READ;
}

// The fewest bits that OpenSSL accepts for keys at the system's level of security.
int least_security_bits() {
  constexpr std::array<int, 6> bits_of_level{0, 80, 112, 128, 192, 256};
  const Context context = context_as_of_grpc();
  const auto level = static_cast<std::size_t>(SSL_CTX_get_security_level(context.get()));
  return bits_of_level.at(std::min(level, bits_of_level.size() - 1));
}

}  // namespace

std::string fault_of_authority(X509& authority) {
  const EVP_PKEY* const key = X509_get0_pubkey(&authority);
  if (key == nullptr) return "has a key that cannot be read";
  if (EVP_PKEY_get_security_bits(key) < least_security_bits())
    return "has a key that is too weak (" + std::to_string(EVP_PKEY_get_bits(key)) + " bits)";
  constexpr int as_authority = 1;
  constexpr int as_client = 0;
  // A client may also present the trusted certificate itself: D-165.
  if (X509_check_purpose(&authority, X509_PURPOSE_SSL_CLIENT, as_authority) == 0 &&
      X509_check_purpose(&authority, X509_PURPOSE_SSL_CLIENT, as_client) == 0)
    return "is not meant to vouch for clients (keyUsage, extendedKeyUsage)";
  return {};
}

std::string fault_of_handshake(const std::string& chain, const std::string& key) {
  ERR_clear_error();
  const Context of_server = context_as_of_grpc();
  const Context of_client = context_as_of_grpc();
  if (!take(*of_server, chain, key)) return last_error();
  if (!trust_end_of(chain, *of_client)) return last_error();
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
    if (!waits(client.get(), asked)) return fault_of_client(client.get(), last_error());
    const int answered = SSL_do_handshake(server.get());
    if (!waits(server.get(), answered)) return last_error();
    if (asked == 1 && answered == 1) return {};
  }
  return "the handshake comes to no end";
}

}  // namespace trc::server
