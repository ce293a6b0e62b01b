#include "server/telemetry/log.h"

#include <poll.h>
#include <spdlog/async_logger.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/details/thread_pool.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <exception>
#include <thread>

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"
#include "server/text.h"

namespace trc::server {
namespace {

using Clock = std::chrono::steady_clock;

// Lines that wait to be written. spdlog allocates a place for each in advance.
constexpr std::size_t most_waiting = 1024;

// Writes without a buffer of its own: otherwise the end of the process would write the rest, and
// wait for a reader.
class StandardOutput final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  [[nodiscard]] std::uint64_t written() const { return written_; }
  [[nodiscard]] std::uint64_t failed() const { return failed_; }
  [[nodiscard]] double blocked_s() const {
    const Clock::rep since = writing_since_;
    if (since == 0) return 0;
    return std::chrono::duration<double>(Clock::now().time_since_epoch() - Clock::duration(since))
        .count();
  }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    if (torn_) line.push_back('\n');
    formatter_->format(message, line);
    writing_since_ = Clock::now().time_since_epoch().count();
    const std::size_t put = put_out({line.data(), line.size()});
    writing_since_ = 0;
    if (put > 0) torn_ = line[put - 1] != '\n';
    ++(put == line.size() ? written_ : failed_);
  }
  void flush_() override {}

  // Writes the bytes; returns how many. Fewer if the reader has gone or the disk is full.
  static std::size_t put_out(std::string_view bytes) {
    std::size_t at = 0;
    while (at < bytes.size()) {
      const ssize_t count = ::write(STDOUT_FILENO, bytes.data() + at, bytes.size() - at);
      if (count > 0) at += static_cast<std::size_t>(count);
      if (count >= 0 || errno == EINTR) continue;
      if (errno != EAGAIN) break;
      // Standard output is non-blocking, so `write` does not wait.
      pollfd output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
      ::poll(&output, 1, -1);
    }
    return at;
  }

  std::atomic<Clock::rep> writing_since_ = 0;  // 0: not writing
  std::atomic<std::uint64_t> written_ = 0;
  std::atomic<std::uint64_t> failed_ = 0;
  bool torn_ = false;  // the last bytes written do not end a line
};

std::atomic<bool> output_exists = false;  // once something is logged

// Standard output and the thread that writes to it, shared by all logs of the process. Never
// destroyed, because its thread may wait for a reader for ever.
class Output {
 public:
  static Output& get() {
    static Output& output = *new Output;
    return output;
  }

  void put(spdlog::level::level_enum level, const std::string& line) {
    ++put_;
    logger_->log(level, "{}", line);
  }
  void count_over_rate() { ++over_rate_; }

  [[nodiscard]] Log::Counts counts() const {
    return {.written = sink_->written(),
            .overwritten = threads_->overrun_counter(),
            .over_rate = over_rate_,
            .failed = sink_->failed(),
            .blocked_s = sink_->blocked_s()};
  }
  [[nodiscard]] bool is_empty() const {
    return sink_->written() + sink_->failed() + threads_->overrun_counter() >= put_;
  }

 private:
  Output()
      : sink_(std::make_shared<StandardOutput>()),
        threads_(std::make_shared<spdlog::details::thread_pool>(most_waiting, 1)),
        logger_(std::make_shared<spdlog::async_logger>(
            "trcd", sink_, threads_, spdlog::async_overflow_policy::overrun_oldest)) {
    logger_->set_formatter(std::make_unique<spdlog::pattern_formatter>(
        R"({"ts":"%Y-%m-%dT%H:%M:%S.%fZ","level":"%l",%v})", spdlog::pattern_time_type::utc));
    logger_->set_level(spdlog::level::trace);
    output_exists = true;
  }

  std::shared_ptr<StandardOutput> sink_;
  std::shared_ptr<spdlog::details::thread_pool> threads_;
  std::shared_ptr<spdlog::async_logger> logger_;
  std::atomic<std::uint64_t> put_ = 0;
  std::atomic<std::uint64_t> over_rate_ = 0;
};

}  // namespace

std::string json_escaped(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const auto c = static_cast<unsigned char>(text.front());
    const std::size_t length = utf8_character(text);
    if (length == 0) {
      escaped += replacement_character;
    } else if (c == '"' || c == '\\') {
      escaped += '\\';
      escaped += static_cast<char>(c);
    } else if (const std::uint32_t point = code_point(text.substr(0, length));
               acts_on_display(point)) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", point & 0xFFFFU);
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

bool LineRate::takes(std::string_view kind, std::chrono::steady_clock::time_point now) {
  const std::lock_guard lock(mutex_);
  auto found = std::find_if(kinds_.begin(), kinds_.end(),
                            [&](const Kind& known) { return known.name == kind; });
  if (found == kinds_.end())
    found = kinds_.insert(found, Kind{.name = std::string(kind), .second = now});
  if (now - found->second >= std::chrono::seconds(1)) {
    found->second = now;
    found->lines = 0;
  }
  return ++found->lines <= most_;
}

struct Log::State {
  State(spdlog::level::level_enum first_level, std::uint32_t most_lines_per_second)
      : level(first_level), rate(most_lines_per_second) {}
  std::atomic<spdlog::level::level_enum> level;
  LineRate rate;

  void put(spdlog::level::level_enum line_level, const LogLine& line) noexcept {
    if (line_level < level) return;
    try {
      Output& output = Output::get();
      if (rate.takes(line.event(), std::chrono::steady_clock::now()))
        output.put(line_level, line.str());
      else
        output.count_over_rate();
    } catch (const std::exception&) {
      // A line that finds no memory is lost.
    }
  }
};

Log::Log(std::string_view level, std::uint32_t most_lines_per_second)
    : state_(std::make_unique<State>(spdlog::level::from_str(std::string(level)),
                                     most_lines_per_second)) {}
Log::~Log() = default;

void Log::set_level(std::string_view level) const noexcept {
  state_->level = spdlog::level::from_str(std::string(level));
}

void Log::set_most_lines_per_second(std::uint32_t most) const noexcept {
  state_->rate.set_most(most);
}

void Log::info(const LogLine& line) const noexcept { state_->put(spdlog::level::info, line); }
void Log::warning(const LogLine& line) const noexcept { state_->put(spdlog::level::warn, line); }
void Log::error(const LogLine& line) const noexcept { state_->put(spdlog::level::err, line); }

Log::Counts Log::counts() noexcept { return output_exists ? Output::get().counts() : Counts{}; }

bool Log::flush(std::chrono::milliseconds longest) noexcept {
  if (!output_exists) return true;
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!Output::get().is_empty()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace trc::server
