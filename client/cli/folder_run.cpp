#include "client/cli/folder_run.h"

#include <fcntl.h>
#include <google/protobuf/util/message_differencer.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <set>

#include "client/cli/files.h"
#include "client/cli/job_record.h"
#include "client/cli/printable.h"
#include "client/cli/program_options.h"
#include "client/cli/progress.h"
#include "client/cli/signals.h"
#include "client/cli/speech.h"
#include "client/cli/workers.h"
#include "core/base/text_width.h"
#include "core/base/version.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

namespace fs = std::filesystem;

enum class Result : std::uint8_t { not_begun, unchanged, done, refused, failed, interrupted };

// A program with its result and its record (D-154).
struct Item {
  std::string file{};
  std::string output{};
  std::string record{};
  Result result = Result::not_begun;
  int code = 0;         // exit code of its compensation
  std::string about{};  // summary of its result
};

std::string text_in(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool read_record(const Item& item, v1::JobRecord& record) {
  const std::string text = text_in(item.record);
  return !text.empty() && record_from(text, record).empty() && fault_of_seal(text, record).empty();
}

std::string about(const v1::PathSummary& path) {
  std::string text = std::to_string(path.blocks_out()) + " blocks";
  if (path.has_certificate()) {
    text += ", clearance ";
    append_fixed(text, path.certificate().clearance(), 4);
    text += " of ";
    append_fixed(text, path.certificate().tool_radius(), 4);
    text += " mm";
  }
  if (path.warnings() > 0) text += ", " + std::to_string(path.warnings()) + " warnings";
  return text;
}

// Number and line of the first error. In a long table a reader looks that up there, not above it.
std::string about_refused(const v1::JobRecord& record) {
  for (const v1::Diagnostic& found : record.diagnostics()) {
    if (found.severity() != v1::Diagnostic::ERROR) continue;
    std::string text = "error " + std::to_string(found.code());
    if (found.line() > 0) text += " at line " + std::to_string(found.line());
    return text;
  }
  return {};
}

// Never true for jsonl: its last line holds the time taken.
bool is_unchanged(const FolderRun& run, Item& item) {
  v1::JobRecord record;
  if (run.format == "jsonl" || !read_record(item, record) || record.outcome() != "DONE")
    return false;
  v1::ProgramSetup setup = run.setup;
  setup.set_file_name(record.setup().file_name());
  const bool unchanged =
      record.output_format() == run.format && record.client_commit() == commit() &&
      record.client_version() == version() && record.server_version() == run.server_version &&
      record.server_commit() == run.server_commit &&
      google::protobuf::util::MessageDifferencer::Equals(setup, record.setup()) &&
      is_content_of(record.input(), item.file) && is_output_of(record, item.output);
  if (unchanged) item.about = about(record.summary().path());
  return unchanged;
}

Result result_of(int code) {
  switch (static_cast<Exit>(code)) {
    case Exit::done:
      return Result::done;
    case Exit::refused:
      return Result::refused;
    default:
      return Result::failed;
  }
}

std::vector<std::string> words_of_worker(const FolderRun& run) {
  std::vector<std::string> words{"compensate", "-", "--output-dir", run.directory, "--worker"};
  words.insert(words.end(), run.arguments.begin(), run.arguments.end());
  return words;
}

// Compensates the programs in order, several at a time.
class Work {
 public:
  Work(const FolderRun& run, std::vector<Item>& items)
      : run_(run),
        items_(items),
        progress_(Progress::Result::elsewhere, {.quiet = run.quiet}, language_of(run.setup)),
        workers_(words_of_worker(run), run.jobs) {}

  // Returns the signal that stopped the work; 0: none.
  int go_through() {
    for (std::size_t next = 0; next < items_.size(); ++next) {
      while (workers_.all_busy()) wait();
      hear();
      if (stopped_by_ != 0 || without_server_) break;
      if (is_unchanged(run_, items_[next]))
        count(items_[next], Result::unchanged);
      else if (!workers_.give(next, items_[next].file))
        fail(items_[next], Exit::limit, "no process can be started for it");
    }
    while (workers_.any_busy()) wait();
    progress_.clear();
    return stopped_by_;
  }

 private:
  void wait() {
    constexpr std::chrono::milliseconds until_the_line_is_new{200};
    for (const Workers::Ended& ended : workers_.wait(until_the_line_is_new, signals_.descriptor()))
      end(ended);
    hear();
    progress_.ended(ended_, items_.size());
  }

  // The first signal asks all processes to end, the next one kills them.
  void hear() {
    const int asked = signals_.take();
    if (asked == 0) return;
    workers_.signal(stopped_by_ == 0 ? SIGTERM : SIGKILL);
    if (stopped_by_ == 0) stopped_by_ = asked;
  }

  void end(const Workers::Ended& ended) {
    Item& item = items_[ended.task];
    if (!ended.told.empty()) {
      progress_.clear();
      std::cerr << ended.told;
    }
    if (ended.signal == 0) {
      item.code = ended.code;
      count(item, result_of(item.code));
      v1::JobRecord record;
      if (item.result == Result::done && read_record(item, record))
        item.about = about(record.summary().path());
      if (item.result == Result::refused && read_record(item, record))
        item.about = about_refused(record);
      // A record that says REFUSED must not lie beside the result of an earlier run.
      std::error_code none;
      if (item.result == Result::refused) fs::remove(item.output, none);
      // This program has waited for the server; each further one would wait as long.
      if (item.code == static_cast<int>(Exit::unreachable)) without_server_ = true;
      return;
    }
    if (stopped_by_ == 0) await_word();
    if (stopped_by_ != 0)
      // The program may have been complete except for its end.
      count(item, is_unchanged(run_, item) ? Result::done : Result::interrupted);
    else
      fail(item, Exit::internal, "the process was ended by signal " + std::to_string(ended.signal));
  }

  // A terminal signals the whole group: a worker may have ended before this process takes its
  // signal.
  void await_word() {
    constexpr int longest = 100;
    pollfd question{.fd = signals_.descriptor(), .events = POLLIN, .revents = 0};
    static_cast<void>(::poll(&question, 1, longest));
    hear();
  }

  void fail(Item& item, Exit exit, const std::string& why) {
    progress_.clear();
    complain(item.file + ": " + why);
    item.code = static_cast<int>(exit);
    count(item, Result::failed);
  }

  void count(Item& item, Result result) {
    item.result = result;
    progress_.ended(++ended_, items_.size());
  }

  const FolderRun& run_;
  std::vector<Item>& items_;
  Signals signals_{};
  Progress progress_;
  Workers workers_;
  std::size_t ended_ = 0;
  int stopped_by_ = 0;
  bool without_server_ = false;
};

const char* text_of(Result result) {
  switch (result) {
    case Result::not_begun:
      return "not begun";
    case Result::unchanged:
      return "unchanged";
    case Result::done:
      return "done";
    case Result::refused:
      return "refused";
    case Result::failed:
      return "failed";
    case Result::interrupted:
      return "interrupted";
  }
  return "";
}

void print_table(const std::vector<Item>& items) {
  std::size_t width = 4;
  for (const Item& item : items) width = std::max(width, width_of(printable(item.file)));
  std::map<std::string, int> counts;
  for (const Item& item : items) {
    const std::string result = told(text_of(item.result));
    ++counts[result];
    const std::string file = printable(item.file);
    std::cout << file << std::string(width + 2 - width_of(file), ' ') << result;
    constexpr std::size_t widest_result = 13;
    if (!item.about.empty())
      std::cout << std::string(widest_result - width_of(result), ' ') << told(item.about);
    std::cout << '\n';
  }
  std::cout << told(std::to_string(items.size()) + " programs");
  for (const auto& [result, count] : counts) std::cout << ", " << count << ' ' << result;
  std::cout << '\n';
}

// Reports it, too.
bool overwrites(const std::string& path, const FilesRead& read) {
  const std::string other = read.named(path);
  if (!other.empty()) complain(path + " would be written over " + other);
  return !other.empty();
}

// Reports on standard error a result or record that would overwrite another one or an input.
bool have_names_of_their_own(const FolderRun& run, const std::vector<Item>& items) {
  FilesRead read = run.read;
  for (const Item& item : items) read.add(item.file, "the program itself");
  std::set<std::string> names;
  for (const Item& item : items) {
    if (!names.insert(item.output).second || !names.insert(item.record).second) {
      complain(fs::path(item.file).filename().string() +
               " is given twice; its results would have one name");
      return false;
    }
    for (const std::string& path : {item.output, item.record})
      if (overwrites(path, read)) return false;
  }
  return true;
}

}  // namespace

