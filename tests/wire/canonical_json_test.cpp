#include "proto/wire/canonical_json.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "proto/wire/json.h"

namespace trc::wire {
namespace {

std::string canonical(const std::string& text) {
  google::protobuf::Struct object;
  EXPECT_EQ(Json().read(text, object), "") << text;
  return canonical_json(object);
}

// The examples of RFC 8785, 3.2.2 and 3.2.3.
TEST(CanonicalJson, IsThatOfTheRfc) {
  EXPECT_EQ(canonical(R"({
    "numbers": [333333333.33333329, 1E30, 4.50, 2e-3, 0.000000000000000000000000001],
    "string": "\u20ac$\u000F\u000aA'\u0042\u0022\u005c\\\"\/",
    "literals": [null, true, false]
  })"),
            R"({"literals":[null,true,false],)"
            R"("numbers":[333333333.3333333,1e+30,4.5,0.002,1e-27],)"
            "\"string\":\"\u20ac$\\u000f\\nA'B\\\"\\\\\\\\\\\"/\"}");
  EXPECT_EQ(canonical(R"({"\u20ac":"Euro Sign","\r":"Carriage Return",
    "\ufb33":"Hebrew Letter Dalet With Dagesh","1":"One","\ud83d\ude00":"Emoji: Grinning Face",
    "\u0080":"Control","\u00f6":"Latin Small Letter O With Diaeresis"})"),
            "{\"\\r\":\"Carriage Return\",\"1\":\"One\",\"\u0080\":\"Control\","
            "\"\u00f6\":\"Latin Small Letter O With Diaeresis\",\"\u20ac\":\"Euro Sign\","
            "\"\U0001F600\":\"Emoji: Grinning Face\","
            "\"\uFB33\":\"Hebrew Letter Dalet With Dagesh\"}");
}

// Appendix B, and the ends of the ranges in which numbers are laid out alike.
TEST(CanonicalJson, HasTheNumbersOfTheRfc) {
  for (const auto& [given, printed] : {std::pair{"0", "0"},
                                       {"-0.0", "0"},
                                       {"4.9406564584124654e-324", "5e-324"},
                                       {"-4.9406564584124654e-324", "-5e-324"},
                                       {"1.7976931348623157e308", "1.7976931348623157e+308"},
                                       {"9007199254740992", "9007199254740992"},
                                       {"295147905179352825856", "295147905179352830000"},
                                       {"9.999999999999997e22", "9.999999999999997e+22"},
                                       {"1e23", "1e+23"},
                                       {"999999999999999900000", "999999999999999900000"},
                                       {"1e21", "1e+21"},
                                       {"9.999999999999997e-7", "9.999999999999997e-7"},
                                       {"0.000001", "0.000001"},
                                       {"-0.0000033333333333333333", "-0.0000033333333333333333"},
                                       {"333333333.33333325", "333333333.33333325"},
                                       {"1424953923781206.25", "1424953923781206.2"},
                                       {"10", "10"},
                                       {"-12.5", "-12.5"}})
    EXPECT_EQ(canonical(std::string(R"({"n":)") + given + "}"),
              std::string(R"({"n":)") + printed + "}");
}

TEST(CanonicalJson, IsTheSameHoweverItWasLaidOut) {
  EXPECT_EQ(canonical(R"({"b":{"y":1.0,"x":[ {} , [] ]},"a":"\u00e4"})"),
            canonical("{ \"a\" : \"\u00e4\",\n \"b\" : {\"x\":[{},[]], \"y\":1e0} }"));
}

}  // namespace
}  // namespace trc::wire
