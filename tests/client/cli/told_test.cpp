#include <gtest/gtest.h>

#include <string>

#include "client/cli/speech.h"

namespace trc::cli {
namespace {

// Switches messages to German for one test.
class Told : public ::testing::Test {
 protected:
  void SetUp() override { speak(Language::german); }
  void TearDown() override { speak(Language::english); }
};

TEST_F(Told, FillsTheGapsOfASentence) {
  EXPECT_EQ(told("cannot read part.nc: No such file or directory"),
            "part.nc lässt sich nicht lesen: die Datei oder das Verzeichnis gibt es nicht");
  EXPECT_EQ(told("there is no command compensat; did you mean compensate?"),
            "es gibt keinen Befehl compensat; ist compensate gemeint?");
  EXPECT_EQ(told("--format: nc2 not in {jsonl,listing,nc}"),
            "--format: nc2 gehört nicht zu {jsonl,listing,nc}");
}

TEST_F(Told, TellsWhatStandsInAGapToo) {
  EXPECT_EQ(told("--set: path.tool_radius: \"x\" is not possible; it takes a number"),
            "--set: path.tool_radius: \"x\" ist nicht möglich; es nimmt eine Zahl");
  EXPECT_EQ(told("--tools: t.csv: line 3: tool 5 a second time"),
            "--tools: t.csv: Zeile 3: Werkzeug 5 ein zweites Mal");
}

// "{} programs" would fit as well.
TEST_F(Told, TakesTheSentenceThatSaysMost) {
  EXPECT_EQ(told("the server at box:5 is there, but shuts down and takes no new programs"),
            "der Server box:5 ist da, fährt aber herunter und nimmt keine neuen Programme");
  EXPECT_EQ(told("3 programs"), "3 Programme");
}

TEST_F(Told, WhyAWordDoesNotPass) {
  EXPECT_EQ(told("pass_words[0]: \"G1\" is known"), "pass_words[0]: \"G1\" ist bekannt");
}

TEST_F(Told, LeavesWhatItDoesNotKnow) {
  EXPECT_EQ(told("the server is out of order"), "the server is out of order");
  EXPECT_EQ(told(""), "");
}

TEST(ToldInEnglish, LeavesEverySentence) {
  EXPECT_EQ(told("cannot read part.nc"), "cannot read part.nc");
}

}  // namespace
}  // namespace trc::cli
