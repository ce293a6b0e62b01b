#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "proto/wire/settings.h"
#include "server/in_process.h"
#include "server/rpc/get_server_info.h"
#include "tests/server/calls.h"

// What GetServerInfo says is what the reader of NC text does.
namespace trc::server {
namespace {

v1::GetServerInfoResponse server_info() {
  v1::GetServerInfoResponse response;
  describe(Config{}, response);
  return response;
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// The lines of a listing that move.
std::string path_of(const StreamAnswer& answer) {
  std::istringstream lines(answer.listing());
  std::string path;
  for (std::string line; std::getline(lines, line);)
    if (line.find("PASSTHROUGH") == std::string::npos) path += line + "\n";
  return path;
}

// Without a word of its own a program may be of another dialect (900016).
constexpr const char* of_isg = "V.G.WZ_AKT.R=5\n";

TEST(Capabilities, EveryGFunctionIsReadOrRefusedAsSaid) {
  const InProcessServer server;
  // G05 stands with a selection only, and some functions with words of their own.
  const std::map<std::string, std::string> in_its_words{{"G00", "G00 X5"},
                                                        {"G02", "G02 X20 Y0 I10 J0"},
                                                        {"G03", "G03 X20 Y0 I10 J0"},
                                                        {"G04", "G04 X1"},
                                                        {"G05", "G41 G05 G01 X10 Y10"}};
  const v1::GetServerInfoResponse info = server_info();
  for (const v1::GFunction& function : info.g_functions()) {
    const auto special = in_its_words.find(function.name());
    const std::string line = special == in_its_words.end() ? function.name() : special->second;
    const StreamAnswer answer = run_program(
        server.channel(), {},
        std::string(of_isg) + "G01 X0 Y0 F100\n" + line + "\nG40 G94\nG01 X40 Y40\nM30\n");
    if (function.group() == "refused with 900003") {
      EXPECT_EQ(answer.metadata("code"), "900003") << function.name();
    } else {
      EXPECT_TRUE(answer.status.ok()) << function.name() << ": " << answer.status.error_message();
    }
    EXPECT_FALSE(function.meaning().empty()) << function.name();
  }
}

// A function that holds from the start changes nothing when it is programmed.
TEST(Capabilities, InitialFunctionsHoldFromTheStart) {
  const InProcessServer server;
  const v1::ProgramSetup setup = blocks_setup();
  const std::string contour =
      "G41 X10 Y10 F100\nX50\nG02 X60 Y0 I-0.01 J-10\nG01 X60 Y-30\nG40 X90\nM30\n";
  std::map<std::string, int> initial_of_group;
  const StreamAnswer plain =
      run_program(server.channel(), setup, std::string(of_isg) + "G01 X1 Y1\n" + contour);
  ASSERT_TRUE(plain.status.ok()) << plain.status.error_message();
  const v1::GetServerInfoResponse info = server_info();
  for (const v1::GFunction& function : info.g_functions()) {
    if (!function.initial()) continue;
    ++initial_of_group[function.group()];
    if (function.name() == "G00") continue;
    const StreamAnswer answer =
        run_program(server.channel(), setup, of_isg + function.name() + "\nG01 X1 Y1\n" + contour);
    ASSERT_TRUE(answer.status.ok()) << function.name();
    EXPECT_EQ(path_of(answer), path_of(plain)) << function.name();
  }
  for (const char* group :
       {"motion", "feed adaptation", "plane", "transition", "compensation", "unit", "coordinates",
        "selection mode", "contour masking", "circle centre", "centre correction", "meaning of F"})
    EXPECT_EQ(initial_of_group[group], 1) << group;
}

TEST(Capabilities, EveryKeywordIsReadOrRefusedAsSaid) {
  const InProcessServer server;
  const std::map<std::string, std::string> in_its_words{
      {"SPLIT", "SPLIT AX=X PRE DIST_SEG1=5 FEED_SEG1=200"},
      {"AX", "SPLIT AX=X PRE DIST_SEG1=5 FEED_SEG1=200"},
      {"AXNR", "SPLIT AXNR=1 PRE DIST_SEG1=5 FEED_SEG1=200"},
      {"SPLIT_PATH", "SPLIT_PATH PRE DIST_SEG1=5 FEED_SEG1=200"},
      {"SPLIT_OFF", "SPLIT_OFF"},
      {"PRE", "SPLIT_PATH PRE DIST_SEG1=5 FEED_SEG1=200"},
      {"POST", "SPLIT_PATH POST DIST_SEG1=5 FEED_SEG1=200"},
      {"COMBINED", "SPLIT_PATH COMBINED DIST_SEG1=5 FEED_SEG1=200"},
      {"INVERSE", "ONLINE=1 INVERSE=1"}};
  const v1::GetServerInfoResponse info = server_info();
  for (const v1::TrcKeyword& keyword : info.trc_keywords()) {
    const std::string& name = keyword.name();
    const auto special = in_its_words.find(name);
    const std::string words =
        special != in_its_words.end() ? special->second
        : name.starts_with("DIST_") || name.starts_with("FEED_")
            ? "SPLIT_PATH PRE DIST_SEG1=5 FEED_SEG1=200 DIST_SEG2=5 FEED_SEG2=200"
            : name + "=" + number(keyword.max());
    const StreamAnswer answer =
        run_program(server.channel(), {},
                    "G01 X0 Y0 F100\n#TRC [" + words +
                        "]\nV.G.WZ_AKT.R=1\nG141 G41 G01 X40\nX80\nG40 X120 Y-20\nM30\n");
    EXPECT_FALSE(keyword.meaning().empty()) << name;
    if (keyword.available()) {
      EXPECT_TRUE(answer.status.ok()) << words << ": " << answer.status.error_message();
      EXPECT_TRUE(answer.diagnostics.empty()) << words;
    } else {
      EXPECT_EQ(answer.metadata("code"), "900102") << words << answer.status.error_message();
    }
  }
}

// What is said of the terms of the radius is what a setup takes.
TEST(Capabilities, TermsOfTheRadiusAreThoseOfTheSetup) {
  const v1::GetServerInfoResponse info = server_info();
  std::vector<std::string> names;
  for (const v1::RadiusTerm& term : info.radius_terms()) {
    names.push_back(term.name());
    EXPECT_NE(v1::PathSetup::descriptor()->FindFieldByName(term.name()), nullptr) << term.name();
    EXPECT_LE(term.min(), term.default_value());
    EXPECT_LT(term.min(), term.max());
    EXPECT_FALSE(term.meaning().empty());
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"tool_radius", "wear", "allowance", "nominal_radius"}));
}

TEST(Capabilities, SettingsAreThoseThatASetupTakes) {
  const v1::GetServerInfoResponse info = server_info();
  std::map<std::string, const v1::Setting*> settings;
  for (const v1::Setting& setting : info.settings()) {
    settings[setting.name()] = &setting;
    EXPECT_FALSE(setting.meaning().empty()) << setting.name();
    EXPECT_EQ(setting.has_min(), setting.has_max()) << setting.name();
    if (setting.default_value().empty()) continue;
    v1::ProgramSetup setup;
    EXPECT_EQ(wire::apply_setting(setting.name() + "=" + setting.default_value(), setup), "");
  }
  ASSERT_TRUE(settings.contains("block_skip"));
  EXPECT_EQ(settings["block_skip"]->values(), "refuse, execute, leave_out");
  EXPECT_EQ(settings["block_skip"]->default_value(), "refuse");
  ASSERT_TRUE(settings.contains("wear"));
  EXPECT_EQ(settings["wear"]->unit(), "mm");
  EXPECT_LT(settings["wear"]->min(), 0);
}

}  // namespace
}  // namespace trc::server
