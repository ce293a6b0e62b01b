// Arcs and feeds in decimal numbers: where rounding could turn an arc into its complement, or a
// feed into none.

#include "core/nc/writer/motion_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/nc/state/circle.h"
#include "core/nc/text/number_format.h"
#include "tests/support/long_run.h"
#include "tests/support/on_circle.h"
#include "tests/support/random.h"

namespace trc::testing {
namespace {

constexpr double pi = std::numbers::pi;
using ArcForm = MotionWriter::ArcForm;
using support::on_circle;

Arc arc_from(const Point& center, double radius, double angle, double sweep) {
  const Point start = on_circle(center, radius, angle);
  const bool full = std::abs(sweep) == 2 * pi;
  return {.start = start,
          .end = full ? start : on_circle(center, radius, angle + sweep),
          .center = center,
          .sweep = sweep};
}

// A reader that has come to the start of the arc in rounded numbers.
WrittenState at_start(const Arc& arc, int places) {
  WrittenState state;
  for (int axis = 0; axis < 2; ++axis)
    state.position[static_cast<std::size_t>(axis)] =
        from_units(to_units(arc.start[axis], places), places);
  return state;
}

TEST(ArcForm, OrdinaryArcsStayArcs) {
  MotionWriter writer(4, "");
  for (const double sweep : {0.01, 1.0, pi, 4.0, 6.0, 2 * pi})
    for (const double sense : {1.0, -1.0}) {
      const Arc arc = arc_from({12.345678, -3.14159}, 20.123456, 0.7, sense * sweep);
      EXPECT_EQ(writer.numbers_of(arc, Plane::xy, at_start(arc, 4)).form, ArcForm::arc)
          << sense * sweep;
    }
}

// An arc one step behind its start would be read as a short one the other way round, or as a
// full circle, or with its centre shifted far along the short chord.
TEST(ArcForm, AlmostFullCircleIsWrittenInHalves) {
  MotionWriter writer(4, "");
  int halves = 0;
  for (double gap = 1e-5; gap < 2e-3; gap *= 1.3) {
    const Arc arc = arc_from({0.12345, 0.54321}, 50, 1.1, 2 * pi - gap / 50);
    const ArcForm form = writer.numbers_of(arc, Plane::xy, at_start(arc, 4)).form;
    EXPECT_NE(form, ArcForm::line);
    if (form == ArcForm::halves) ++halves;
  }
  EXPECT_GT(halves, 0);
}

TEST(ArcForm, ArcWithoutLengthAfterRoundingIsNoCircle) {
  MotionWriter writer(3, "");
  for (const double radius : {0.3, 5.0, 500.0}) {
    const Arc arc = arc_from({1, 1}, radius, 0.3, 2e-4 / radius);
    EXPECT_EQ(writer.numbers_of(arc, Plane::xy, at_start(arc, 3)).form, ArcForm::line) << radius;
  }
}

// Four decimals tell its ends apart; a control that has three would make a full circle of it.
TEST(ArcForm, ArcWithoutLengthInThousandthsIsNoCircle) {
  MotionWriter writer(4, "");
  for (const double radius : {0.3, 5.0, 105.0}) {
    const Arc arc = arc_from({100, 0}, radius, 3.1, 4e-4 / radius);
    EXPECT_EQ(writer.numbers_of(arc, Plane::xy, at_start(arc, 4)).form, ArcForm::line) << radius;
    const Arc longer = arc_from({100, 0}, radius, 3.1, 4e-3 / radius);
    EXPECT_EQ(writer.numbers_of(longer, Plane::xy, at_start(longer, 4)).form, ArcForm::arc)
        << radius;
  }
}

TEST(ArcForm, CircleSmallerThanAUnitIsNoCircle) {
  MotionWriter writer(2, "");
  const Arc arc = arc_from({1, 1}, 0.002, 0, 2 * pi);
  EXPECT_EQ(writer.numbers_of(arc, Plane::xy, at_start(arc, 2)).form, ArcForm::line);
}

// The sweep and the centre may differ from those that the numbers were chosen for.
TEST(ArcForm, IsFoundTheShortWayToo) {
  constexpr std::uint64_t seed = 8;
  support::Random random(seed);
  const int arcs = support::is_long_run() ? 20'000'000 : 300'000;
  std::array<int, 3> forms{};
  for (int i = 0; i < arcs; ++i) {
    const auto places = static_cast<int>(random.below(7));
    const double unit = from_units(1, places);
    const double radius = unit * std::pow(10, random.between(-1, 7));
    double sweep =
        random.chance(0.5) ? random.between(0.001, 2 * pi) : std::pow(10, random.between(-7, 0));
    if (random.chance(0.3)) sweep = 2 * pi - sweep;
    if (sweep <= 0) continue;
    if (random.chance(0.5)) sweep = -sweep;
    const Arc arc = arc_from({random.between(-100, 100), random.between(-100, 100)}, radius,
                             random.between(0, 2 * pi), sweep);
    WrittenState state = at_start(arc, places);
    for (double& position : state.position)
      if (random.chance(0.2)) position += random.between(-3, 3) * unit;
    state.absolute_center = random.chance(0.5);
    if (random.chance(0.2)) state.unit = LengthUnit::inch;
    MotionWriter writer(places, "");
    const MotionWriter::ArcNumbers numbers = writer.numbers_of(arc, Plane::xy, state);
    ASSERT_EQ(numbers.form, writer.form_of(arc, numbers, Plane::xy, state))
        << "seed " << seed << ", step " << i;
    ++forms[static_cast<std::size_t>(numbers.form)];
  }
  for (const int form : forms) EXPECT_GT(form, arcs / 100);
}

// For arcs of every size against the unit, what is written as an arc is read as that arc.
TEST(ArcForm, WhatIsAnArcIsReadAsTheSameArc) {
  support::Random random(7);
  int arcs = 0;
  for (int i = 0; i < 200'000; ++i) {
    const auto places = static_cast<int>(random.below(5));
    const double unit = from_units(1, places);
    const double radius = unit * std::pow(10, random.between(-1, 5));
    double sweep =
        random.chance(0.5) ? random.between(0.001, 2 * pi) : std::pow(10, random.between(-6, 0));
    if (random.chance(0.3)) sweep = 2 * pi - sweep;
    if (sweep <= 0) continue;
    if (random.chance(0.5)) sweep = -sweep;
    const Arc arc = arc_from({random.between(-100, 100), random.between(-100, 100)}, radius,
                             random.between(0, 2 * pi), sweep);
    WrittenState state = at_start(arc, places);
    state.absolute_center = random.chance(0.5);
    state.incremental = random.chance(0.5);
    MotionWriter writer(places, "");
    const MotionWriter::ArcNumbers numbers = writer.numbers_of(arc, Plane::xy, state);
    if (numbers.form != ArcForm::arc) continue;
    ++arcs;
    const Point start(state.position[0], state.position[1]);
    TextBuffer words;
    writer.append_arc(words, {arc, numbers}, {Position{arc.end.x(), arc.end.y(), 0}, {}}, state);
    const std::string text(words.view());
    const Point end(state.position[0], state.position[1]);
    Point center(std::stod(text.substr(text.find('I') + 1)),
                 std::stod(text.substr(text.find('J') + 1)));
    if (!state.absolute_center) center += start;
    for (const bool correct : {true, false}) {
      const CircleResult result =
          arc_about(center, {.start = start, .end = end, .clockwise = sweep < 0},
                    {.correct_center = correct}, ArcUse::as_programmed, Tolerances{});
      const Arc* read = std::get_if<Arc>(&result);
      ASSERT_NE(read, nullptr) << text << " seed 7, step " << i;
      ASSERT_NEAR(read->sweep, sweep, std::max(1.1e-3, 0.011 * std::abs(sweep)))
          << text << " seed 7, step " << i;
      ASSERT_LE((end - arc.end).cwiseAbs().maxCoeff(), unit / 2 * 1.000001);
      const double angle = std::atan2(start.y() - read->center.y(), start.x() - read->center.x());
      for (const double share : {0.25, 0.5, 0.75}) {
        const Point point = on_circle(read->center, radius_of(*read), angle + share * read->sweep);
        ASSERT_LE(std::abs((point - arc.center).norm() - radius),
                  (std::abs(sweep) > pi ? 5.001 : 2) * unit)
            << text << " seed 7, step " << i;
      }
    }
  }
  EXPECT_GT(arcs, 50'000);
}

TEST(Halves, ShareTheirJointAndTheSweep) {
  const Arc arc = arc_from({3, 4}, 10, 0.5, -5);
  const auto [first, second] = halves_of(arc);
  EXPECT_EQ(first.start, arc.start);
  EXPECT_EQ(first.end, second.start);
  EXPECT_EQ(second.end, arc.end);
  EXPECT_EQ(first.sweep, -2.5);
  EXPECT_EQ(second.sweep, -2.5);
  EXPECT_LE((first.end - on_circle({3, 4}, 10, 0.5 - 2.5)).norm(), 1e-12);
}

TEST(MotionWords, RotaryAxesHaveNoInch) {
  MotionWriter writer(4, "AU");
  WrittenState state{.unit = LengthUnit::inch, .tracking = {0, 0}};
  TextBuffer text;
  const TrackingTravel tracking{{.from = 0, .to = 30}, {.from = 0, .to = 50.8}};
  writer.append_line(text, MotionKind::linear, {Position{25.4, 0, 0}, tracking}, state);
  EXPECT_EQ(text.view(), " G01 X1 A30 U2");
  EXPECT_EQ(state.position[0], 25.4);
  EXPECT_EQ(state.tracking[0], 30);
  EXPECT_EQ(state.tracking[1], 50.8);
}

std::string feed_word(double feed, int decimals, LengthUnit unit = LengthUnit::mm) {
  WrittenState state;
  state.unit = state.feed_unit = unit;
  TextBuffer text;
  MotionWriter(decimals, "").append_feed(text, feed, state);
  EXPECT_NEAR(state.feed, feed, feed / 1000) << text.view();
  return std::string(text.view());
}

TEST(Feed, IsWrittenToAThousandthWithAnyNumberOfDecimals) {  // D-139
  EXPECT_EQ(feed_word(1000, 0), " F1000");
  EXPECT_EQ(feed_word(2.5, 0), " F2.5");
  EXPECT_EQ(feed_word(0.3333, 0), " F0.3333");
  EXPECT_EQ(feed_word(0.05, 4), " F0.05");
  EXPECT_EQ(feed_word(0.0001234567, 4), " F0.0001235");
  EXPECT_EQ(feed_word(254, 4, LengthUnit::inch), " F10");
  EXPECT_EQ(feed_word(1e9, 8), " F1000000000");
  EXPECT_EQ(feed_word(1e9, 4, LengthUnit::inch), " F39370078.74016");
}

TEST(Feed, IsNeverWrittenAsNone) {
  TextBuffer text;
  WrittenState state;
  MotionWriter(4, "").append_feed(text, 1e-15, state);
  EXPECT_EQ(text.view(), " F0.000000001");
  EXPECT_FALSE(MotionWriter(0, "").same_feed(0.2, 0.3, LengthUnit::mm));
}

}  // namespace
}  // namespace trc::testing
