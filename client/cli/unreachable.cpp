#include "client/cli/unreachable.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <array>
#include <optional>
#include <string_view>

#include "client/cli/files.h"
#include "server/net/pem.h"

namespace trc::cli {
namespace {

using server::BioPointer;
using server::KeyPointer;
using server::X509Pointer;

constexpr std::size_t most_bytes = std::size_t{4} << 20U;

// Nothing for no file, and for a file that cannot be read.
std::optional<std::string> text_of(const std::string& path) {
  std::string pem;
  if (path.empty() || !read_bounded(path, most_bytes, pem)) return std::nullopt;
  return pem;
}

// Reads the first certificate of a file; returns its fault.
std::string read_certificate(const std::string& option, const std::string& path,
                             X509Pointer& read) {
  const auto pem = text_of(path);
  if (!pem) return {};
  read.reset(PEM_read_bio_X509(server::pem_reader(*pem).get(), nullptr, nullptr, nullptr));
  ERR_clear_error();
  return read == nullptr ? option + ": '" + path + "' holds no certificate" : std::string();
}

}  // namespace

std::string fault_of_tls_files(const ServiceOptions& options) {
  X509Pointer authority;
  if (std::string fault = read_certificate("--tls-ca", options.tls_ca, authority); !fault.empty())
    return fault;
  X509Pointer own;
  if (std::string fault = read_certificate("--tls-cert", options.tls_cert, own); !fault.empty())
    return fault;
  const auto pem = text_of(options.tls_key);
  if (!pem) return {};
  const KeyPointer key = server::private_key_in(*pem);
  const bool fits =
      key != nullptr && own != nullptr && X509_check_private_key(own.get(), key.get()) == 1;
  ERR_clear_error();
  if (key == nullptr)
    return "--tls-key: '" + options.tls_key + "' holds no key without pass phrase";
  if (own != nullptr && !fits)
    return "--tls-key: '" + options.tls_key + "' does not belong to '" + options.tls_cert + "'";
  return {};
}

std::string why_unreachable(const std::string& message) {
  struct Reason {
    std::string_view said;  // message of gRPC 1.51
    std::string_view meant;
  };
  static constexpr std::array reasons{
      Reason{"certificate verify failed", ": its certificate is not one that --tls-ca vouches for"},
      Reason{"Hostname Verification", ": its certificate is for another name"},
      Reason{"DNS resolution failed", ": nobody knows that name"},
      Reason{"Connection refused", ": nothing listens there; is trcd running?"},
      Reason{"Socket closed",
             ": what listens there closes the connection: with --tls-ca it may speak without TLS, "
             "without --tls-ca with TLS, and without --tls-cert it may ask for one"}};
  for (const Reason& reason : reasons)
    if (message.find(reason.said) != std::string::npos) return std::string(reason.meant);
  return "; is trcd running there, and do the --tls files fit?";
}

}  // namespace trc::cli
