#include "core/nc/dialect/trc_command.h"

#include <gtest/gtest.h>

#include <string>

namespace trc {
namespace {

TrcOptions options_of(std::string_view command, TrcOptions options = {}) {
  const auto fault = read_trc_command(command, options);
  EXPECT_FALSE(fault) << command << ": " << (fault ? fault->detail : "");
  return options;
}

std::string fault_of(std::string_view command) {
  TrcOptions options;
  const auto fault = read_trc_command(command, options);
  return fault
             ? std::to_string(static_cast<int>(fault->code)) + " at " + std::to_string(fault->begin)
             : "none";
}

class Spelling : public ::testing::TestWithParam<const char*> {};

TEST_P(Spelling, SwitchesReverseOn) {
  EXPECT_EQ(options_of(GetParam()), (TrcOptions{.reverse = true})) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(OfTheTrcCommand, Spelling,
                         ::testing::Values("#TRC[REVERSE=1]", "#TRC [REVERSE=1]",
                                           "#TRC [ REVERSE = 1 ]", "#TRC[REVERSE1]",
                                           "#TRC [REVERSE 1]", "#trc[reverse=1]",
                                           "#TRC [ [REVERSE=1] ]", "#TRC[REVERSE=1.0]",
                                           "# TRC [REVERSE=+1]", "#TRC[,REVERSE=1,]",
                                           "#TRC [REVERSE=[2-1]]", "#TRC [REVERSE=2-1]",
                                           "#TRC [REVERSE [ 2 - 1 ] ]", "#TRC [REVERSE= -[1-2] ]",
                                           "#TRC [REVERSE=[2+4]/[2*3]]", "#TRC [REVERSE=4/2**2]",
                                           "#TRC\u00a0[REVERSE\u00a0=\u00a01\u00a0]"));

TEST(TrcCommand, AVariableIsNamed) {
  TrcOptions options;
  EXPECT_EQ(read_trc_command("#TRC [REVERSE=P1]", options)->detail,
            "REVERSE=P1, a variable or function");
  EXPECT_EQ(read_trc_command("#TRC [KERF_MASKING=[1-V.P.ON]]", options)->detail,
            "KERF_MASKING=V.P.ON, a variable or function");
}

TEST(TrcCommand, TakesSeveralKeysAtOnce) {
  const TrcOptions expected{.conv_cir_to_lin = true,
                            .remove_masked_blocks = true,
                            .stretch_factor = 2.5,
                            .tangential_limit = 0.5};
  EXPECT_EQ(options_of("#TRC [CONV_CIR_TO_LIN=1 REMOVE_MASKED_BLOCKS=1, STRETCH_FACTOR=2.5 "
                       "TANGENTIAL_LIMIT=0.5]"),
            expected);
  EXPECT_EQ(options_of("#TRC [ [CONV_CIR_TO_LIN1] [REMOVE_MASKED_BLOCKS1] \\\n"
                       "[STRETCH_FACTOR2.5 TANGENTIAL_LIMIT.5] ]"),
            expected)
      << "groups in brackets";
}

TEST(TrcCommand, LeavesKeysThatAreNotNamedAlone) {
  EXPECT_EQ(options_of("#TRC [KERF_MASKING=0]", {.kerf_masking = true, .reverse = true}),
            (TrcOptions{.reverse = true}));
}

TEST(TrcCommand, EveryFlagOfTheTableCanBeSetAndReset) {
  for (const TrcKeyword& keyword : trc_keywords()) {
    const bool flag = keyword.smallest == 0 && keyword.largest == 1;
    if (!flag || keyword.name.starts_with("ONLINE")) continue;
    const std::string name(keyword.name);
    const TrcOptions set = options_of("#TRC[" + name + "=1]");
    EXPECT_NE(set, TrcOptions{}) << name;
    EXPECT_EQ(options_of("#TRC[" + name + "0]", set), TrcOptions{}) << name;
    EXPECT_EQ(fault_of("#TRC[" + name + "=2]"), "900005 at 5") << name;
    EXPECT_EQ(fault_of("#TRC[" + name + "=0.5]"), "900005 at 5") << name;
    EXPECT_EQ(fault_of("#TRC[" + name + "]"), "900005 at 5") << name;
  }
}

TEST(TrcCommand, AnUnknownKeyNamesTheNearestOne) {
  TrcOptions options;
  const auto near = read_trc_command("#TRC [KERF_MASK=1]", options);
  ASSERT_TRUE(near);
  EXPECT_EQ(near->code, Code::trc_option_unknown);
  EXPECT_EQ(near->begin, 6U);
  EXPECT_EQ(near->detail, "KERF_MASK, perhaps KERF_MASKING");
  const auto far = read_trc_command("#TRC [XYZZY=1]", options);
  ASSERT_TRUE(far);
  EXPECT_NE(far->detail.find("known are CONV_CIR_TO_LIN"), std::string::npos) << far->detail;
}

TEST(TrcCommand, FaultsAreFoundAtTheirPlace) {
  EXPECT_EQ(fault_of("#TRC [REVERSE=1"), "900009 at 5");
  EXPECT_EQ(fault_of("#TRC ["), "900009 at 5");
  EXPECT_EQ(fault_of("#TRC [[REVERSE=1]"), "900009 at 5");
  EXPECT_EQ(fault_of("#TRC [REVERSE=1 (comment)"), "900009 at 5");
  EXPECT_EQ(fault_of("#TRC REVERSE=1"), "900001 at 5");
  EXPECT_EQ(fault_of("#TRC [REVERSE=1] X1"), "900001 at 17");
  EXPECT_EQ(fault_of("#TRC [REVERSE=1 REVERSE=0]"), "900010 at 16");
  EXPECT_EQ(fault_of("#TRC [REVERSE=P1]"), "900003 at 14");
  EXPECT_EQ(fault_of("#TRC [REVERSE=1+V.L.A]"), "900003 at 16");
  EXPECT_EQ(fault_of("#TRC [REVERSE=[1+0]"), "900009 at 5");
  EXPECT_EQ(fault_of("#TRC [REVERSE=[1"), "900009 at 14");
  EXPECT_EQ(fault_of("#TRC [REVERSE=1/[2-2]]"), "900008 at 15");
  EXPECT_EQ(fault_of("#TRC [REVERSE=[3-1]]"), "900005 at 6");
  EXPECT_EQ(fault_of("#TRC [REVERSE=]"), "900005 at 6");
  EXPECT_EQ(fault_of("#TRC [TANGENTIAL_LIMIT=4]"), "900005 at 6");
  EXPECT_EQ(fault_of("#TRC [!]"), "900001 at 6");
}

TEST(TrcCommand, OnlineIsNotAvailable) {
  EXPECT_EQ(fault_of("#TRC [ONLINE=1]"), "900102 at 6");
  EXPECT_EQ(fault_of("#TRC [ONLINE_BY_VECTOR=1]"), "900102 at 6");
  EXPECT_EQ(fault_of("#TRC [INVERSE=1 ONLINE=2]"), "900102 at 16");
  EXPECT_EQ(fault_of("#TRC [ONLINE=4]"), "900005 at 6");
  EXPECT_EQ(options_of("#TRC [ONLINE=0 ONLINE_BY_VECTOR=0]"), TrcOptions{});
}

TEST(TrcCommand, SplitsAlongThePathAtSelectionUnlessToldOtherwise) {
  const SplitOption expected{
      .where = SplitOption::Where::pre, .along_path = true, .distance_1 = 5, .feed_1 = 200};
  EXPECT_EQ(options_of("#TRC[SPLIT_PATH PRE DIST_SEG1=5 FEED_SEG1=200]").split, expected);
  EXPECT_EQ(options_of("#TRC[SPLIT_PATH DIST_SEG15 FEED_SEG1200]").split, expected);
}

TEST(TrcCommand, SplitsByAnAxisInTwoSegments) {
  const SplitOption expected{.where = SplitOption::Where::combined,
                             .axis = 1,
                             .distance_1 = 5,
                             .feed_1 = 200,
                             .distance_2 = 2,
                             .feed_2 = 100};
  EXPECT_EQ(options_of("#TRC [SPLIT AX=Y COMBINED DIST_SEG1=5 FEED_SEG1=200 \\\r\n"
                       "DIST_SEG2=2 FEED_SEG2=100]")
                .split,
            expected);
  EXPECT_EQ(options_of("#TRC [SPLIT AXNR=2 COMBINED DIST_SEG1=5 FEED_SEG1=200 DIST_SEG2=2 "
                       "FEED_SEG2=100]")
                .split,
            expected);
}

TEST(TrcCommand, SplitOffForgetsTheSplit) {
  TrcOptions options;
  options.split = {.where = SplitOption::Where::post, .distance_1 = 1, .feed_1 = 1};
  EXPECT_EQ(options_of("#TRC[SPLIT_OFF]", options), TrcOptions{});
}

TEST(TrcCommand, SplitWordsMustFitTogether) {
  EXPECT_EQ(fault_of("#TRC[PRE DIST_SEG1=5 FEED_SEG1=200]"), "900005 at 0");
  EXPECT_EQ(fault_of("#TRC[SPLIT DIST_SEG1=5 FEED_SEG1=200]"), "900005 at 0");
  EXPECT_EQ(fault_of("#TRC[SPLIT_PATH AX=X DIST_SEG1=5 FEED_SEG1=200]"), "900005 at 0");
  EXPECT_EQ(fault_of("#TRC[SPLIT SPLIT_PATH]"), "900012 at 11");
  EXPECT_EQ(fault_of("#TRC[SPLIT PRE POST]"), "900012 at 15");
  EXPECT_EQ(fault_of("#TRC[SPLIT AX=A]"), "900011 at 11");
  EXPECT_EQ(fault_of("#TRC[SPLIT AXNR=4]"), "900005 at 11");
}

TEST(TangfeedCommand, HasANewAndAnOldForm) {
  double radius = -1;
  EXPECT_FALSE(read_tangfeed_command("#TANGFEED [RMIN=3]", radius));
  EXPECT_EQ(radius, 3);
  EXPECT_FALSE(read_tangfeed_command("#SET TANGFEED RMIN [2.5]", radius));
  EXPECT_EQ(radius, 2.5);
  EXPECT_FALSE(read_tangfeed_command("#tangfeed[rmin-1]", radius));
  EXPECT_EQ(radius, -1) << "the sign is for the state to refuse";
  EXPECT_FALSE(read_tangfeed_command("#TANGFEED []", radius));
  EXPECT_EQ(radius, 0);
}

TEST(TangfeedCommand, RefusesWhatItDoesNotKnow) {
  double radius = 0;
  EXPECT_EQ(read_tangfeed_command("#TANGFEED [RMAX=3]", radius)->code, Code::nc_syntax);
  EXPECT_EQ(read_tangfeed_command("#TANGFEED [RMIN=3", radius)->code, Code::nc_unclosed);
  EXPECT_EQ(read_tangfeed_command("#SET TANGFEED [3]", radius)->code, Code::nc_syntax);
}

}  // namespace
}  // namespace trc
