#include "core/trc/loops/certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace trc {
namespace {

constexpr double pi = std::numbers::pi;

struct Course {
  double at_start = 0;  // rad
  double sweep = 0;
};

Vector direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

Certificate::Block block_of(const Course& course) {
  return {.tangent_at_start = direction_of(course.at_start),
          .tangent_at_end = direction_of(course.at_start + course.sweep),
          .sweep = course.sweep,
          .left = 1,
          .shift_at_start = 1,
          .shift_at_end = 1};
}

// Of the directions from `first` to `last`.
double width_of(const std::vector<Course>& courses, std::size_t first, std::size_t last) {
  double least = courses[first].at_start;
  double greatest = least;
  for (std::size_t number = first; number <= last; ++number) {
    const auto [at_start, sweep] = courses[number];
    least = std::min({least, at_start, at_start + sweep});
    greatest = std::max({greatest, at_start, at_start + sweep});
  }
  return greatest - least;
}

// Lines and arcs, over many turns to either side.
std::vector<Course> winding(std::mt19937& random, double most) {
  std::uniform_real_distribution<double> turn(-most, 1.1 * most);
  std::vector<Course> courses;
  double direction = 0;
  for (int number = 0; number < 2'000; ++number) {
    direction += turn(random);
    courses.push_back({direction, number % 3 == 0 ? turn(random) : 0});
    direction += courses.back().sweep;
  }
  return courses;
}

TEST(Certificate, ChainsAreAsLongAsLessThanHalfATurnLetsThem) {
  constexpr double slack = 1e-5;
  std::mt19937 random(20261122);
  for (const double most : {0.01, 0.1, 0.5, 1.5, 2.8}) {
    SCOPED_TRACE(most);
    const std::vector<Course> courses = winding(random, most);
    Certificate certificate{Tolerances{}};
    for (std::size_t number = 0; number < courses.size(); ++number) {
      certificate.append(block_of(courses[number]),
                         number == 0 ? Certificate::Begin::behind_gap : Certificate::Begin::joined);
      const std::size_t first = certificate.chain_before(number);
      ASSERT_LE(first, number);
      ASSERT_LT(width_of(courses, first, number), pi) << number;
      ASSERT_TRUE(first == 0 || width_of(courses, first - 1, number) > pi - slack) << number;
    }
  }
}

TEST(Certificate, AnArcOfHalfATurnOrMoreStandsAlone) {
  for (const double sweep : {pi, -pi, 1.5 * pi, -2 * pi}) {
    Certificate certificate{Tolerances{}};
    certificate.append(block_of({.at_start = 0.3, .sweep = 0}), Certificate::Begin::behind_gap);
    certificate.append(block_of({.at_start = 0.3, .sweep = sweep}), Certificate::Begin::joined);
    certificate.append(block_of({.at_start = 0.3 + sweep, .sweep = 0}), Certificate::Begin::joined);
    certificate.append(block_of({.at_start = 0.3 + sweep, .sweep = 0.1}),
                       Certificate::Begin::joined);
    EXPECT_EQ(certificate.chain_behind(0), 0U) << sweep;
    EXPECT_EQ(certificate.chain_before(1), 1U) << sweep;
    EXPECT_EQ(certificate.chain_behind(1), 1U) << sweep;
    EXPECT_EQ(certificate.chain_before(3), 2U) << sweep;
  }
}

}  // namespace
}  // namespace trc
