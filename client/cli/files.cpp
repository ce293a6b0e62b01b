#include "client/cli/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <utility>

#include "client/cli/file_name.h"
#include "client/cli/speech.h"

namespace trc::cli {
namespace {

constexpr std::size_t piece = 64U * 1024U;

// Name of the unfinished file of this process, for the signal handler.
std::array<char, 4096> unfinished{};

extern "C" void remove_unfinished(int signal_number) {
  if (unfinished[0] != '\0') unlink(unfinished.data());
  ::signal(signal_number, SIG_DFL);
  ::raise(signal_number);
}

void guard_unfinished(const std::string& path) {
  unfinished[0] = '\0';
  if (path.size() >= unfinished.size()) return;
  std::memcpy(unfinished.data() + 1, path.c_str() + 1, path.size());
  unfinished[0] = path[0];
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction former {};
    ::sigaction(number, nullptr, &former);
    // A signal that is ignored, as under nohup, stays ignored.
    if (former.sa_handler != SIG_IGN) ::signal(number, remove_unfinished);
  }
}

// Makes a file `path`.XXXXXX. The handler knows its name before it exists, so a signal leaves no
// file behind. Below 0: the file cannot be made.
int make_unfinished(const std::string& path, std::string& made) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  constexpr int most_tries = 100;
  constexpr int added = 6;
  std::random_device random;
  std::uniform_int_distribution<std::size_t> any(0, letters.size() - 1);
  for (int tried = 0; tried < most_tries; ++tried) {
    made = path + '.';
    for (int i = 0; i < added; ++i) made += letters[any(random)];
    struct stat existing {};
    // The file exists already, so it is somebody else's and must not be removed.
    if (::lstat(made.c_str(), &existing) == 0) continue;
    guard_unfinished(made);
    const int descriptor = ::open(made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor >= 0) return descriptor;
    unfinished[0] = '\0';
    if (errno != EEXIST) return -1;
  }
  return -1;
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

mode_t mode_of_new_files() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

// A descriptor that is no file has nothing to keep.
bool is_asked_in_vain() { return errno == EINVAL || errno == EROFS || errno == ENOTSUP; }

}  // namespace

bool is_kept_by_disk(int descriptor) {
  while (::fsync(descriptor) != 0)
    if (errno != EINTR) return is_asked_in_vain();
  return true;
}

bool are_kept_by_disk(int descriptor) { return ::syncfs(descriptor) == 0; }

bool read_bounded(const std::string& path, std::size_t most, std::string& text) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return false;
  text.resize(most + 1);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return !stream.bad();
}

Input::Input(std::string path)
    : path_(std::move(path)),
      name_(path_ == "-" ? "<stdin>" : text_of_name(path_)),
      buffer_(piece, '\0') {}

Input::~Input() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

bool Input::open() {
  descriptor_ = path_ == "-" ? STDIN_FILENO : ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat about {};
  if (descriptor_ >= 0) {
    if (::fstat(descriptor_, &about) == 0 && S_ISREG(about.st_mode))
      size_ = static_cast<std::uint64_t>(about.st_size);
    return true;
  }
  complain("cannot read " + name_ + ": " + std::strerror(errno));
  return false;
}

std::string_view Input::read() {
  for (;;) {
    const ssize_t count = ::read(descriptor_, buffer_.data(), buffer_.size());
    if (count >= 0) {
      const auto piece_read = std::string_view(buffer_).substr(0, static_cast<std::size_t>(count));
      for (const auto& watcher : watchers_) watcher(piece_read);
      return piece_read;
    }
    if (errno == EINTR) continue;
    complain("cannot read " + name_ + ": " + std::strerror(errno));
    failed_ = true;
    return {};
  }
}

Output::Output(std::string path, OnScreen on_screen, Disk disk)
    : path_(path == "-" ? std::string() : std::move(path)), on_screen_(on_screen), disk_(disk) {}

Output::~Output() {
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    unfinished[0] = '\0';
  }
}

bool Output::complain(const char* what) {
  const int reason = errno;
  // The reader of the output has gone, so nobody needs a message.
  if (!(is_standard_output() && reason == EPIPE))
    cli::complain(std::string("cannot ") + what + ' ' +
                  (is_standard_output() ? std::string("standard output") : path_) + ": " +
                  std::strerror(reason));
  failed_ = true;
  return false;
}

bool Output::open() {
  // A reader that goes away is an error to report, not a reason to end the process.
  ::signal(SIGPIPE, SIG_IGN);
  if (is_standard_output()) {
    if (on_screen_ == OnScreen::with_commit) return open_held();
    descriptor_ = STDOUT_FILENO;
    return true;
  }
  struct stat existing {};
  const bool exists = ::stat(path_.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) {
    errno = EISDIR;
    return complain("write");
  }
  if (exists && !S_ISREG(existing.st_mode)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    return descriptor_ >= 0 || complain("write");
  }
  std::string made;
  descriptor_ = make_unfinished(path_, made);
  if (descriptor_ < 0) return complain("write");
  temporary_ = made;
  return ::fchmod(descriptor_, exists ? existing.st_mode & 07777 : mode_of_new_files()) == 0 ||
         complain("write");
}

// Held in an unlinked file, because the program may be larger than memory.
bool Output::open_held() {
  std::string pattern = (std::filesystem::temp_directory_path() / "trc.XXXXXX").string();
  descriptor_ = ::mkstemp(pattern.data());
  if (descriptor_ < 0) return complain("hold back");
  ::unlink(pattern.c_str());
  return true;
}

bool Output::release_held() {
  if (::lseek(descriptor_, 0, SEEK_SET) < 0) return complain("write");
  std::string text(piece, '\0');
  for (;;) {
    const ssize_t count = ::read(descriptor_, text.data(), text.size());
    if (count == 0) return is_kept_by_disk(STDOUT_FILENO) || complain("write");
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 || !write_all(STDOUT_FILENO, {text.data(), static_cast<std::size_t>(count)}))
      return complain("write");
  }
}

bool Output::flush() {
  if (!write_all(descriptor_, buffer_)) return complain("write");
  buffer_.clear();
  return true;
}

bool Output::write(std::string_view text) {
  if (failed_) return false;
  buffer_ += text;
  return buffer_.size() < piece || flush();
}

bool Output::commit() {
  if (failed_ || !flush()) return false;
  if (is_standard_output() && on_screen_ == OnScreen::with_commit) return release_held();
  if (temporary_.empty()) return true;
  if (disk_ == Disk::asked && !is_kept_by_disk(descriptor_)) return complain("write");
  if (::close(std::exchange(descriptor_, -1)) != 0) return complain("write");
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return complain("write");
  temporary_.clear();
  unfinished[0] = '\0';
  return true;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return std::filesystem::equivalent(a, b, none);
}

}  // namespace trc::cli
