#include "server/config/plain_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "server/net/listener.h"

namespace trc::server {

PlainFile PlainFile::read(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file.valid()) return {.fault = std::strerror(errno)};
  struct stat status {};
  if (fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
    return {.fault = "it is no file"};
  PlainFile result;
  result.content.resize(most_bytes + 1);
  std::size_t size = 0;
  while (size < result.content.size()) {
    const ssize_t more =
        ::read(file.number(), result.content.data() + size, result.content.size() - size);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) return {.fault = std::strerror(errno)};
    if (more == 0) break;
    size += static_cast<std::size_t>(more);
  }
  if (size > most_bytes) return {.fault = "it is larger than 4 MiB"};
  result.content.resize(size);
  return result;
}

std::string PlainFile::fault_of(const std::string& setting, const std::string& path) const {
  return fault.empty() ? fault : setting + ": cannot read '" + path + "': " + fault;
}

}  // namespace trc::server
