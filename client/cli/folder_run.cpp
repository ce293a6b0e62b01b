#include "client/cli/folder_run.h"

#include <fcntl.h>
#include <google/protobuf/util/message_differencer.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "client/cli/job_record.h"
#include "core/base/version.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

// A program, its result and its record.
struct Item {
  std::string file{};
  std::string output{};
  std::string record{};
  bool unchanged = false;
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

void end(Item& item, int status) {
  item.code = WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(Exit::internal);
  std::rewind(item.told.get());
  std::array<char, 4096> piece{};
  while (const std::size_t size = std::fread(piece.data(), 1, piece.size(), item.told.get()))
    std::cerr.write(piece.data(), static_cast<std::streamsize>(size));
  if (WIFSIGNALED(status))
    std::cerr << "trc: " << item.file << ": the process was ended by signal " << WTERMSIG(status)
              << '\n';
  item.told.reset();
}

// All programs that are not unchanged, so many at a time.
void work_through(const FolderRun& run, std::vector<Item>& items) {
  std::map<pid_t, Item*> running;
  const auto wait_for_one = [&running] {
    int status = 0;
    const pid_t process = ::wait(&status);
    const auto ended = running.find(process);
    if (ended == running.end()) return;
    end(*ended->second, status);
    running.erase(ended);
  };
  for (Item& item : items) {
    if (item.unchanged) continue;
    // Of an earlier run, which is not what comes now.
    std::error_code none;
    fs::remove(item.record, none);
    while (running.size() >= run.jobs) wait_for_one();
    if (const pid_t process = start(run, item); process != 0) {
      running.emplace(process, &item);
    } else {
      std::cerr << "trc: " << item.file << ": no process can be started for it\n";
      item.code = static_cast<int>(Exit::limit);
    }
  }
  while (!running.empty()) wait_for_one();
}

const char* result_of(const Item& item) {
  if (item.unchanged) return "unchanged";
  switch (item.code) {
    case 0:
      return "done";
    case 1:
      return "refused";
    default:
      return "failed";
  }
}

void print_table(const std::vector<Item>& items) {
  std::size_t width = 4;
  for (const Item& item : items) width = std::max(width, item.file.size());
  std::map<std::string, int> counts;
  for (const Item& item : items) {
    const std::string result = result_of(item);
    ++counts[result];
    std::string line = item.file + std::string(width + 2 - item.file.size(), ' ') + result;
    v1::JobRecord record;
    if (item.code == 0 && read_record(item, record)) {
      const v1::PathSummary& path = record.summary().path();
      line += std::string(11 - result.size(), ' ') + std::to_string(path.blocks_out()) + " blocks";
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
    items.back().unchanged = is_unchanged(run, items.back());
  }
  work_through(run, items);
  print_table(items);
  int worst = 0;
  for (const Item& item : items) worst = std::max(worst, item.code);
  return static_cast<Exit>(worst);
}

}  // namespace trc::cli
