#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace spdlog {
class logger;
}

namespace trc::server {

// The text as the inside of a JSON string. Every dynamic value of the log goes through here: a
// client chooses its tag, so nothing it sends may end the string or start a new line. Bytes that
// are not UTF-8 become U+FFFD.
std::string json_escaped(std::string_view text);

// The fields of one log line, in the order they are added.
class LogLine {
 public:
  explicit LogLine(std::string_view event) { text("event", event); }

  LogLine& text(std::string_view name, std::string_view value);
  LogLine& number(std::string_view name, std::uint64_t value);
  LogLine& number(std::string_view name, double value);

  [[nodiscard]] const std::string& str() const { return fields_; }

 private:
  void begin(std::string_view field);
  std::string fields_;
};

// JSON lines on standard output: one at start and end of the server, one per RPC, one per bug.
class Log {
 public:
  // Level: debug, info, warning, error or off.
  explicit Log(std::string_view level);

  void set_level(std::string_view level) const;

  void info(const LogLine& line) const;
  void warning(const LogLine& line) const;
  void error(const LogLine& line) const;
  void flush() const;

 private:
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace trc::server
