#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trc::cli {

// A file or pipe from its beginning: all of it, or one byte more than `most`, since a device never
// comes to an end. False: it cannot be read.
bool read_bounded(const std::string& path, std::size_t most, std::string& text);

// A program to read: a file, or standard input for "-".
class Input {
 public:
  explicit Input(std::string path);
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  // Reports faults on standard error. False: nothing to read.
  bool open();
  // The next piece; empty at the end. Valid until the next call.
  [[nodiscard]] std::string_view read();
  // Passes every piece to `watcher` too, before it is returned.
  void watch(std::function<void(std::string_view)> watcher) {
    watchers_.push_back(std::move(watcher));
  }
  // In bytes; 0: not known, as of what comes through a pipe.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  // Whether reading broke off before the end.
  [[nodiscard]] bool failed() const { return failed_; }

  // As messages name it.
  [[nodiscard]] const std::string& name() const { return name_; }
  // As it was asked for, "-" too.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  bool failed_ = false;
  std::string buffer_;
  std::vector<std::function<void(std::string_view)>> watchers_;
};

// Whether the disk has stored all that was written to a file, or to others on the same volume. A
// thin volume, a quota or a network accepts more than it has room for, and reports it only now. The
// reason is in errno.
[[nodiscard]] bool is_kept_by_disk(int descriptor);
[[nodiscard]] bool are_kept_by_disk(int descriptor);

// The destination of a result. A file gets its name only with `commit`: until then, and when the
// program ends early, an older file of that name stays as it was. Output to standard output leaves
// at once, or is also held back until then.
class Output {
 public:
  enum class OnScreen { at_once, with_commit };
  // Who checks that the disk has stored a file: `commit`, or the caller for many files at
  // once.
  enum class Disk { asked, asked_by_others };
  // "-" or nothing: standard output.
  explicit Output(std::string path, OnScreen on_screen = OnScreen::at_once,
                  Disk disk = Disk::asked);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  // Each reports faults on standard error, and returns false then.
  bool open();
  bool write(std::string_view text);
  bool commit();

  [[nodiscard]] bool is_standard_output() const { return path_.empty(); }

 private:
  bool complain(const char* what);
  bool flush();
  bool open_held();
  bool release_held();

  std::string path_;
  OnScreen on_screen_;
  Disk disk_;
  std::string temporary_;  // empty: written in place (a device or a pipe)
  int descriptor_ = -1;
  bool failed_ = false;
  std::string buffer_;
};

// Whether both names mean one file.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

}  // namespace trc::cli
