#include "client/load/digest.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace trc::load {
namespace {

std::vector<CompensatedBlock> path() {
  std::vector<CompensatedBlock> blocks(40);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].source = {.index = i, .number = 10};
    blocks[i].feed = 1000;
    blocks[i].path = Line{.start = {double(i), 0}, .end = {double(i + 1), 0}};
  }
  blocks[7].path = Arc{.start = {7, 0}, .end = {8, 0}, .center = {7.5, 0}, .sweep = 3.14};
  blocks[9].tracking = {{.from = 1, .to = 2}};
  blocks[11].text = "M8";
  return blocks;
}

ResultCheck checked(const std::vector<CompensatedBlock>& wanted,
                    const std::vector<CompensatedBlock>& given) {
  static std::vector<std::unique_ptr<ExpectedResult>> kept;
  kept.push_back(std::make_unique<ExpectedResult>(8));
  for (const CompensatedBlock& block : wanted) kept.back()->add(block);
  ResultCheck check(*kept.back());
  for (const CompensatedBlock& block : given) check.add(block);
  check.finish();
  return check;
}

TEST(ResultCheck, TakesTheSamePath) { EXPECT_FALSE(checked(path(), path()).differs()); }

TEST(ResultCheck, NoticesEveryFieldOfABlock) {
  const std::vector<std::pair<std::size_t, std::function<void(CompensatedBlock&)>>> changes{
      {3, [](auto& block) { ++block.source.index; }},
      {3, [](auto& block) { ++block.source.number; }},
      {3, [](auto& block) { ++block.source.line; }},
      {3, [](auto& block) { block.origin = Origin::transition; }},
      {3, [](auto& block) { block.plane = Plane::yz; }},
      {3, [](auto& block) { block.rapid = true; }},
      {3, [](auto& block) { block.tangential = true; }},
      {3, [](auto& block) { block.feed = std::nextafter(block.feed, 0); }},
      {3, [](auto& block) { block.normal.from = 1; }},
      {3, [](auto& block) { block.normal.to = 1; }},
      {3, [](auto& block) { std::get<Line>(block.path).start.y() = -0.0; }},
      {3, [](auto& block) { std::get<Line>(block.path).end.x() += 1e-15; }},
      {7, [](auto& block) { std::get<Arc>(block.path).center.x() += 1e-15; }},
      {7, [](auto& block) { std::get<Arc>(block.path).center.y() += 1e-300; }},
      {7, [](auto& block) { std::get<Arc>(block.path).sweep += 1e-15; }},
      {9, [](auto& block) { block.tracking[0].to = 2.5; }},
      {11, [](auto& block) { block.text = "M9"; }},
      {39, [](auto& block) { block.feed = 1; }},
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    std::vector<CompensatedBlock> changed = path();
    changes[i].second(changed[changes[i].first]);
    const ResultCheck check = checked(path(), changed);
    EXPECT_TRUE(check.differs());
    EXPECT_EQ(check.right(), changes[i].first / 8 * 8);
  }
}

TEST(ResultCheck, NoticesBlocksThatAreMissingTooManyOrExchanged) {
  std::vector<CompensatedBlock> shorter = path();
  shorter.pop_back();
  EXPECT_TRUE(checked(path(), shorter).differs());
  EXPECT_TRUE(checked(shorter, path()).differs());
  std::vector<CompensatedBlock> exchanged = path();
  std::swap(exchanged[4], exchanged[5]);
  EXPECT_TRUE(checked(path(), exchanged).differs());
}

TEST(ResultCheck, DoesNotMindHowTextIsCut) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "N" + std::to_string(i) + " G01 X1\n";
  ExpectedResult expected(64);
  expected.add(std::string_view(text));
  for (const std::size_t piece : {1U, 7U, 64U, 100U, 5000U}) {
    ResultCheck check(expected);
    for (std::string_view rest = text; !rest.empty();
         rest.remove_prefix(std::min(piece, rest.size())))
      check.add(rest.substr(0, piece));
    EXPECT_FALSE(check.differs()) << piece;
    check.finish();
    EXPECT_FALSE(check.differs()) << piece;
  }
  for (const std::size_t place :
       {std::size_t{0}, std::size_t{63}, std::size_t{64}, text.size() - 1}) {
    std::string changed = text;
    changed[place] ^= 1;
    ResultCheck check(expected);
    check.add(std::string_view(changed));
    check.finish();
    EXPECT_TRUE(check.differs()) << place;
    EXPECT_EQ(check.right(), place / 64 * 64) << place;
  }
}

}  // namespace
}  // namespace trc::load
