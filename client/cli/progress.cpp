#include "client/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/cli/fixed_text.h"

namespace trc::cli {
namespace {

constexpr double bytes_per_mb = 1e6;
constexpr std::chrono::milliseconds between{200};

// From two minutes on in whole minutes: the time left is only an estimate.
std::string span(double seconds) {
  const double whole = std::ceil(seconds);
  return whole < 120 ? fixed(whole, 0) + " s" : fixed(std::ceil(whole / 60), 0) + " min";
}

// For example "74 s left".
std::string left(double seconds, bool german) {
  return german ? "noch " + span(seconds) : span(seconds) + " left";
}

std::string rate(const Advance& advance) {
  const double each = static_cast<double>(advance.done) / std::max(advance.seconds, 1e-3);
  return advance.of == Advance::Of::reading ? fixed(each / bytes_per_mb, 1) + " MB/s"
                                            : fixed(each, 0);
}

}  // namespace

std::string text_of(const Advance& advance, Language language) {
  const bool german = language == Language::german;
  const bool reading = advance.of == Advance::Of::reading;
  const double done = static_cast<double>(advance.done);
  if (reading && advance.whole > 0 && advance.done >= advance.whole)
    return (german ? "alles gelesen, die Bahn entsteht, " : "all read, the path is on its way, ") +
           span(advance.seconds);
  if (advance.of == Advance::Of::programs) {
    std::string text = fixed(done, 0) + (german ? " von " : " of ") +
                       std::to_string(advance.whole) + (german ? " Programmen" : " programs");
    if (advance.done == 0) return text;
    const double seconds_each = advance.seconds / done;
    return text + ", " + rate(advance) + "/s, " +
           left(seconds_each * static_cast<double>(advance.whole - advance.done), german);
  }
  std::string text = rate(advance);
  if (!reading) text += german ? " Sätze/s" : " blocks/s";
  if (advance.whole == 0)
    return fixed(done / bytes_per_mb, 1) + (german ? " MB gelesen, " : " MB read, ") + text + ", " +
           span(advance.seconds);
  const double whole = static_cast<double>(advance.whole);
  const char* const verb = reading ? (german ? " % gelesen, " : " % read, ")
                                   : (german ? " % gemessen, " : " % measured, ");
  text = fixed(std::floor(100 * done / whole), 0) + verb + text;
  if (advance.done == 0) return text;
  return text + ", " + left(advance.seconds * (whole - done) / done, german);
}

Progress::Progress(Result result, const Loudness& loudness, Language language,
                   Clock::duration silence)
    : enabled_(!loudness.quiet && isatty(STDERR_FILENO) == 1 &&
               !(result == Result::on_screen && isatty(STDOUT_FILENO) == 1)),
      language_(language),
      next_(part_began_ + silence) {}

void Progress::read(std::uint64_t bytes, std::uint64_t whole) {
  update({.of = Advance::Of::reading, .done = bytes, .whole = whole});
}

void Progress::measured(std::uint64_t blocks, std::uint64_t whole) {
  update({.of = Advance::Of::measuring, .done = blocks, .whole = whole});
}

void Progress::ended(std::uint64_t programs, std::uint64_t whole) {
  update({.of = Advance::Of::programs, .done = programs, .whole = whole});
}

void Progress::update(Advance advance) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (advance.of != of_) {
    of_ = advance.of;
    part_began_ = now;
    // The rate is not known earlier.
    next_ = std::max(next_, now + between);
  }
  if (now < next_) return;
  next_ = now + between;
  advance.seconds = std::chrono::duration<double>(now - part_began_).count();
  shown_ = true;
  std::fprintf(stderr, "\r%s\x1b[K", text_of(advance, language_).c_str());
  std::fflush(stderr);
}

void Progress::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace trc::cli
