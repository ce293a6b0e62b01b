#include "server/http/json_size.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace trc::server::http {
namespace {

// Room for 16 objects and arrays, and for 128 values beside the first.
bool is_refused(const std::string& json) {
  Config config;
  config.max_blocks_per_batch = 2;
  return refuse_size(json, config).has_value();
}

std::string times(std::size_t count, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

TEST(SizeOfJson, IsLimitedInObjectsAndArrays) {
  EXPECT_FALSE(is_refused(times(8, "{[")));
  EXPECT_TRUE(is_refused(times(8, "{[") + "{"));
}

TEST(SizeOfJson, IsLimitedInValues) {
  EXPECT_FALSE(is_refused("[" + times(128, "0,") + "0]"));
  EXPECT_TRUE(is_refused("[" + times(129, "0,") + "0]"));
}

TEST(SizeOfJson, DoesNotCountWhatStandsInTexts) {
  EXPECT_FALSE(is_refused("\"" + times(1000, "{,[") + "\""));
  EXPECT_FALSE(is_refused(R"("\")" + times(1000, "{,[") + "\""));
  EXPECT_TRUE(is_refused(R"("\\")" + times(1000, "{,["))) << "the text ends after its backslash";
}

}  // namespace
}  // namespace trc::server::http
