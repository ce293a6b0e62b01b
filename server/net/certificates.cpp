#include "server/net/certificates.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ctime>
#include <limits>
#include <utility>
#include <vector>

#include "server/config/plain_file.h"
#include "server/net/pem.h"
#include "server/net/trial_handshake.h"

namespace trc::server {
namespace {

// All certificates of a file, in order; a block that is no certificate is a fault.
struct Chain {
  std::vector<X509Pointer> certificates{};
  std::string fault{};
};

Chain certificates_in(const std::string& setting, const std::string& path, const std::string& pem) {
  Chain chain;
  const BioPointer reader = pem_reader(pem);
  ERR_clear_error();
  while (X509Pointer one{PEM_read_bio_X509(reader.get(), nullptr, nullptr, nullptr)})
    chain.certificates.push_back(std::move(one));
  const bool at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  ERR_clear_error();
  const std::string file = setting + ": '" + path + "' ";
  if (!at_end)
    chain.fault = file + "holds a block that is no certificate, number " +
                  std::to_string(chain.certificates.size() + 1);
  else if (chain.certificates.empty())
    chain.fault = file + "holds no certificate";
  return chain;
}

// Checks that each certificate is signed by the next one, because clients follow this order.
std::string fault_of_order(const std::string& path, const Chain& chain) {
  for (std::size_t i = 0; i + 1 < chain.certificates.size(); ++i) {
    X509* const authority = chain.certificates[i + 1].get();
    X509* const one = chain.certificates[i].get();
    if (X509_check_issued(authority, one) != X509_V_OK ||
        X509_verify(one, X509_get0_pubkey(authority)) != 1) {
      ERR_clear_error();
      return "tls-cert-file: certificate " + std::to_string(i + 2) + " of '" + path +
             "' has not signed the one before it";
    }
  }
  return {};
}

std::int64_t seconds_of(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? static_cast<std::int64_t>(timegm(&parts)) : 0;
}

// The time in which the whole chain is valid.
void read_dates(const Chain& chain, Certificate& read) {
  read.begins_s = std::numeric_limits<std::int64_t>::min();
  read.expires_s = std::numeric_limits<std::int64_t>::max();
  for (const X509Pointer& one : chain.certificates) {
    read.begins_s = std::max(read.begins_s, seconds_of(X509_get0_notBefore(one.get())));
    read.expires_s = std::min(read.expires_s, seconds_of(X509_get0_notAfter(one.get())));
  }
}

// One of two overlapping authorities may have expired: each client is checked against the dates of
// its own authority.
std::string fault_of_authorities(const Certificates::Files& files, const Certificate& read) {
  const Chain chain =
      certificates_in("tls-client-ca-file", files.client_authorities, read.client_authorities);
  if (!chain.fault.empty()) return chain.fault;
  for (std::size_t i = 0; i < chain.certificates.size(); ++i)
    if (const std::string fault = fault_of_authority(*chain.certificates[i]); !fault.empty())
      return "tls-client-ca-file: certificate " + std::to_string(i + 1) + " of '" +
             files.client_authorities + "' " + fault + ": no client of it could connect";
  const std::int64_t now_s = std::time(nullptr);
  const auto has_expired = [&](const X509Pointer& one) {
    return seconds_of(X509_get0_notAfter(one.get())) <= now_s;
  };
  if (!std::all_of(chain.certificates.begin(), chain.certificates.end(), has_expired)) return {};
  return "tls-client-ca-file: all authorities in '" + files.client_authorities + "' have expired";
}

std::string fault_of(const Certificates::Files& files, Certificate& read) {
  const Chain chain = certificates_in("tls-cert-file", files.chain, read.chain);
  if (!chain.fault.empty()) return chain.fault;
  const KeyPointer key = private_key_in(read.key);
  if (key == nullptr) return "tls-key-file: '" + files.key + "' holds no key without pass phrase";
  if (X509_check_private_key(chain.certificates.front().get(), key.get()) != 1)
    return "tls-key-file: '" + files.key + "' does not belong to '" + files.chain + "'";
  std::string fault = fault_of_order(files.chain, chain);
  if (!fault.empty()) return fault;
  fault = fault_of_handshake(read.chain, read.key);
  if (!fault.empty())
    return "tls-cert-file: with '" + files.chain +
           "' and its key no client could connect: " + fault;
  read_dates(chain, read);
  return files.client_authorities.empty() ? std::string() : fault_of_authorities(files, read);
}

std::string day_of(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm parts{};
  std::array<char, 32> text{};
  if (gmtime_r(&time, &parts) != nullptr)
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

// An expired certificate is refused. One that is not valid yet never replaces a good one; without a
// good one it is taken: the clock of the machine may be set later.
std::string fault_of_dates(const Certificates::Files& files, const Certificate& read,
                           const Certificate* before, std::int64_t now_s) {
  const std::string which = "tls-cert-file: '" + files.chain + "' ";
  if (read.expires_s <= now_s) return which + "has expired on " + day_of(read.expires_s);
  const bool before_is_good =
      before != nullptr && before->begins_s <= now_s && now_s < before->expires_s;
  if (read.begins_s > now_s && before_is_good)
    return which + "is not good before " + day_of(read.begins_s);
  return {};
}

// Reads the files; returns the fault of the first one that cannot be read.
std::string read_files(const Certificates::Files& files, Certificate& read) {
  std::string fault;
  const auto take = [&](const char* setting, const std::string& path, std::string& content) {
    PlainFile file = PlainFile::read(path);
    if (fault.empty()) fault = file.fault_of(setting, path);
    content = std::move(file.content);
  };
  take("tls-cert-file", files.chain, read.chain);
  take("tls-key-file", files.key, read.key);
  if (!files.client_authorities.empty())
    take("tls-client-ca-file", files.client_authorities, read.client_authorities);
  return fault;
}

}  // namespace

Certificates::Reload Certificates::reload(std::string& fault) {
  Certificate read;
  fault = read_files(files_, read);
  if (!fault.empty()) return Reload::refused;
  const auto before = current();
  if (before != nullptr && before->chain == read.chain && before->key == read.key &&
      before->client_authorities == read.client_authorities)
    return Reload::unchanged;
  fault = fault_of(files_, read);
  if (fault.empty()) fault = fault_of_dates(files_, read, before.get(), std::time(nullptr));
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
