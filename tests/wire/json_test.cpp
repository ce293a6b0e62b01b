#include "proto/wire/json.h"

#include <gtest/gtest.h>

#include <string>

#include "core/messages/sentences.h"
#include "proto/wire/setting_sentences.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::wire {
namespace {

std::string fault_of(const std::string& json) {
  v1::PreviewPathRequest path;
  return Json().read(json, path);
}

TEST(JsonFault, NamesTheFieldAndWhatItTakes) {
  EXPECT_EQ(fault_of(R"({"nix":{}})"), "nix: there is no such field");
  EXPECT_EQ(fault_of(R"({"setup":{"options":{"revers":true}}})"),
            "setup.options.revers: there is no such field; did you mean reverse?");
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":"5,5"}})"),
            "setup.tool_radius: \"5,5\" is not possible; it takes a number");
  EXPECT_EQ(fault_of(R"({"setup":{"lookAheadBlocks":1.5}})"),
            "setup.look_ahead_blocks: 1.5 is not possible; it takes a whole number");
  EXPECT_EQ(fault_of(R"({"setup":{"implicitContourMasking":"maybe"}})"),
            "setup.implicit_contour_masking: \"maybe\" is not possible; it takes true or false");
  EXPECT_EQ(fault_of(R"({"setup":{"plane":"XY"}})"),
            "setup.plane: \"XY\" is not possible; it takes PLANE_UNSPECIFIED, PLANE_XY, PLANE_ZX, "
            "PLANE_YZ");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":5}]}})"),
            "batch.blocks[0].linear: 5 is not possible; it takes an object in { }");
  EXPECT_EQ(fault_of(R"({"setup":[1]})"), "setup: it takes one value, no list");
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":{}}})"),
            "setup.tool_radius: it takes one value, no object");
  EXPECT_EQ(fault_of("[]"), "it must be an object in { }");
}

TEST(JsonFault, NamesTheFieldThatIsMeant) {
  EXPECT_EQ(fault_of(R"({"setop":{}})"), "setop: there is no such field; did you mean setup?");
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadus":5}})"),
            "setup.toolRadus: there is no such field; did you mean toolRadius?");
  EXPECT_EQ(fault_of(R"({"setup":{"tool_radus":5}})"),
            "setup.tool_radus: there is no such field; did you mean tool_radius?");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{},{"linear":{"end":{"x":1},"fed":100}}]}})"),
            "batch.blocks[1].linear.fed: there is no such field; did you mean feed?");
  v1::ProgramSetup setup;
  EXPECT_EQ(Json().read(R"({"subprogramms":{}})", setup),
            "subprogramms: there is no such field; did you mean subprograms?");
}

// Which of two values holds nobody can say, and two lists would be one.
// The path to the innermost would take half a terabyte to write out at each depth.
TEST(JsonFault, OfAMillionBracketsIsFoundAtOnce) {
  EXPECT_NE(fault_of(R"({"setup":)" + std::string(1'000'000, '[')), "");
  EXPECT_NE(fault_of(std::string(1'000'000, '[') + std::string(1'000'000, ']')), "");
}

TEST(JsonFault, NamesWhatIsGivenTwice) {
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":5},"setup":{"wear":1}})"),
            "setup: is given more than once");
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":5,"toolRadius":5}})"),
            "setup.tool_radius: is given more than once");
  EXPECT_EQ(fault_of(R"({"setup":{"tool_radius":5,"wear":0,"tool\u0052adius":6}})"),
            "setup.tool_radius: is given more than once");
  EXPECT_EQ(fault_of(R"({"setup":{"startPosition":{"x":1},"start_position":{"y":1}}})"),
            "setup.start_position: is given more than once");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{}}],"blocks":[{"linear":{}}]}})"),
            "batch.blocks: is given more than once");
  EXPECT_EQ(
      fault_of(R"({"batch":{"blocks":[{"linear":{}},{"linear":{"end":{"x":1,"y":2,"x":3}}}]}})"),
      "batch.blocks[1].linear.end.x: is given more than once");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{},"circular":{}}]}})"),
            "batch.blocks[0]: it takes one of its kinds, not two");
  EXPECT_EQ(fault_of(R"({"batch":{},"columns":{}})"), "it takes one of batch, columns, not two");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{"end":{"x":1}}},{"linear":{}}]}})"), "");
}

// Protobuf reads what stands before the NUL, and numbers in base 16.
TEST(JsonFault, NamesANumberInQuotesThatIsNone) {
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":"1\u00002"}})"),
            R"(setup.tool_radius: "1\u00002" is not possible; it takes a number)");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{},{"linear":{"end":{"x":1,"y":"0x10"}}}]}})"),
            R"(batch.blocks[1].linear.end.y: "0x10" is not possible; it takes a number)");
  EXPECT_EQ(fault_of(R"({"columns":{"x":[1,"2","+3"]}})"),
            R"(columns.x[2]: "+3" is not possible; it takes a number)");
  for (const char* const none : {"", " 1", "1 ", "1,5", "nan", "inf", "1_0", "\\u0031", "0x1p4"})
    EXPECT_NE(fault_of(R"({"setup":{"toolRadius":")" + std::string(none) + "\"}}"), "") << none;
  for (const char* const number : {"1", "-1.5", "1e-3", "1E3", ".5", "5.", "NaN", "-Infinity"})
    EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":")" + std::string(number) + "\"}}"), "") << number;
  EXPECT_EQ(fault_of(R"({"setup":{"clientTag":"0x10","plane":"PLANE_XY"}})"), "");
  v1::ProgramSetup setup;
  EXPECT_EQ(Json().read(R"({"variables":{"#1":"1","#2":"0x10"}})", setup),
            R"(variables.#2: "0x10" is not possible; it takes a number)");
  EXPECT_EQ(Json().read(R"({"subprograms":{"A":"0x10"},"fileName":"0x1"})", setup), "");
}

