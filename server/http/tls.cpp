#include "server/http/tls.h"

#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <utility>

namespace trc::server::http {
namespace {

namespace ssl = boost::asio::ssl;

int choose_http(SSL* /*connection*/, const unsigned char** chosen, unsigned char* length,
                const unsigned char* offered, unsigned offered_length, void* /*user*/) {
  static constexpr std::array<unsigned char, 9> http{8, 'h', 't', 't', 'p', '/', '1', '.', '1'};
  unsigned char* found = nullptr;
  if (SSL_select_next_proto(&found, length, http.data(), http.size(), offered, offered_length) !=
      OPENSSL_NPN_NEGOTIATED)
    return SSL_TLSEXT_ERR_NOACK;
  *chosen = found;
  return SSL_TLSEXT_ERR_OK;
}

std::shared_ptr<ssl::context> context_of(const Certificate& certificate) {
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  SSL_CTX* native = context->native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  SSL_CTX_set_alpn_select_cb(native, choose_http, nullptr);
  context->use_certificate_chain(boost::asio::buffer(certificate.chain));
  context->use_private_key(boost::asio::buffer(certificate.key), ssl::context::pem);
  if (!certificate.client_authorities.empty()) {
    context->add_certificate_authority(boost::asio::buffer(certificate.client_authorities));
    context->set_verify_mode(ssl::verify_peer | ssl::verify_fail_if_no_peer_cert);
    // Every certificate in the file is trusted for itself, as gRPC does: D-165.
    X509_VERIFY_PARAM_set_flags(SSL_CTX_get0_param(native), X509_V_FLAG_PARTIAL_CHAIN);
  }
  return context;
}

std::string common_name(X509* certificate) {
  std::array<char, 256> name{};
  const int length = X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName,
                                               name.data(), static_cast<int>(name.size()));
  return length > 0 ? std::string(name.data(), static_cast<std::size_t>(length)) : std::string();
}

bool is_uri(const std::string& name) { return name.find("://") != std::string::npos; }

std::vector<std::string> alternative_names(X509* certificate) {
  std::vector<std::string> result;
  auto* names = static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr));
  if (names == nullptr) return result;
  for (int i = 0; i < sk_GENERAL_NAME_num(names); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names, i);
    if (name->type != GEN_DNS && name->type != GEN_URI && name->type != GEN_EMAIL) continue;
    const ASN1_IA5STRING* text = name->d.ia5;
    std::string read(reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
                     static_cast<std::size_t>(ASN1_STRING_length(text)));
    // A URI that reads like a host name is not a host name.
    if (is_uri(read) == (name->type == GEN_URI)) result.push_back(std::move(read));
  }
  GENERAL_NAMES_free(names);
  return result;
}

}  // namespace

std::shared_ptr<ssl::context> Tls::context() {
  const auto certificate = certificates_->current();
  const std::lock_guard lock(mutex_);
  if (context_ != nullptr && certificate->version == version_) return context_;
  try {
    context_ = context_of(*certificate);
    version_ = certificate->version;
  } catch (const boost::system::system_error&) {
    // Loading has checked that the files belong together; the fault is in a further certificate of
    // the chain. The previous context stays in use.
  }
  return context_;
}

bool is_allowed(SSL* connection, const std::vector<std::string>& names) {
  if (names.empty()) return true;
  X509* certificate = SSL_get1_peer_certificate(connection);
  if (certificate == nullptr) return false;
  std::vector<std::string> own = alternative_names(certificate);
  if (std::string name = common_name(certificate); !is_uri(name)) own.push_back(std::move(name));
  X509_free(certificate);
  return std::any_of(own.begin(), own.end(), [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

}  // namespace trc::server::http
