// A session that is written down and read back at any place gives the path of one that never was:
// every worked example, good and bad, and random programs.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/archive.h"
#include "core/session/program_session.h"
#include "tests/session/random_program.h"
#include "tests/support/expectation.h"
#include "tests/support/files.h"

namespace trc::support {
namespace {

namespace fs = std::filesystem;

struct Result {
  Answer output{};
  bool complete = false;
};

template <class Session>
std::string state_of(const Session& session) {
  std::ostringstream stream;
  StateWriter archive(stream);
  session.save(archive);
  return stream.str();
}

template <class Session>
void restore(Session& session, const std::string& state) {
  std::istringstream stream(state);
  StateReader archive(stream);
  session.load(archive);
}

Result unbroken(const ProgramSessionSetup& setup, std::string_view text) {
  Answers answers;
  ProgramSession session(setup);
  session.feed(text, answers);
  const bool complete = session.finish(answers);
  return {.output = answers.take(), .complete = complete};
}

// In pieces of at most `longest` bytes, each of them in a session of its own.
Result resumed(const ProgramSessionSetup& setup, std::string_view text, std::size_t longest,
               std::mt19937& random) {
  Answers answers;
  std::string state;
  for (;;) {
    ProgramSession session(setup);
    if (!state.empty()) restore(session, state);
    const std::string_view piece = text.substr(0, random() % longest + 1);
    text.remove_prefix(piece.size());
    const bool goes_on = session.feed(piece, answers);
    const bool complete = goes_on && text.empty() && session.finish(answers);
    if (!goes_on || text.empty()) return {.output = answers.take(), .complete = complete};
    state = state_of(session);
  }
}

void expect_same(const Result& actual, const Result& expected) {
  EXPECT_EQ(actual.complete, expected.complete);
  EXPECT_EQ(actual.output.text, expected.output.text);
  ASSERT_EQ(actual.output.blocks.size(), expected.output.blocks.size());
  for (std::size_t i = 0; i < expected.output.blocks.size(); ++i) {
    const CompensatedBlock& a = actual.output.blocks[i];
    const CompensatedBlock& e = expected.output.blocks[i];
    SCOPED_TRACE("block " + std::to_string(i));
    EXPECT_EQ(a.source, e.source);
    EXPECT_EQ(a.origin, e.origin);
    EXPECT_EQ(a.path, e.path);
    EXPECT_EQ(a.normal, e.normal);
    EXPECT_EQ(a.feed, e.feed);
    EXPECT_EQ(a.tangential, e.tangential);
    EXPECT_EQ(a.tracking, e.tracking);
    EXPECT_EQ(a.text, e.text);
  }
  ASSERT_EQ(actual.output.diagnostics.size(), expected.output.diagnostics.size());
  for (std::size_t i = 0; i < expected.output.diagnostics.size(); ++i) {
    EXPECT_EQ(actual.output.diagnostics[i].code, expected.output.diagnostics[i].code);
    EXPECT_EQ(actual.output.diagnostics[i].source, expected.output.diagnostics[i].source);
  }
}

void expect_resumable(ProgramSessionSetup setup, std::string_view text, std::size_t longest) {
  constexpr unsigned seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (const bool nc_text : {true, false}) {
    SCOPED_TRACE(nc_text ? "text" : "blocks");
    setup.nc_text = nc_text;
    expect_same(resumed(setup, text, longest, random), unbroken(setup, text));
  }
}

TEST(ResumedSession, GivesThePathOfTheWorkedExamples) {
  std::size_t programs = 0;
  for (const char* folder : {"good", "bad"}) {
    for (const fs::path& program : testing_support::nc_programs_in(folder)) {
      SCOPED_TRACE(program.filename().string());
      const std::string text = testing_support::content_of(program);
      expect_resumable(read_setup(text), text, 40);
      ++programs;
    }
  }
  EXPECT_GT(programs, 50U);
}

TEST(ResumedSession, GivesThePathOfRandomPrograms) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("program " + std::to_string(seed));
    expect_resumable({}, random_program(seed, true), 300);
  }
}

// Under G140 a selection of any length is held in two blocks and what rides on them.
TEST(ResumedSession, StateDoesNotGrowWithTheContour) {
  const auto largest = [](int blocks) {
    ProgramSession session({});
    Answers out;
    session.feed("G41 V.G.WZ_AKT.R=1\n", out);
    std::size_t size = 0;
    for (int i = 1; i <= blocks; ++i) {
      session.feed(
          "G1 X" + std::to_string(100000 + 10 * i) + " Y" + std::to_string(i % 2 * 20) + " F100\n",
          out);
      if (i > 10) size = std::max(size, state_of(session).size());
    }
    return size;
  };
  EXPECT_EQ(largest(2000), largest(20));
  EXPECT_LT(largest(20), 4608U);  // mostly the modes of all dialects
}

// With a window, what contour masking and loop removal hold of a selection is bounded by it
// (D-10), whether loops go or stay, and whatever stands after the blocks.
TEST(ResumedSession, StateIsBoundedByTheWindow) {
  const auto largest = [](const std::string& masking, bool implicit, int window, int teeth) {
    ProgramSessionSetup setup;
    setup.session.compensator.limits.look_ahead_blocks = static_cast<std::size_t>(window);
    setup.session.compensator.implicit_contour_masking = implicit;
    ProgramSession session(setup);
    Answers out;
    session.feed(masking + " V.G.WZ_AKT.R=3\nG41 G1 X50000 Y0 F100\n", out);
    std::size_t size = 0;
    bool goes_on = true;
    for (int i = 0; i < teeth && goes_on; ++i) {
      // A slot the tool gets into or, one in three, not; the numbers have one length throughout.
      const int x = 100'000 + 40 * i;
      const int width = i % 3 == 0 && !implicit ? 5 : 8;
      const auto to = [&](int dx, int y) {
        return "X" + std::to_string(x + dx) + " Y" + std::to_string(y) + "\n";
      };
      goes_on = session.feed(to(0, 0) + to(0, -9) + "M8\n" + to(width, -9) + to(width, 0), out);
      size = std::max(size, state_of(session).size());
      static_cast<void>(out.take());
    }
    EXPECT_TRUE(goes_on) << masking;
    return size;
  };
  for (const std::string masking : {"G141\n#TRC[REMOVE_MASKED_BLOCKS=1]\n", "G141\n", "G140\n"}) {
    const bool implicit = masking == "G140\n";
    const std::size_t few = largest(masking, implicit, 20, 200);
    EXPECT_LT(largest(masking, implicit, 20, 1'000), few + few / 10) << masking;
    EXPECT_GT(largest(masking, implicit, 0, 200), 2 * few) << masking;
  }
}

TEST(ResumedSession, WhatIsNoStateIsRefused) {
  ProgramSession session({});
  Answers out;
  session.feed("N10 G1 X10 F100\n", out);
  const std::string state = state_of(session);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, state.size() / 2}) {
    ProgramSession other({});
    EXPECT_THROW(restore(other, state.substr(0, size)), cereal::Exception);
  }
}

}  // namespace
}  // namespace trc::support
