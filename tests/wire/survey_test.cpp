#include "proto/wire/survey.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trc::wire {
namespace {

TEST(SurveyMessages, RadiiAreAListOrARange) {
  v1::SurveySetup setup;
  EXPECT_EQ(read_radii("3,5.5,8", setup), "");
  EXPECT_EQ(std::vector<double>(setup.radii().begin(), setup.radii().end()),
            (std::vector<double>{3, 5.5, 8}));
  EXPECT_EQ(read_radii("1:2:0.25", setup), "");
  EXPECT_EQ(setup.range().to(), 2);
  for (const char* text : {"", "3,", "three", "1:2", "1:2:3:4", "nan", "1e999"})
    EXPECT_NE(read_radii(text, setup), "") << text;
}

TEST(SurveyMessages, RangeEndsWithItsLastStep) {
  v1::SurveySetup setup;
  setup.mutable_program();
  ASSERT_EQ(read_radii("0.1:0.75:0.1", setup), "");
  FieldFaults faults;
  const SurveySettings settings = from_proto(setup, FieldPath("setup"), faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(settings.radii, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}));
  EXPECT_FALSE(settings.is_path);
  EXPECT_TRUE(settings.wants_largest);
}

TEST(SurveyMessages, NameTheFieldsAtFault) {
  v1::SurveySetup setup;
  setup.mutable_path()->set_wear(1e9);
  setup.add_radii(1);
  setup.add_radii(1e7);
  setup.add_radii(1);
  setup.mutable_range()->set_from(2);
  setup.mutable_range()->set_to(1);
  FieldFaults faults;
  EXPECT_TRUE(from_proto(setup, FieldPath("setup"), faults).is_path);
  std::vector<std::string> fields;
  for (const FieldFault& fault : faults.listed()) fields.push_back(fault.field);
  EXPECT_EQ(fields, (std::vector<std::string>{"setup.path.wear", "setup.radii[1]", "setup.radii[2]",
                                              "setup.range.to"}));
}

TEST(SurveyMessages, TellWhatARadiusDoes) {
  survey::Surveyed found{.radius = 5, .reaches_all = false};
  found.summary.compensated_length = 123;
  found.clearance.wall_length = 200;
  found.clearance.touched_length = 150;
  found.left_out_length = 20;
  found.wall_length = 200;
  found.uncut_length = 50;
  found.limits = {{.index = 3, .number = 40, .line = 4}};
  v1::SurveyedRadius message;
  to_proto(found, message);
  EXPECT_TRUE(message.accepted());
  EXPECT_FALSE(message.reaches_every_wall());
  EXPECT_EQ(message.masked_share(), 0.1);
  EXPECT_EQ(message.uncut_length(), 50);
  EXPECT_EQ(message.compensated_length(), 123);
  EXPECT_FALSE(message.has_certificate());
  ASSERT_EQ(message.limits_size(), 1);
  EXPECT_EQ(message.limits(0).source_number(), 40U);
  EXPECT_EQ(message.limits(0).line(), 4U);

  found.refusal = diagnostic(Code::clearance_violated, {.index = 7});
  to_proto(found, message);
  EXPECT_FALSE(message.accepted());
  EXPECT_EQ(message.refusal().code(), 900216);
  EXPECT_FALSE(message.has_compensated_length());
  EXPECT_FALSE(message.has_uncut_length());
}

TEST(SurveyMessages, NameNoMoreStretchesThanAnAnswerHolds) {
  survey::Surveyed found{.radius = 5, .uncut_known = true};
  found.uncut.resize(
      2500,
      {.source = {.index = 1}, .plane = Plane::zx, .path = Line{.start = {1, 2}, .end = {3, 4}}});
  v1::SurveyedRadius message;
  to_proto(found, message);
  EXPECT_EQ(message.uncut_size(), 2000);
  EXPECT_EQ(message.uncut_left_out(), 500U);
  EXPECT_EQ(message.uncut(0).start().z(), 1);
  EXPECT_EQ(message.uncut(0).start().x(), 2);
  EXPECT_FALSE(message.uncut(0).has_center());
}

}  // namespace
}  // namespace trc::wire
