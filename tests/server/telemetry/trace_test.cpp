#include "server/telemetry/trace.h"

#include <gtest/gtest.h>

#include <string>

namespace trc::server {
namespace {

using namespace std::string_literals;

constexpr const char* example = "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01";

TEST(Trace, ContinuesThatOfTheCaller) {
  const Trace trace = trace_of(example);
  EXPECT_EQ(trace.trace_id, "4bf92f3577b34da6a3ce929d0e0e4736");
  EXPECT_EQ(trace.parent_id, "00f067aa0ba902b7");
  EXPECT_EQ(trace.span_id.size(), 16U);
  EXPECT_NE(trace.span_id, trace.parent_id);
}

TEST(Trace, BeginsANewOneWithoutHeader) {
  const Trace first = trace_of("");
  const Trace second = trace_of("");
  EXPECT_EQ(first.trace_id.size(), 32U);
  EXPECT_EQ(first.trace_id.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(first.parent_id, "");
  EXPECT_NE(first.trace_id, second.trace_id);
}

TEST(Trace, IsGoneOnWithByWhatItsHeaderSays) {
  const Trace outer = trace_of("");
  const Trace inner = trace_of(traceparent_of(outer));
  EXPECT_EQ(inner.trace_id, outer.trace_id);
  EXPECT_EQ(inner.parent_id, outer.span_id);
}

TEST(Trace, IgnoresWhatIsNoTraceparent) {
  const std::string good = example;
  for (const std::string& bad : {
           good.substr(1),
           good + "-00",
           "ff" + good.substr(2),
           "00-4BF92F3577B34DA6A3CE929D0E0E4736-00f067aa0ba902b7-01"s,
           "00-00000000000000000000000000000000-00f067aa0ba902b7-01"s,
           "00-4bf92f3577b34da6a3ce929d0e0e4736-0000000000000000-01"s,
           "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-0g"s,
           "00_4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01"s,
           std::string(10'000, '0'),
       }) {
    EXPECT_FALSE(read_traceparent(bad)) << bad;
  }
  // A later version may say more after that.
  EXPECT_TRUE(read_traceparent("01" + good.substr(2) + "-more"));
}

}  // namespace
}  // namespace trc::server
