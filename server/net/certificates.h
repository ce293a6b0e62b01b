#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace trc::server {

// The PEM files of one moment that belong together.
struct Certificate {
  std::string chain{};
  std::string key{};
  std::string client_authorities{};  // empty: clients need no certificate
  // When all of the chain is good, seconds since 1970.
  std::int64_t begins_s = 0;
  std::int64_t expires_s = 0;
  std::uint64_t version = 0;  // counts what was taken into use
};

// The certificate in use. Files are read again on demand; what cannot be used leaves the old one in
// place, as it would break every new connection: a key that does not fit its certificate, a chain
// that is none, a certificate that has expired.
class Certificates {
 public:
  struct Files {
    std::string chain{};
    std::string key{};
    std::string client_authorities{};
  };
  enum class Reload { unchanged, taken, refused };

  explicit Certificates(Files files) : files_(std::move(files)) {}

  // Reads the files. `fault` says why they were refused.
  Reload reload(std::string& fault);

  // Null before the first successful reload.
  [[nodiscard]] std::shared_ptr<const Certificate> current() const;

 private:
  const Files files_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Certificate> current_;
};

}  // namespace trc::server
