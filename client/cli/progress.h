#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "client/cli/loudness.h"
#include "core/base/language.h"

namespace trc::cli {

// How far a part of the work is.
struct Advance {
  enum class Of : std::uint8_t {
    reading,    // and compensating; counted in bytes of text
    measuring,  // counted in blocks of the path
    programs,   // of a folder
  };
  Of of = Of::reading;
  std::uint64_t done = 0;
  std::uint64_t whole = 0;  // 0: not known, as of a program that comes through a pipe
  double seconds = 0;       // since this part began
};

// "42 % read, 12.3 MB/s, 7 s left"; without the whole "12.3 MB read, 4.1 MB/s, 3 s"; and where all
// is read "all read, the path is on its way, 12 s"; of a folder "420 of 10000 programs, 130/s, 74 s
// left".
[[nodiscard]] std::string text_of(const Advance& advance, Language language);

// A line on the terminal that says how far the work is, once it takes longer
// than a second. Nothing when standard error is no terminal, when the result
// itself is printed there, or when nothing but errors is wanted.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  enum class Result : std::uint8_t { on_screen, elsewhere };

  explicit Progress(Result result, const Loudness& loudness = {}, Language language = {},
                    Clock::duration silence = std::chrono::seconds(1));
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `whole`: 0 where it is not known.
  void read(std::uint64_t bytes, std::uint64_t whole);
  void measured(std::uint64_t blocks, std::uint64_t whole);
  void ended(std::uint64_t programs, std::uint64_t whole);
  // Removes the line, so that another can be written.
  void clear();

 private:
  void update(Advance advance);

  bool enabled_;
  Language language_;
  bool shown_ = false;
  Advance::Of of_ = Advance::Of::reading;
  Clock::time_point part_began_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace trc::cli
