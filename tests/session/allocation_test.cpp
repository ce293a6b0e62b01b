// Counts what a stream takes from the heap once it is on its way: a program of its own, since it
// replaces the allocation functions.

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "core/session/path_session.h"
#include "core/session/program_session.h"
#include "tests/support/allocations.h"

namespace trc {
namespace {

// A ring of lines and bows with corners to both sides, outside and inside, closed: one lap.
std::vector<MoveRequest> lap() {
  constexpr int corners = 120;
  std::vector<MoveRequest> moves;
  Point from(300, 0);
  for (int i = 1; i <= corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = i == corners ? 300 : 300 + 3 * std::sin(7.0 * i);
    const Point to(radius * std::cos(angle), i == corners ? 0 : radius * std::sin(angle));
    MoveRequest move{.feed = 1000};
    move.end = {to.x(), to.y(), std::nullopt};
    if (i % 3 == 0) {
      const Vector chord = to - from;
      const Vector center = chord / 2 + 1.5 * left_of(chord);
      move.kind = MotionKind::counter_clockwise;
      move.center = {center.x(), center.y(), std::nullopt};
    }
    moves.push_back(move);
    from = to;
  }
  return moves;
}

SessionSetup setup() {
  SessionSetup setup;
  setup.program.mode.tool_radius = 2;
  setup.program.mode.transition = Transition::circular;
  setup.program.start = {320, 0, 0};
  return setup;
}

TEST(Stream, OfBlocksTakesNothingFromTheHeapOnItsWay) {
  PathSession session(setup());
  std::size_t blocks = 0;
  Answers out([&](const Answer& part) {
    blocks += part.blocks.size();
    return true;
  });
  ASSERT_TRUE(session.program().select(Side::right, {}));
  MoveRequest approach{.feed = 1000};
  approach.end = {300, 0, 0};
  ASSERT_TRUE(session.program().move(approach));
  const std::vector<MoveRequest> moves = lap();
  std::size_t taken = 0;
  for (int round = 0; round < 4; ++round) {
    blocks = 0;
    const std::size_t before = support::allocations();
    for (const MoveRequest& move : moves)
      ASSERT_TRUE(session.program().move(move) && session.advance(out));
    taken = support::allocations() - before;
    if (round == 0) {
      EXPECT_GT(taken, 5U) << "the count works";
    }
    EXPECT_GT(blocks, moves.size());
  }
  EXPECT_EQ(taken, 0U) << "for " << moves.size() << " blocks";
}

// A plate with a slot that the tool cannot enter: one selection with one loop.
void machine_plate(PathSession& session, Answers& out) {
  const auto move = [&](double x, double y) {
    MoveRequest request{.feed = 1000};
    request.end = {x, y, 0};
    ASSERT_TRUE(session.program().move(request) && session.advance(out));
  };
  move(-10, -10);
  ASSERT_TRUE(session.program().select(Side::right, {}));
  move(0, 0);
  move(40, 0);
  move(40, 20);
  move(21, 20);
  move(21, 5);
  move(19, 5);
  move(19, 20);
  move(0, 20);
  move(0, 0);
  ASSERT_TRUE(session.program().deselect({}));
  move(-10, -10);
}

// Most contours of CAM are small: what a selection needs stays for the next one.
TEST(Stream, OfSmallSelectionsWithLoopsTakesNothingFromTheHeapOnItsWay) {
  SessionSetup removing = setup();
  removing.program.mode.masking = Masking::on;
  removing.program.mode.options.remove_masked_blocks = true;
  removing.program.start = {-10, -10, 0};
  PathSession session(removing);
  Answers out([](const Answer& /*part*/) { return true; });
  std::size_t taken = 0;
  for (int round = 0; round < 20; ++round) {
    const std::size_t before = support::allocations();
    machine_plate(session, out);
    taken = support::allocations() - before;
  }
  // The note of the loop (900213) and its values are the caller's from then on.
  EXPECT_LE(taken, 8U);
}

// A plate that the tool reaches all of.
TEST(Stream, OfSmallSelectionsWithoutLoopsTakesTheirModesAloneFromTheHeap) {
  SessionSetup removing = setup();
  removing.program.mode.masking = Masking::on;
  removing.program.mode.options.remove_masked_blocks = true;
  removing.program.start = {-10, -10, 0};
  PathSession session(removing);
  Answers out([](const Answer& /*part*/) { return true; });
  const auto move = [&](double x, double y) {
    MoveRequest request{.feed = 1000};
    request.end = {x, y, std::nullopt};
    ASSERT_TRUE(session.program().move(request) && session.advance(out));
  };
  std::size_t taken = 0;
  for (int round = 0; round < 20; ++round) {
    const std::size_t before = support::allocations();
    ASSERT_TRUE(session.program().select(Side::right, {}));
    move(0, 0);
    move(40, 0);
    move(40, 20);
    move(0, 20);
    move(0, 0);
    ASSERT_TRUE(session.program().deselect({}));
    move(-10, -10);
    taken = support::allocations() - before;
  }
  EXPECT_LE(taken, 2U);
}

std::string text_of_lap() {
  std::string text;
  for (const MoveRequest& move : lap()) {
    const bool arc = move.kind != MotionKind::linear;
    text += arc ? "G03" : "G01";
    text += " X" + std::to_string(*move.end[0]) + " Y" + std::to_string(*move.end[1]);
    if (arc)
      text += " I" + std::to_string(*move.center[0]) + " J" + std::to_string(*move.center[1]);
    text += "\n";
  }
  return text;
}

TEST(Stream, OfTextTakesNothingFromTheHeapOnItsWay) {
  ProgramSession session({.session = setup()});
  std::size_t written = 0;
  Answers out([&](const Answer& part) {
    written += part.text.size();
    return true;
  });
  const std::string text = text_of_lap();
  ASSERT_TRUE(session.feed("G42 G01 X300 Y0 F1000\n", out));
  std::size_t taken = 0;
  // Each line that is used again grows to the longest text it ever held.
  for (int round = 0; round < 20; ++round) {
    written = 0;
    const std::size_t before = support::allocations();
    ASSERT_TRUE(session.feed(text, out));
    taken = support::allocations() - before;
    EXPECT_GT(written, text.size() / 2);
  }
  EXPECT_EQ(taken, 0U) << "for 120 lines";
}

}  // namespace
}  // namespace trc
