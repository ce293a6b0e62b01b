#include "server/telemetry/log.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "server/text.h"

namespace trc::server {
namespace {

using namespace std::string_literals;

TEST(Log, NoValueCanEndItsStringOrItsLine) {
  EXPECT_EQ(json_escaped("a\"b\\c"), "a\\\"b\\\\c");
  EXPECT_EQ(json_escaped("tag\n{\"level\":\"error\"}"), "tag\\u000a{\\\"level\\\":\\\"error\\\"}");
  EXPECT_EQ(json_escaped("nul\0end"s), "nul\\u0000end");
  EXPECT_EQ(json_escaped("\x1b[31m"), "\\u001b[31m");
  // CSI, which terminals take for ESC [, and characters that break a line or turn it round.
  EXPECT_EQ(json_escaped("\xC2\x9B"
                         "31m"),
            "\\u009b31m");
  EXPECT_EQ(json_escaped("\xE2\x80\xA8 \xE2\x80\xAE \xE2\x81\xA6"), "\\u2028 \\u202e \\u2066");
}

TEST(Log, KeepsTextAndReplacesWhatIsNone) {
  EXPECT_EQ(json_escaped("Fr\xC3\xA4ser \xE2\x82\xAC \xF0\x9F\x94\xA7"),
            "Fr\xC3\xA4ser \xE2\x82\xAC \xF0\x9F\x94\xA7");
  EXPECT_EQ(json_escaped("a\xC3"), "a\xEF\xBF\xBD");
  EXPECT_EQ(json_escaped("\xFF"
                         "b"),
            "\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(json_escaped("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");           // overlong
  EXPECT_EQ(json_escaped("\xED\xA0\x80").substr(0, 3), "\xEF\xBF\xBD");      // surrogate
  EXPECT_EQ(json_escaped("\xF4\x90\x80\x80").substr(0, 3), "\xEF\xBF\xBD");  // beyond U+10FFFF
}

TEST(Log, LineHoldsItsFieldsInOrder) {
  EXPECT_EQ(LogLine("rpc").text("tag", "a\"b").number("blocks", std::uint64_t{7}).str(),
            R"("event":"rpc","tag":"a\"b","blocks":7)");
  EXPECT_EQ(LogLine("x").number("ms", 1.5).str(), R"("event":"x","ms":1.5)");
}

TEST(Log, EachKindHasItsLinesOfASecond) {
  LineRate rate(3);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(rate.takes("rpc", begin));
  EXPECT_FALSE(rate.takes("rpc", begin));
  EXPECT_TRUE(rate.takes("incident", begin));
  EXPECT_FALSE(rate.takes("rpc", begin + std::chrono::milliseconds(999)));
  EXPECT_TRUE(rate.takes("rpc", begin + std::chrono::milliseconds(1000)));
}

TEST(Text, PresentableTextIsCutBetweenCharacters) {
  EXPECT_EQ(presentable("abc\x01"
                        "d"),
            "abc d");
  EXPECT_EQ(presentable("a\xC2\x9B"
                        "b\xE2\x80\xAE"),
            "a b ");
  EXPECT_EQ(presentable("\xC3\xA4\xC3\xA4", 3), "\xC3\xA4...");
  EXPECT_EQ(presentable("\xC3\xA4\xC3\xA4", 4), "\xC3\xA4\xC3\xA4");
  EXPECT_EQ(presentable("\xC3"), "\xEF\xBF\xBD");
}

}  // namespace
}  // namespace trc::server
