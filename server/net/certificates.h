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
  // The time in which the whole chain is valid, seconds since 1970.
  std::int64_t begins_s = 0;
  std::int64_t expires_s = 0;
  std::uint64_t version = 0;  // counts what was taken into use
};

// The certificate in use. Files are read again on demand. Files that cannot be used leave the old
// certificate in place, since they would break every new connection: a key that does not match its
// certificate, an invalid chain, an expired certificate.
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
