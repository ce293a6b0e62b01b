#include "client/cli/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <functional>

namespace trc::cli {
namespace {

using Of = Advance::Of;

TEST(ProgressText, SaysHowMuchHowFastAndHowLongStill) {
  EXPECT_EQ(text_of({.of = Of::reading, .done = 42'000'000, .whole = 100'000'000, .seconds = 4},
                    Language::english),
            "42 % read, 10.5 MB/s, 6 s left");
  EXPECT_EQ(
      text_of({.of = Of::measuring, .done = 250, .whole = 1000, .seconds = 100}, Language::english),
      "25 % measured, 2 blocks/s, 5 min left");
  EXPECT_EQ(
      text_of({.of = Of::measuring, .done = 750, .whole = 1000, .seconds = 30}, Language::german),
      "75 % gemessen, 25 Sätze/s, noch 10 s");
}

TEST(ProgressText, CountsProgramsOfAFolder) {
  EXPECT_EQ(
      text_of({.of = Of::programs, .done = 420, .whole = 10'000, .seconds = 3}, Language::english),
      "420 of 10000 programs, 140/s, 69 s left");
  EXPECT_EQ(text_of({.of = Of::programs, .done = 4, .whole = 8, .seconds = 2}, Language::german),
            "4 von 8 Programmen, 2/s, noch 2 s");
  EXPECT_EQ(text_of({.of = Of::programs, .done = 0, .whole = 2, .seconds = 2}, Language::english),
            "0 of 2 programs");
}

TEST(ProgressText, SaysNothingThatIsNotKnown) {
  EXPECT_EQ(text_of({.done = 12'300'000, .whole = 0, .seconds = 3}, Language::english),
            "12.3 MB read, 4.1 MB/s, 3 s");
  EXPECT_EQ(text_of({.done = 10, .whole = 10, .seconds = 12}, Language::english),
            "all read, the path is on its way, 12 s");
  EXPECT_EQ(text_of({.of = Of::measuring, .done = 0, .whole = 10, .seconds = 1}, Language::english),
            "0 % measured, 0 blocks/s");
}

// What is written while standard error is a terminal.
std::string on_a_terminal(const std::function<void()>& write) {
  int ours = -1;
  int theirs = -1;
  if (openpty(&ours, &theirs, nullptr, nullptr, nullptr) != 0) return "no pseudo terminal";
  const int kept = dup(STDERR_FILENO);
  dup2(theirs, STDERR_FILENO);
  write();
  dup2(kept, STDERR_FILENO);
  close(kept);
  close(theirs);
  fcntl(ours, F_SETFL, O_NONBLOCK);
  std::array<char, 4096> buffer{};
  std::string text;
  for (ssize_t size = 0; (size = ::read(ours, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(size));
  close(ours);
  return text;
}

TEST(Progress, IsOneLineOfATerminalThatGoesAway) {
  const std::string said = on_a_terminal([] {
    Progress progress(Progress::Result::elsewhere, {}, Language::english,
                      Progress::Clock::duration::zero());
    progress.read(50, 100);
    progress.measured(0, 10);
  });
  EXPECT_EQ(said.find("\r50 % read, "), 0U) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_TRUE(said.ends_with("\r\x1b[K")) << said;
}

TEST(Progress, IsSilentForASecondAndWhereErrorsAloneAreWanted) {
  EXPECT_EQ(on_a_terminal([] { Progress(Progress::Result::elsewhere).read(50, 100); }), "");
  EXPECT_EQ(on_a_terminal([] {
              Progress(Progress::Result::elsewhere, {.quiet = true}, Language::english,
                       Progress::Clock::duration::zero())
                  .read(50, 100);
            }),
            "");
}

}  // namespace
}  // namespace trc::cli