Exit compensate_folder(const FolderRun& run) {
  std::error_code fault;
  fs::create_directories(run.directory, fault);
  if (fault) {
    complain("cannot make " + run.directory + ": " + fault.message());
    return Exit::wrong_call;
  }
  std::vector<Item> items;
  for (const std::string& file : run.files)
    items.push_back({.file = file,
                     .output = result_in(run.directory, file),
                     .record = record_in(run.directory, file)});
  if (!have_names_of_their_own(run, items)) return Exit::wrong_call;
  // Opened before the work, because only then does it report write errors of the meantime.
  const int folder = ::open(run.directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int stopped_by = Work(run, items).go_through();
  const bool is_kept = folder >= 0 && are_kept_by_disk(folder);
  if (!is_kept) complain("cannot write " + run.directory + ": " + std::strerror(errno));
  if (folder >= 0) ::close(folder);
  print_table(items);
  if (stopped_by != 0) end_by(stopped_by);
  int worst = is_kept ? 0 : static_cast<int>(Exit::wrong_call);
  for (const Item& item : items) worst = std::max(worst, item.code);
  return static_cast<Exit>(worst);
}

std::string result_in(const std::string& directory, const std::string& file) {
  return (fs::path(directory) / fs::path(file).filename()).string();
}

std::string record_in(const std::string& directory, const std::string& file) {
  return result_in(directory, file) + ".json";
}

Exit work_for_folder(const std::function<Exit(const std::string& file)>& compensate) {
  for (std::string file; Workers::next_task(file);) {
    const Exit exit = compensate(file);
    std::cerr.flush();
    // After a limit or a fault, this process compensates no further program.
    if (exit != Exit::done && exit != Exit::refused) return exit;
    Workers::tell_code(static_cast<int>(exit));
  }
  return Exit::done;
}

}  // namespace trc::cli
