#include <gtest/gtest.h>

#include "client/load/sample_program.h"
#include "core/messages/diagnostic_text.h"
#include "core/session/program_session.h"
#include "core/verify/clearance.h"

namespace trc::load {
namespace {

std::string program_of(const ShapeRequest& request) {
  std::string text;
  EXPECT_EQ(generate(request,
                     [&](std::string_view piece) {
                       text += piece;
                       return true;
                     }),
            "");
  return text;
}

std::uint64_t count_of(const std::string& text, const std::string& word) {
  std::uint64_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(Shapes, HaveAsManyContourBlocksAsAsked) {
  for (const ShapeRow& row : shapes())
    for (const std::uint64_t blocks : {1U, 2U, 61U, 2500U}) {
      SCOPED_TRACE(std::string(row.name) + " " + std::to_string(blocks));
      const std::string text = program_of({.shape = std::string(row.name), .blocks = blocks});
      // Beside the contour there are approach and retract.
      EXPECT_EQ(count_of(text, " G01 ") + count_of(text, " G02 ") + count_of(text, " G03 "),
                blocks + 2);
    }
}

TEST(Shapes, AreTheSameForTheSameSeed) {
  const ShapeRequest request{.shape = "random", .blocks = 200, .seed = 7};
  EXPECT_EQ(program_of(request), program_of(request));
  ShapeRequest other = request;
  other.seed = 8;
  EXPECT_NE(program_of(request), program_of(other));
}

TEST(Shapes, CanBeCompensatedWithoutAViolation) {
  for (const ShapeRow& row : shapes())
    for (const std::uint64_t seed : {1U, 2U, 3U})
      for (const std::uint64_t blocks : {1U, 5U, 40U, 1200U}) {
        SCOPED_TRACE(std::string(row.name) + " seed " + std::to_string(seed) + " blocks " +
                     std::to_string(blocks));
        const std::string text =
            program_of({.shape = std::string(row.name), .blocks = blocks, .seed = seed});
        ProgramSession session({.nc_text = false});
        Answers output;
        EXPECT_TRUE(session.feed(text, output) && session.finish(output));
        for (const Diagnostic& diagnostic : output.take().diagnostics)
          ADD_FAILURE() << static_cast<int>(diagnostic.code) << ": " << message_of(diagnostic);
        EXPECT_GE(session.summary().blocks_out, blocks);
      }
}

TEST(Shapes, RefuseWhatTheyDoNotKnowOrCannotHold) {
  const auto ignore = [](std::string_view) { return true; };
  EXPECT_NE(generate({.shape = "cube"}, ignore), "");
  EXPECT_NE(generate({.shape = "spiral", .blocks = 10'000'000}, ignore), "");
  EXPECT_NE(generate({.shape = "meander", .blocks = 13'000'000}, ignore), "");
}

}  // namespace
}  // namespace trc::load
