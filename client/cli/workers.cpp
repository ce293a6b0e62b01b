#include "client/cli/workers.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <iterator>
#include <utility>

namespace trc::cli {
namespace {

using Pipe = std::array<int, 2>;

void close_both(const Pipe& pipe) {
  for (const int end : pipe)
    if (end >= 0) ::close(end);
}

// Writes the whole text. The caller ends a name with a byte that no name contains.
bool write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Workers::~Workers() {
  while (!workers_.empty()) dismiss(workers_.begin());
}

std::size_t Workers::busy() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(workers_, [](const Worker& worker) { return worker.task != no_task; }));
}

bool Workers::give(std::size_t task, const std::string& name) {
  // If an idle worker has died, writing to it fails.
  for (;;) {
    auto idle = std::ranges::find(workers_, no_task, &Worker::task);
    if (idle == workers_.end()) {
      if (start() == nullptr) return false;
      idle = std::prev(workers_.end());
    }
    if (write_whole(idle->tasks, name + '\0')) {
      idle->task = task;
      return true;
    }
    dismiss(idle);
  }
}

Workers::Worker* Workers::start() {
  // Writing to a dead worker must not end this process; a later read finds it.
  ::signal(SIGPIPE, SIG_IGN);
  Worker worker;
  worker.told.reset(std::tmpfile());
  Pipe tasks{-1, -1};
  Pipe answers{-1, -1};
  if (!worker.told || ::pipe2(tasks.data(), O_CLOEXEC) != 0 ||
      ::pipe2(answers.data(), O_CLOEXEC) != 0) {
    close_both(tasks);
    return nullptr;
  }
  std::vector<std::string> words{"trc"};
  words.insert(words.end(), words_.begin(), words_.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, tasks[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, answers[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(worker.told.get()), STDERR_FILENO);
  const int fault =
      posix_spawn(&worker.process, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(tasks[0]);
  ::close(answers[1]);
  worker.tasks = tasks[1];
  worker.answers = answers[0];
  if (fault != 0) {
    ::close(worker.tasks);
    ::close(worker.answers);
    return nullptr;
  }
  return &workers_.emplace_back(std::move(worker));
}

// Rewinds the file for both processes, because they share its position.
std::string Workers::take_told(Worker& worker) {
  const int file = fileno(worker.told.get());
  std::string text;
  std::array<char, 4096> piece{};
  ::lseek(file, 0, SEEK_SET);
  for (ssize_t size = 0; (size = ::read(file, piece.data(), piece.size())) > 0;)
    text.append(piece.data(), static_cast<std::size_t>(size));
  ::lseek(file, 0, SEEK_SET);
  if (!text.empty() && ::ftruncate(file, 0) != 0) worker.told.reset(std::tmpfile());
  return text;
}

int Workers::dismiss(std::list<Worker>::iterator worker) {
  ::close(worker->tasks);
  ::close(worker->answers);
  int status = 0;
  while (::waitpid(worker->process, &status, 0) < 0 && errno == EINTR) {
  }
  workers_.erase(worker);
  return status;
}

std::vector<Workers::Ended> Workers::wait(std::chrono::milliseconds longest, int other) {
  std::vector<pollfd> questions{{.fd = other, .events = POLLIN, .revents = 0}};
  std::vector<std::list<Worker>::iterator> asked;
  for (auto worker = workers_.begin(); worker != workers_.end(); ++worker) {
    if (worker->task == no_task) continue;
    questions.push_back({.fd = worker->answers, .events = POLLIN, .revents = 0});
    asked.push_back(worker);
  }
  std::vector<Ended> ended;
  if (::poll(questions.data(), questions.size(), static_cast<int>(longest.count())) <= 0)
    return ended;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (questions[i + 1].revents == 0) continue;
    Worker& worker = *asked[i];
    unsigned char code = 0;
    const ssize_t size = ::read(worker.answers, &code, 1);
    if (size < 0 && errno == EINTR) continue;
    Ended& task = ended.emplace_back(Ended{.task = std::exchange(worker.task, no_task)});
    task.told = take_told(worker);
    if (size > 0) {
      task.code = code;
      continue;
    }
    const int status = dismiss(asked[i]);
    task.code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    task.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }
  return ended;
}

void Workers::signal(int number) const {
  for (const Worker& worker : workers_)
    if (worker.task != no_task) ::kill(worker.process, number);
}

bool Workers::next_task(std::string& name) {
  name.clear();
  for (char c = 0;;) {
    const ssize_t size = ::read(STDIN_FILENO, &c, 1);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    if (c == '\0') return true;
    name += c;
  }
}

void Workers::tell_code(int code) {
  const char answer = static_cast<char>(code);
  static_cast<void>(write_whole(STDOUT_FILENO, {&answer, 1}));
}

}  // namespace trc::cli
