#include "server/telemetry/log.h"

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "server/text.h"

namespace trc::server {
std::string json_escaped(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const auto c = static_cast<unsigned char>(text.front());
    const std::size_t length = utf8_length(text);
    if (length == 0) {
      escaped += replacement_character;
    } else if (c == '"' || c == '\\') {
      escaped += '\\';
      escaped += static_cast<char>(c);
    } else if (c < 0x20 || c == 0x7F) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", c);
      escaped += code.data();
    } else {
      escaped += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return escaped;
}

void LogLine::begin(std::string_view field) {
  if (!fields_.empty()) fields_ += ',';
  fields_ += '"';
  fields_ += field;
  fields_ += "\":";
}

LogLine& LogLine::text(std::string_view field, std::string_view value) {
  begin(field);
  fields_ += '"';
  fields_ += json_escaped(value);
  fields_ += '"';
  return *this;
}

LogLine& LogLine::number(std::string_view field, std::uint64_t value) {
  begin(field);
  fields_ += std::to_string(value);
  return *this;
}

LogLine& LogLine::number(std::string_view field, double value) {
  begin(field);
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.6g", std::isfinite(value) ? value : 0.0);
  fields_ += digits.data();
  return *this;
}

Log::Log(std::string_view level)
    : logger_(std::make_shared<spdlog::logger>("trcd",
                                               std::make_shared<spdlog::sinks::stdout_sink_mt>())) {
  logger_->set_formatter(std::make_unique<spdlog::pattern_formatter>(
      R"({"ts":"%Y-%m-%dT%H:%M:%S.%fZ","level":"%l",%v})", spdlog::pattern_time_type::utc));
  set_level(level);
  logger_->flush_on(spdlog::level::info);
}

void Log::set_level(std::string_view level) const {
  logger_->set_level(spdlog::level::from_str(std::string(level)));
}

void Log::info(const LogLine& line) const { logger_->info("{}", line.str()); }
void Log::warning(const LogLine& line) const { logger_->warn("{}", line.str()); }
void Log::error(const LogLine& line) const { logger_->error("{}", line.str()); }
void Log::flush() const { logger_->flush(); }

}  // namespace trc::server
