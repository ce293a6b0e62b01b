#include "core/session/answers.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trc {
namespace {

CompensatedBlock block(std::uint64_t index) {
  CompensatedBlock made;
  made.source.index = index;
  return made;
}

Diagnostic warning(std::uint64_t index) {
  return diagnostic(Code::stretch_factor_out_of_range, {.index = index});
}

// "b0 b1 w1 | b2": blocks, text and warnings in their order, parts apart.
std::string order_of(const Answer& part) {
  std::string order = part.text;
  for (const CompensatedBlock& each : part.blocks)
    order += " b" + std::to_string(each.source.index);
  for (const Diagnostic& each : part.diagnostics) order += " w" + std::to_string(each.source.index);
  return order + " |";
}

void fill(Answers& out) {
  out.blocks().push_back(block(0));
  out.blocks().push_back(block(1));
  out.tell({});
  out.tell({warning(1), warning(1)});
  out.blocks().push_back(block(2));
  out.portion();
  out.blocks().push_back(block(3));
  out.tell({warning(3)});
  out.tell({warning(4)});
}

constexpr const char* filled = " b0 b1 w1 w1 | b2 | b3 w3 | w4 |";

TEST(Answers, KeepTheOrderInWhichTheyAreRaised) {
  Answers out;
  fill(out);
  std::string order;
  for (const Answer& part : out.parts()) order += order_of(part);
  EXPECT_EQ(order, filled);
  EXPECT_EQ(order_of(out.take()), " b0 b1 b2 b3 w1 w1 w3 w4 |");
  EXPECT_TRUE(out.take().empty());
}

TEST(Answers, GoToTheSinkInThatOrder) {
  std::string order;
  Answers out([&](const Answer& part) {
    order += order_of(part);
    return true;
  });
  fill(out);
  EXPECT_EQ(order, " b0 b1 w1 w1 | b2 | b3 w3 |") << "the last part may still grow";
  EXPECT_TRUE(out.hand_on());
  EXPECT_TRUE(out.hand_on()) << "nothing is handed on twice";
  EXPECT_EQ(order, filled);
}

TEST(Answers, AreNotHandedOnOnceNoMoreIsWanted) {
  int parts = 0;
  Answers out([&](const Answer& /*part*/) { return ++parts < 2; });
  fill(out);
  EXPECT_FALSE(out.hand_on());
  EXPECT_FALSE(out.wanted());
  EXPECT_EQ(parts, 2);
}

TEST(Answers, LetTheSinkTakeWhatIsInThem) {
  std::vector<CompensatedBlock> taken;
  Answers out([&](Answer& part) {
    taken.swap(part.blocks);
    return true;
  });
  out.blocks().push_back(block(7));
  EXPECT_TRUE(out.hand_on());
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_TRUE(out.blocks().empty());
}

}  // namespace
}  // namespace trc
