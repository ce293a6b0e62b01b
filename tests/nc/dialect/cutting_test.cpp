#include <gtest/gtest.h>

#include <random>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "tests/nc/dialect/reading.h"

namespace trc::testing {
namespace {

// Blocks, lines and diagnostics of a reading as one text.
std::string transcript(const Reading& reading) {
  std::string text;
  const auto add = [&](const auto& value) { text.append(std::to_string(value)).append(" "); };
  for (const Block& block : reading.blocks) {
    if (const auto* motion = std::get_if<MotionBlock>(&block)) {
      add(motion->source.index);
      add(motion->source.line);
      add(motion->source.number);
      add(end_of(motion->path).x());
      add(end_of(motion->path).y());
    } else {
      text.append(std::get<PassiveBlock>(block).text).append(" ");
    }
  }
  for (const ProgramLine& line : reading.lines) {
    text.append(line.text).append("|").append(line.line_end);
    for (const WordRange& word : line.words) add(word.begin);
    add(line.source.line);
  }
  for (const Diagnostic& reported : reading.diagnostics)
    text.append(place_and_code(reported)).append(message_of(reported));
  return text;
}

constexpr const char* program =
    "\xEF\xBB\xBF%name (\xC3\xA4)\r\n"
    "N10 G00 X10.125 Y-.5 ; \xE2\x82\xAC\r\n"
    "\r\n"
    "N20 #TRC [ REVERSE = 1 STRETCH_FACTOR=2 ] (on)\n"
    "N30 V.G.WZ_AKT.R = 2.5\r"
    "\r"
    "N40 G41 G01 X20 \\\r\n"
    "N50 Y7 F100 M8\r\n"
    "#COMMENT BEGIN\n"
    "X[1\n"
    "#COMMENT END\n"
    "X30\n"
    "G40 X40\r\n"
    "M30\r\n"
    "rest";

TEST(Cutting, AnyPieceSizeReadsTheSame) {
  const Reading whole = read(program);
  ASSERT_TRUE(whole.diagnostics.empty()) << message_of(whole.diagnostics[0]);
  EXPECT_EQ(whole.text(), program);
  EXPECT_EQ(whole.motions().size(), 4U);
  for (std::size_t piece = 1; piece < 40; ++piece)
    EXPECT_EQ(transcript(read(program, {}, piece)), transcript(whole)) << piece;
}

TEST(Cutting, AFaultIsTheSameWhereverTheTextIsCut) {
  for (const char* text : {"X1\nG01 X", "X1\r\n#TRC[", "X1\n; \xC3", "X1\nX2\\", "X1\r",
                           "G01 X1\n\xEF\xBB", "\xEF\xBB", "\xEF\xBB\xBF", "X1 \\\r\nX2"}) {
    const std::string whole = transcript(read(text));
    for (std::size_t piece = 1; piece < 8; ++piece)
      EXPECT_EQ(transcript(read(text, {}, piece)), whole) << text << " " << piece;
  }
}

TEST(Cutting, RandomTextReadsTheSameInAnyPieces) {
  constexpr unsigned seed = 4711;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  constexpr std::string_view bytes = "GXYNM0123456789.-= \\\r\n\n\n()[];#TRCF%\xC3\xA4\xEF";
  std::uniform_int_distribution<std::size_t> pick(0, bytes.size() - 1);
  for (int i = 0; i < 3000; ++i) {
    std::string text(random() % 120, ' ');
    for (char& byte : text) byte = bytes[pick(random)];
    const std::string whole = transcript(read(text));
    const std::size_t piece = 1 + random() % 13;
    ASSERT_EQ(transcript(read(text, {}, piece)), whole) << text << "\npiece " << piece;
  }
}

TEST(Junk, AnyBytesGiveAtMostOneErrorAndNoCrash) {
  constexpr unsigned seed = 99;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text(random() % 200, ' ');
    for (char& byte : text) byte = static_cast<char>(random());
    const Reading reading = read(text);
    refused += reading.stopped ? 1 : 0;
    const auto errors = std::ranges::count_if(reading.diagnostics, [](const Diagnostic& reported) {
      return reported.severity == Severity::error;
    });
    EXPECT_LE(errors, 1);
  }
  EXPECT_GT(refused, 2900);
}

TEST(Junk, AChangedProgramNeverCrashes) {
  constexpr unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const std::string original = program;
  int accepted = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string text = original;
    for (int change = 0; change < 3; ++change) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, random() % 8);
          break;
        default:
          text.insert(at, original.substr(random() % original.size(), random() % 12));
      }
      if (text.empty()) text += ' ';
    }
    const Reading reading = read(text, {}, 1 + random() % 50);
    if (reading.stopped) continue;
    ++accepted;
    EXPECT_EQ(reading.text(), text);
  }
  EXPECT_GT(accepted, 50);
}

TEST(LongLines, AreRefusedBeforeTheyAreStored) {
  Diagnostics diagnostics;
  std::vector<Block> blocks;
  std::vector<LinePointer> lines;
  ProgramState state({}, {}, diagnostics, blocks);
  Interpreter interpreter({}, state, diagnostics);
  const std::string piece(1000, 'X');
  int pieces = 0;
  while (pieces < 10'000 && interpreter.feed(piece, lines)) ++pieces;
  EXPECT_EQ(pieces, 65) << "64 KiB";
  ASSERT_EQ(diagnostics.pending().size(), 1U);
  EXPECT_EQ(diagnostics.pending()[0].code, Code::nc_line_too_long);
  EXPECT_FALSE(interpreter.feed("G00 X1\n", lines));
}

TEST(LongLines, TheLimitCountsContinuedLinesTogether) {
  const std::string text = "G01 \\\nX1 \\\nY2\n";
  EXPECT_TRUE(read(text, {}, 0, {.longest_line = 16}).diagnostics.empty());
  EXPECT_EQ(read(text, {}, 0, {.longest_line = 12}).code(), Code::nc_line_too_long);
  EXPECT_EQ(read(text, {}, 3, {.longest_line = 12}).code(), Code::nc_line_too_long);
}

TEST(LongLines, ManyContinuedLinesAreOneBlockLikeAnyOther) {
  std::string text = "G01 ";
  for (int line = 0; line < 30'000; ++line) text += "\\\n";
  text += "X1";
  const Reading whole = read(text);
  EXPECT_EQ(whole.motions().size(), 1U);
  EXPECT_EQ(whole.text(), text);
  EXPECT_EQ(transcript(read(text, {}, 1)), transcript(whole));
}

TEST(LongLines, OnlyTheLineCountsNotTheText) {
  std::string text;
  for (int i = 0; i < 1000; ++i)
    text.append("X").append(std::to_string(i)).append(" (some comment)\n");
  EXPECT_TRUE(read(text, {}, 0, {.longest_line = 32}).diagnostics.empty());
}

}  // namespace
}  // namespace trc::testing
