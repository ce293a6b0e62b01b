#include "core/geometry/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace trc {
namespace {

// What the tree does, done box by box.
struct PlainBoxes {
  std::size_t first = 0;
  std::vector<Box> boxes{};

  [[nodiscard]] std::size_t end() const { return first + boxes.size(); }
  [[nodiscard]] std::vector<std::size_t> near(const Box& area, double reach,
                                              const BoxTree::Range& skipped) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::size_t number = first + i;
      if (number >= skipped.first && number <= skipped.last) continue;
      if (boxes[i].exteriorDistance(area) <= reach) found.push_back(number);
    }
    return found;
  }
};

// In steps that a float can hold: no box is rounded.
double in_steps(double value) { return std::round(64 * value) / 64; }

Box random_box(std::mt19937_64& random, double about) {
  std::uniform_real_distribution<double> place(-3, 3);
  std::uniform_real_distribution<double> width(0, 2);
  const Eigen::Vector2d corner(in_steps(about + place(random)), in_steps(place(random)));
  return {corner, corner + Eigen::Vector2d(in_steps(width(random)), in_steps(width(random)))};
}

TEST(BoxTree, ForgetsNothingOfABoxByRounding) {
  for (const double where : {0.1, -0.1, 1234.5678, -9999.999}) {
    const Box box(Eigen::Vector2d(where, -where), Eigen::Vector2d(where + 1e-9, 1e-9 - where));
    BoxTree tree;
    tree.append(box);
    const Box kept = widened(tree[0]);
    EXPECT_TRUE(kept.contains(box)) << where;
    EXPECT_LT(squared_distance(kept, box), 1e-3);
    EXPECT_LT(kept.sizes().maxCoeff(), 1e-3);
  }
}

TEST(BoxTree, FindsWhatASearchBoxByBoxFinds) {
  constexpr unsigned seed = 20261121;
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t bound) { return random() % bound; };
  for (int run = 0; run < 60; ++run) {
    PlainBoxes plain{.first = run % 2 == 0 ? 0 : below(300)};
    BoxTree tree(plain.first);
    for (int step = 0; step < 900; ++step) {
      const std::size_t choice = below(40);
      if (choice < 30) {
        plain.boxes.push_back(random_box(random, static_cast<double>(plain.end()) * 0.3));
        tree.append(plain.boxes.back());
      } else if (choice == 30 && run % 3 != 0) {
        const std::size_t end = plain.first + below(plain.boxes.size() + 1);
        plain.boxes.resize(end - plain.first);
        tree.truncate(end);
      } else if (choice == 31 && run % 3 != 1) {
        const std::size_t gone = below(plain.boxes.size() / 4 + 1);
        plain.boxes.erase(plain.boxes.begin(),
                          plain.boxes.begin() + static_cast<std::ptrdiff_t>(gone));
        plain.first += gone;
        tree.drop_before(plain.first);
      }
      const Box area = random_box(
          random, static_cast<double>(plain.first + below(plain.boxes.size() + 1)) * 0.3);
      BoxTree::Range skipped;
      if (choice % 2 == 0) {
        skipped.first = plain.first + below(plain.boxes.size() + 1);
        skipped.last = skipped.first + below(60);
      }
      std::vector<std::size_t> found;
      const double reach = std::uniform_real_distribution<double>(0, 2)(random);
      tree.for_each_near(area, reach, skipped,
                         [&](std::size_t number) { found.push_back(number); });
      ASSERT_EQ(found, plain.near(area, reach, skipped))
          << "seed " << seed << " run " << run << " step " << step;
    }
  }
}

TEST(BoundingBox, HoldsAllOfAnArcAndNothingMore) {
  constexpr unsigned seed = 7;
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  const auto at = [](double direction) {
    return Point(3 + 2 * std::cos(direction), -1 + 2 * std::sin(direction));
  };
  for (int run = 0; run < 2000; ++run) {
    const double from = run % 5 == 0 ? 0.5 * std::numbers::pi * (run % 4) : angle(random);
    const double sweep = run % 7 == 0 ? 2 * std::numbers::pi : 2 * angle(random);
    const Box box = bounding_box(
        Arc{.start = at(from), .end = at(from + sweep), .center = {3, -1}, .sweep = sweep});
    Box sampled;
    for (int i = 0; i <= 2000; ++i) sampled.extend(at(from + sweep * i / 2000));
    ASSERT_LE((box.min() - sampled.min()).cwiseAbs().maxCoeff(), 1e-5) << "run " << run;
    ASSERT_LE((box.max() - sampled.max()).cwiseAbs().maxCoeff(), 1e-5) << "run " << run;
  }
}

TEST(BoxTree, EmptyFindsNothing) {
  const BoxTree tree;
  tree.for_each_near(Box(Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)), 1,
                     [](std::size_t) { FAIL() << "there is no box"; });
}

}  // namespace
}  // namespace trc
