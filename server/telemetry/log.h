#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace trc::server {

// The text as the inside of a JSON string. Every dynamic value of the log goes through here: a
// client chooses its tag, so nothing it sends may end the string, start a new line or act on a
// terminal. Bytes that are not UTF-8 become U+FFFD.
std::string json_escaped(std::string_view text);

// The fields of one log line, in the order they are added.
class LogLine {
 public:
  // The event is the kind of the line.
  explicit LogLine(std::string_view event) : event_(event) { text("event", event); }

  LogLine& text(std::string_view name, std::string_view value);
  LogLine& number(std::string_view name, std::uint64_t value);
  LogLine& number(std::string_view name, double value);

  [[nodiscard]] const std::string& event() const { return event_; }
  [[nodiscard]] const std::string& str() const { return fields_; }

 private:
  void begin(std::string_view field);
  std::string event_;
  std::string fields_;
};

// Lets so many lines of each kind through in a second.
class LineRate {
 public:
  explicit LineRate(std::uint32_t most_per_second) : most_(most_per_second) {}
  void set_most(std::uint32_t per_second) { most_ = per_second; }
  [[nodiscard]] bool takes(std::string_view kind, std::chrono::steady_clock::time_point now);

 private:
  struct Kind {
    std::string name;
    std::chrono::steady_clock::time_point second;
    std::uint32_t lines = 0;
  };
  std::atomic<std::uint32_t> most_;
  std::mutex mutex_;
  std::vector<Kind> kinds_{};
};

// JSON lines on standard output: one for each event of the server, one per RPC, one per bug.
//
// A slow reader delays nothing: a separate thread writes the lines, and when more wait than it may
// hold, the oldest are dropped and counted. No call throws.
class Log {
 public:
  // Level: debug, info, warning, error or off.
  explicit Log(std::string_view level, std::uint32_t most_lines_per_second = 1000);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  void set_level(std::string_view level) const noexcept;
  void set_most_lines_per_second(std::uint32_t most) const noexcept;

  void info(const LogLine& line) const noexcept;
  void warning(const LogLine& line) const noexcept;
  void error(const LogLine& line) const noexcept;

  // Of all logs of the process, since its start.
  struct Counts {
    std::uint64_t written = 0;
    std::uint64_t overwritten = 0;  // by newer lines, as nobody read them
    std::uint64_t over_rate = 0;    // more of one kind than a second may have
    std::uint64_t failed = 0;       // not written, or in part: there was no room
    double blocked_s = 0;           // how long the line that is being written has been so
  };
  [[nodiscard]] static Counts counts() noexcept;
  // Waits until every line is out, at most so long. False when some are not.
  static bool flush(std::chrono::milliseconds longest) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trc::server
