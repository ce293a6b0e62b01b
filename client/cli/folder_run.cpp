#include "client/cli/folder_run.h"

#include <fcntl.h>
#include <google/protobuf/util/message_differencer.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "client/cli/job_record.h"
#include "client/cli/program_options.h"
#include "client/cli/progress.h"
#include "client/cli/signals.h"
#include "core/base/version.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

enum class Result : std::uint8_t { not_begun, unchanged, done, refused, failed, interrupted };

// A program, its result and its record.
struct Item {
  std::string file{};
  std::string output{};
  std::string record{};
  Result result = Result::not_begun;
  int code = 0;        // of its process
  FilePointer told{};  // what the process says, while it runs
};

std::string text_in(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool read_record(const Item& item, v1::JobRecord& record) {
  const std::string text = text_in(item.record);
  return !text.empty() && record_from(text, record).empty() && fault_of_seal(text, record).empty();
}

// Never with jsonl, whose last line tells how long it took.
bool is_unchanged(const FolderRun& run, const Item& item) {
  v1::JobRecord record;
  if (run.format == "jsonl" || !read_record(item, record) || record.outcome() != "DONE")
    return false;
  v1::ProgramSetup setup = run.setup;
  setup.set_file_name(record.setup().file_name());
  return record.output_format() == run.format && record.client_commit() == commit() &&
         record.client_version() == version() && record.server_version() == run.server_version &&
         record.server_commit() == run.server_commit &&
         google::protobuf::util::MessageDifferencer::Equals(setup, record.setup()) &&
         is_content_of(record.input(), item.file) && is_output_of(record, item.output);
}

// Starts the process. 0: it cannot be started.
pid_t start(const FolderRun& run, Item& item) {
  std::vector<std::string> words{"trc",       "compensate", item.file,  "-o",
                                 item.output, "--record",   item.record};
  words.insert(words.end(), run.arguments.begin(), run.arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  item.told.reset(std::tmpfile());
  if (!item.told) return 0;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(item.told.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(item.told.get()), STDERR_FILENO);
  pid_t process = 0;
  const int fault =
      posix_spawn(&process, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return fault == 0 ? process : 0;
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

void print_told(Item& item) {
  std::rewind(item.told.get());
  std::array<char, 4096> piece{};
  while (const std::size_t size = std::fread(piece.data(), 1, piece.size(), item.told.get()))
    std::cerr.write(piece.data(), static_cast<std::streamsize>(size));
  item.told.reset();
}

// The programs one after another, so many at a time.
class Work {
 public:
  Work(const FolderRun& run, std::vector<Item>& items)
      : run_(run), items_(items), progress_(false, run.quiet, language_of(run.setup)) {}

  // Returns the signal that has cut the work short; 0: none.
  int go_through() {
    for (Item& item : items_) {
      while (running_.size() >= run_.jobs) wait_for_one();
      hear(std::chrono::milliseconds::zero());
      if (stopped_by_ != 0 || without_server_) break;
      if (is_unchanged(run_, item))
        item.result = Result::unchanged;
      else
        begin(item);
      if (item.result != Result::not_begun) progress_.ended(++ended_, items_.size());
    }
    while (!running_.empty()) wait_for_one();
    progress_.clear();
    return stopped_by_;
  }

 private:
  void begin(Item& item) {
    if (const pid_t process = start(run_, item); process != 0) {
      running_.emplace(process, &item);
      return;
    }
    progress_.clear();
    std::cerr << "trc: " << item.file << ": no process can be started for it\n";
    item.code = static_cast<int>(Exit::limit);
    item.result = Result::failed;
  }

  void wait_for_one() {
    const std::size_t before = running_.size();
    for (;;) {
      int status = 0;
      for (pid_t process = 0; (process = ::waitpid(-1, &status, WNOHANG)) > 0;)
        end(process, status);
      if (running_.size() < before) return;
      constexpr std::chrono::milliseconds until_the_line_is_new{200};
      hear(until_the_line_is_new);
      progress_.ended(ended_, items_.size());
    }
  }

  // The first signal asks all processes to end, the next one does not ask.
  void hear(std::chrono::milliseconds longest) {
    const int asked = signals_.wait(longest);
    if (asked == 0) return;
    for (const auto& [process, item] : running_)
      ::kill(process, stopped_by_ == 0 ? SIGTERM : SIGKILL);
    if (stopped_by_ == 0) stopped_by_ = asked;
  }

  void end(pid_t process, int status) {
    const auto found = running_.find(process);
    if (found == running_.end()) return;
    Item& item = *found->second;
    running_.erase(found);
    progress_.clear();
    print_told(item);
    // A terminal tells the whole group: the process may have ended before the word is heard here.
    constexpr std::chrono::milliseconds until_told{100};
    if (WIFSIGNALED(status) && stopped_by_ == 0) hear(until_told);
    if (WIFEXITED(status)) {
      item.code = WEXITSTATUS(status);
      item.result = result_of(item.code);
    } else if (stopped_by_ != 0) {
      // It may have been done with all but its end.
      item.result = is_unchanged(run_, item) ? Result::done : Result::interrupted;
    } else {
      item.code = static_cast<int>(Exit::internal);
      item.result = Result::failed;
      std::cerr << "trc: " << item.file << ": the process was ended by signal " << WTERMSIG(status)
                << '\n';
    }
    // Beside a record that says REFUSED there is no result of an earlier run.
    std::error_code none;
    if (item.result == Result::refused) fs::remove(item.output, none);
    // It was waited for; the others would wait as long, one after another.
    if (item.code == static_cast<int>(Exit::unreachable)) without_server_ = true;
    progress_.ended(++ended_, items_.size());
  }

  const FolderRun& run_;
  std::vector<Item>& items_;
  Signals signals_{};
  Progress progress_;
  std::map<pid_t, Item*> running_{};
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
  for (const Item& item : items) width = std::max(width, item.file.size());
  std::map<std::string, int> counts;
  for (const Item& item : items) {
    const std::string result = text_of(item.result);
    ++counts[result];
    std::string line = item.file + std::string(width + 2 - item.file.size(), ' ') + result;
    v1::JobRecord record;
    const bool whole = item.result == Result::done || item.result == Result::unchanged;
    if (whole && read_record(item, record)) {
      const v1::PathSummary& path = record.summary().path();
      line += std::string(13 - result.size(), ' ') + std::to_string(path.blocks_out()) + " blocks";
      if (path.has_certificate()) {
        line += ", clearance ";
        append_fixed(line, path.certificate().clearance(), 4);
        line += " of ";
        append_fixed(line, path.certificate().tool_radius(), 4);
        line += " mm";
      }
      if (path.warnings() > 0) line += ", " + std::to_string(path.warnings()) + " warnings";
    }
    std::cout << line << '\n';
  }
  std::cout << items.size() << " programs";
  for (const auto& [result, count] : counts) std::cout << ", " << count << ' ' << result;
  std::cout << '\n';
}

}  // namespace

Exit compensate_folder(const FolderRun& run) {
  std::error_code fault;
  fs::create_directories(run.directory, fault);
  if (fault) {
    std::cerr << "trc: cannot make " << run.directory << ": " << fault.message() << '\n';
    return Exit::wrong_call;
  }
  std::vector<Item> items;
  std::set<std::string> names;
  for (const std::string& file : run.files) {
    const std::string name = fs::path(file).filename().string();
    if (!names.insert(name).second) {
      std::cerr << "trc: " << name << " is given twice; its results would have one name\n";
      return Exit::wrong_call;
    }
    const std::string output = (fs::path(run.directory) / name).string();
    if (fs::equivalent(file, output, fault)) {
      std::cerr << "trc: " << output << " would be written over the program itself\n";
      return Exit::wrong_call;
    }
    items.push_back({.file = file, .output = output, .record = output + ".json"});
  }
  const int stopped_by = Work(run, items).go_through();
  print_table(items);
  if (stopped_by != 0) end_by(stopped_by);
  int worst = 0;
  for (const Item& item : items) worst = std::max(worst, item.code);
  return static_cast<Exit>(worst);
}

}  // namespace trc::cli