// Protobuf would leave it out, and the path would miss a block.
TEST(JsonFault, NamesWhatAListCannotHold) {
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{}},null,{"linear":{}}]}})"),
            "batch.blocks[1]: is null, where a list has values");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{}},[{"linear":{}}]]}})"),
            "batch.blocks[1]: is a list within a list");
  EXPECT_EQ(fault_of("{'setup':{}}"), "' stands where JSON has \"");
  EXPECT_EQ(fault_of(R"({"setup":{"clientTag":"a'null"}})"), "");
}

// Pages write a number that is none as null, and Protobuf takes it for one that was not given: a
// contour without its tool radius.
TEST(JsonFault, NamesWhatIsNull) {
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":null}})"),
            "setup.tool_radius: is null; give it a value or leave it out");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{"end":{"x":1,"y": null}}}]}})"),
            "batch.blocks[0].linear.end.y: is null; give it a value or leave it out");
  EXPECT_EQ(fault_of(R"({"setup":null})"), "setup: is null; give it a value or leave it out");
  EXPECT_EQ(fault_of(R"({"setup":{"clientTag":"null"}})"), "");
}

// Protobuf takes them, and would take the second of two names though only one has quotes.
TEST(JsonFault, NamesWhatIsNoJson) {
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":5, tool_radius:6}})"),
            "setup: a name has no quotes");
  EXPECT_EQ(fault_of("{setup:{}}"), "a name has no quotes");
  EXPECT_EQ(fault_of(R"({"setup":{"toolRadius":5,}})"), "setup: a comma stands before }");
  EXPECT_EQ(fault_of(R"({"batch":{"blocks":[{"linear":{}}, ]}})"),
            "batch.blocks: a comma stands before ]");
  EXPECT_EQ(fault_of("{\"setup\" : {} , }"), "a comma stands before }");
  EXPECT_EQ(fault_of(" { \"setup\" :\t{ } }\n"), "");
}

TEST(JsonFault, NamesOfAMapAreWhatTheyAre) {
  v1::ProgramSetup setup;
  EXPECT_EQ(Json().read(R"({"variables":{"a_b":1,"aB":2,"\\":3,"\"":4,"[":5}})", setup), "");
  EXPECT_EQ(setup.variables().size(), 5);
  EXPECT_EQ(Json().read(R"({"variables":{"a_b":1,"a_b":2}})", setup),
            "variables.a_b: is given more than once");
}

TEST(JsonFault, NamesThePlaceInTheText) {
  EXPECT_EQ(fault_of(""), "the text ends too early");
  EXPECT_EQ(fault_of("{\n  \"setup\": {\"toolRadius\" 5}\n}"),
            "line 2, column 26: a colon is expected after the name");
  EXPECT_EQ(fault_of("{\"setup\":{\"toolRadius\":5,5}}"),
            "line 1, column 26: the name of a field in quotes, or } is expected");
  EXPECT_EQ(fault_of("{\"setup\":{\"toolRadius\":tru}}"), "line 1, column 24: this is no value");
  EXPECT_EQ(fault_of("{} x"), "line 1, column 4: something stands after the end");
  // What stands there more than once is shown.
  const std::string block = R"({"linear":{"end":{"x":1 "y":2},"feed":100}})";
  const std::string list = block + "," + block + "," + block;
  const std::string fault = fault_of(R"({"batch":{"blocks":[)" + list + "]}}");
  EXPECT_EQ(fault.rfind("at \"y\":2}", 0), 0U) << fault;
}

TEST(JsonFault, IsThereInGerman) {
  for (const char* json : {R"({"nix":{}})",
                           R"({"setop":{}})",
                           R"({"setup":{"toolRadius":"5,5"}})",
                           R"({"setup":{"plane":{}}})",
                           "[]",
                           "",
                           "{\"setup\":{\"toolRadius\" 5}}",
                           "{\"setup\":{5}}",
                           "{} x",
                           R"({"setup":[1]})",
                           "{\"setup\":{\"toolRadius\":5 6}}",
                           "{\"setup\":{\"toolRadius\":-}}",
                           R"({"setup":{"clientTag":"\uzz"}})",
                           R"({"setup":{"clientTag":"a)",
                           R"({"setup":{},"setup":{}})",
                           R"({"batch":{"blocks":[null]}})",
                           R"({"batch":{"blocks":[[]]}})",
                           "{'setup':{}}",
                           R"({"batch":{"blocks":[{"linear":{},"circular":{}}]}})",
                           R"({"batch":{},"columns":{}})"}) {
    const std::string english = fault_of(json);
    const std::string german = translated(english, {setting_sentences()});
    EXPECT_NE(german, english) << json;
    for (const char* word : {"the ", " is ", " no ", "takes", "expected", "line ", "mean"})
      EXPECT_EQ(german.find(word), std::string::npos) << german;
  }
}

}  // namespace
}  // namespace trc::wire
