#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace trc::cli {

// Processes of this program that do one task after another: a crash of one does not affect the
// tasks of the others, and starting a process for each task would take longer than most tasks.
class Workers {
 public:
  struct Ended {
    std::size_t task = 0;
    int code = 0;        // how the task ended; where a signal ended the process: 0
    int signal = 0;      // that; 0: none
    std::string told{};  // what came on standard error
  };

  // At most `count` at a time, called with `words`. They read names of tasks with `next_task` and
  // answer with `tell_code`.
  Workers(std::vector<std::string> words, unsigned count)
      : words_(std::move(words)), count_(count) {}
  // Lets the processes end.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] bool all_busy() const { return busy() >= count_; }
  [[nodiscard]] bool any_busy() const { return busy() > 0; }
  // Hands a task to an idle process. False: no process can be started for it.
  [[nodiscard]] bool give(std::size_t task, const std::string& name);
  // Waits for tasks to end, at most `longest` or until `other` can be read from.
  [[nodiscard]] std::vector<Ended> wait(std::chrono::milliseconds longest, int other);
  // Sends the signal to the processes at work.
  void signal(int number) const;

  // In a worker: waits for its next task. False: there is none.
  [[nodiscard]] static bool next_task(std::string& name);
  static void tell_code(int code);

 private:
  static constexpr std::size_t no_task = static_cast<std::size_t>(-1);
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Worker {
    pid_t process = 0;
    int tasks = -1;    // written by us
    int answers = -1;  // read by us
    std::size_t task = no_task;
    std::unique_ptr<std::FILE, CloseFile> told{};
  };

  [[nodiscard]] std::size_t busy() const;
  Worker* start();
  static std::string take_told(Worker& worker);
  // Lets the worker end, and returns how it ended.
  int dismiss(std::list<Worker>::iterator worker);

  std::vector<std::string> words_;
  std::size_t count_;
  std::list<Worker> workers_{};
};

}  // namespace trc::cli
