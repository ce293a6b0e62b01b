#include <gtest/gtest.h>

#include <string>

#include "tests/programs/computing.h"

// Feeds of Klartext whose values only the control knows (FQ5, FZ0.1, M136), and what acts at the
// end of a block that becomes several.

namespace trc::support::klartext_feeds {
namespace {

ProgramRun run(const std::string& text) {
  return to_text("BEGIN PGM A MM\nTOOL CALL 5 Z S1000\n" + text + "END PGM A MM\n",
                 computing_setup(DialectName::heidenhain, 5));
}

std::string text_of(const std::string& text) {
  const ProgramRun ran = run(text);
  return ran.stopped ? ran.report() : ran.text;
}

// The first line that begins so, without its places.
std::string feed_of_line(const std::string& text, std::size_t number) {
  std::size_t begin = 0;
  for (; number > 0 && begin != std::string::npos; --number) begin = text.find('\n', begin) + 1;
  const std::string line = text.substr(begin, text.find('\n', begin) - begin);
  const std::size_t feed = line.find(" F");
  return feed == std::string::npos ? ""
                                   : line.substr(feed + 1, line.find(' ', feed + 1) - feed - 1);
}

// The feeds of all lines from the first selection on, by their words; a line without one has none.
std::string feeds_of(const std::string& text, const std::string& from) {
  std::string feeds;
  std::size_t at = text.find(from);
  for (std::size_t number = 0; at != std::string::npos && at < text.size(); ++number) {
    const std::size_t end = text.find('\n', at);
    const std::string feed = feed_of_line(text.substr(at, end - at), 0);
    feeds += (number > 0 ? "," : "") + feed;
    at = end == std::string::npos ? end : end + 1;
  }
  return feeds;
}

const std::string plunge = "Q5 = 100\nL X-20 Y-20 R0 FMAX\nL Z-5 F2000\n";
const std::string contour = "L Y+40\nL X+40\nDEP LT LEN10\nL Z+50 FMAX M30\n";

// The way to the lead has the feed before it, but for LCT (D-86).
TEST(KlartextFeeds, OfAnApproachHoldOnTheContour) {
  for (const std::string feed : {"FQ5", "FU0.2", "FZ0.2", "F100"}) {
    EXPECT_EQ(
        feeds_of(text_of(plunge + "APPR LCT X+0 Y+0 R5 RL " + feed + "\n" + contour), "L Z-5"),
        "F2000," + feed + ",,,,,,,,FMAX,");
    EXPECT_EQ(
        feeds_of(text_of(plunge + "APPR LT X+0 Y+0 LEN9 RL " + feed + "\n" + contour), "L Z-5"),
        "F2000,F2000," + feed + ",,,,,,FMAX,");
    EXPECT_EQ(feeds_of(text_of("L X-20 Y-20 R0 FMAX\nAPPR CT X+0 Y+0 CCA90 R9 RL " + feed + "\n" +
                               contour),
                       "L X-20"),
              "FMAX,FMAX,," + feed + ",,,,,,FMAX,");
  }
}

TEST(KlartextFeeds, OfACornerHoldThereAlone) {
  EXPECT_EQ(text_of("Q5 = 100\nL X-20 Y-20 R0 FMAX\nL X+0 Y+0 RL FQ5\nL Y+40\nRND R6 F800\n"
                    "L X+40\nL Y+0\nL X-6\nL X-20 Y-20 R0\n"),
            "BEGIN PGM A MM\nTOOL CALL 5 Z S1000\nQ5 = 100\nL X-20 Y-20 R0 FMAX\nL X-5 Y+0 FQ5\n"
            "L X-5 Y+34\nCC X+6 Y+34\nC X+6 Y+45 DR- F800\nL X+40 Y+45 FQ5\nCC X+40 Y+40\n"
            "C X+45 Y+40 DR-\nL X+45 Y+0\nCC X+40 Y+0\nC X+40 Y-5 DR-\nL X-6 Y-5\nL X-20 Y-20\n"
            "END PGM A MM\n");
}

int refusal(const std::string& text) {
  const ProgramRun ran = run(text);
  return ran.stopped ? static_cast<int>(ran.diagnostics.front().code) : 0;
}

TEST(KlartextFeeds, AreNotAdaptedWhereTheyAreNotKnown) {
  const std::string end = "L Y+40\nL X+40\nCR X+60 Y+20 R+20 DR+\nL Y+0\nL X-6\nL X-20 Y-20 R0\n";
  const std::string start = "L X-20 Y-20 R0 FMAX\n";
  EXPECT_EQ(refusal(start + "L X+0 Y+0 RL F100 M109\n" + end), 0);
  EXPECT_EQ(refusal(start + "L X+0 Y+0 RL FQ5 M109\n" + end), 900003);
  EXPECT_EQ(refusal(start + "L X+0 Y+0 RL FU0.2 M110\n" + end), 900003);
  EXPECT_EQ(refusal(start + "L X+0 Y+0 RL FQ5\nM109\n" + end), 900003);
  EXPECT_EQ(refusal("L Z+5 FQ5\n" + start + "L X+0 Y+0 RL M109\n" + end), 900003);
  EXPECT_EQ(refusal("M136\n" + start + "L X+0 Y+0 RL F0.2 M109\n" + end), 900003);
  EXPECT_EQ(
      refusal("M136\n" + start + "L X+0 Y+0 RL F0.2\nL Y+40\nRND R6 F0.1\nL X+40\nL X-20 R0\n"),
      900003);
  EXPECT_EQ(refusal(start + "APPR LT X+0 Y+0 LEN9 RL FT5\n" + end), 900003);
  EXPECT_EQ(refusal("M109\n" + start + "APPR LCT X+0 Y+0 R5 RL FZ0.1\n" + end), 900003);
}

// After a call the feed is whatever the called lines have said last.
TEST(KlartextFeeds, OfACornerWantTheOneBefore) {
  const std::string start = "L X-20 Y-20 R0 FMAX\n";
  const std::string corner = "L Y+40\nRND R6 F800\nL X+40\nL Y+0\nL X-6\nL X-20 Y-20 R0\n";
  const std::string end = "M30\nLBL 1\nL Z+5 F300\nLBL 0\n";
  for (const std::string call : {"CALL LBL 1\n", "CALL PGM K\n"}) {
    const std::string behind = "L Z+2 R0 F150\n" + call + start;
    EXPECT_EQ(refusal(behind + "L X+0 Y+0 RL\n" + corner + end), 900003);
    EXPECT_EQ(refusal(behind + "L X+0 Y+0 RL F200\n" + corner + end), 0);
    EXPECT_EQ(refusal("L Z+2 R0 FQ5\n" + call + start + "L X+0 Y+0 RL\n" + corner + end), 900003);
  }
  EXPECT_EQ(refusal("L Z+2 R0 F150\n" + start + "L X+0 Y+0 RL\n" + corner), 0);
  // A coordinate that only the control knows says nothing of the feed.
  const std::string known = text_of("L X+Q9 R0 F150\n" + start + "L X+0 Y+0 RL\n" + corner);
  EXPECT_NE(known.find("L X+40 Y+45 F150\n"), std::string::npos) << known;
  EXPECT_EQ(refusal("L Z+2 R0 FQ5\n" + start + "L X+0 Y+0 RL\n" + corner), 0);
}

// What acts at the end of its block comes after the last part of it.
TEST(KlartextLeads, StopSpindleAndCoolantAfterThem) {
  EXPECT_EQ(text_of("L X-20 Y-20 R0 FMAX\nAPPR LCT X+0 Y+0 R5 RL F100 M8\nL Y+40\nL X+40\n"
                    "DEP LCT X+60 Y+60 R5 F900 M5\nL Z+50 FMAX M30\n"),
            "BEGIN PGM A MM\nTOOL CALL 5 Z S1000\nL X-20 Y-20 R0 FMAX\n"
            "L X-6.14110106 Y-3.17944947 F100 M8\nCC X-10 Y+0\nC X-5 Y+0 DR+\nL X-5 Y+40\n"
            "CC X+0 Y+40\nC X+0 Y+45 DR-\nL X+40 Y+45\nCC X+40 Y+50\n"
            "C X+43.17944947 Y+46.14110106 DR+ F900\nL X+60 Y+60\nM5\nL Z+50 FMAX M30\n"
            "END PGM A MM\n");
}

}  // namespace
}  // namespace trc::support::klartext_feeds
