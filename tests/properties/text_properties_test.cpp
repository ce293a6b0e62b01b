#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "tests/support/program_run.h"
#include "tests/support/run.h"

// What must hold for every program, on random contours written as NC text.

namespace trc::support {
namespace {

constexpr std::uint64_t programs = 150;

struct Spelling {
  double millimetres_per_unit = 1;
  bool absolute_center = true;
  bool negative_radius = false;  // the other side with a negative radius
  bool crlf = false;
  bool lower_case = false;
};

class ProgramText {
 public:
  explicit ProgramText(const Spelling& spelling) : spelling_(spelling) {
    text_ << std::setprecision(17);
  }

  void line(const std::string& words) { text_ << words << (spelling_.crlf ? "\r\n" : "\n"); }

  void block(const std::string& head, const Segment& segment) {
    std::ostringstream words;
    words << std::setprecision(17) << std::fixed << head;
    if (const auto* straight = std::get_if<Line>(&segment)) {
      words << "G01" << axes(" X", " Y", straight->end);
    } else {
      const auto& arc = std::get<Arc>(segment);
      const Point center = spelling_.absolute_center ? arc.center : Point(arc.center - arc.start);
      words << (arc.sweep > 0 ? "G03" : "G02") << axes(" X", " Y", arc.end)
            << axes(" I", " J", center);
    }
    line(words.str());
  }

  [[nodiscard]] std::string take() const {
    std::string text = text_.str();
    if (spelling_.lower_case)
      for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  }

 private:
  [[nodiscard]] std::string axes(const char* first, const char* second, const Point& point) const {
    std::ostringstream words;
    words << std::setprecision(15) << std::fixed << first
          << point.x() / spelling_.millimetres_per_unit << second
          << point.y() / spelling_.millimetres_per_unit;
    return words.str();
  }

  Spelling spelling_;
  std::ostringstream text_;
};

std::string program_of(const Contour& contour, const TrcMode& mode, const Spelling& spelling) {
  static constexpr const char* selections[] = {"G138", "G139", "G236", "G237", "G238", "G239"};
  ProgramText text(spelling);
  text.line("%RANDOM");
  text.line(spelling.millimetres_per_unit == 1 ? "G71" : "G70");
  text.line(spelling.absolute_center ? "G161" : "G162");
  text.line(selections[static_cast<int>(mode.selection)]);
  text.line(mode.transition == Transition::linear ? "G25" : "G26");
  std::ostringstream words;
  words << std::setprecision(15) << std::fixed
        << "#TRC[STRETCH_FACTOR=" << mode.options.stretch_factor << "]";
  text.line(words.str());
  words.str("");
  words << "V.G.WZ_AKT.R = "
        << (spelling.negative_radius ? -1 : 1) * mode.tool_radius / spelling.millimetres_per_unit;
  text.line(words.str());
  text.block("N1 F1000 ", Line{.start = Point::Zero(), .end = contour.approach.start});
  const bool left = (mode.side == Side::left) != spelling.negative_radius;
  text.block(left ? "N2 G41 " : "N2 G42 ", contour.approach);
  for (const Segment& block : contour.blocks) text.block("", block);
  text.block("G40 ", contour.retract);
  text.line("M30");
  return text.take();
}

template <class Claim>
void for_each_program(std::uint64_t first_seed, const Claim& claim) {
  for (const Flavor flavor : all_flavors)
    for (std::uint64_t k = 0; k < programs && !::testing::Test::HasFailure(); ++k) {
      const std::uint64_t seed = first_seed + 100'000 * static_cast<std::uint64_t>(flavor) + k;
      Random random(seed);
      const TrcMode mode = random_mode(random);
      const Contour contour = random_contour(random, flavor, mode, 7);
      // Rewriting a contour moves it by some 1e-13 mm.
      if (slow_trc(contour, mode).borderline) continue;
      std::ostringstream story;
      story << "seed " << seed << ", " << name_of(flavor) << ", " << text_of(mode) << '\n'
            << contour;
      SCOPED_TRACE(story.str());
      claim(contour, mode);
    }
}

void expect_same_path(const Outcome& actual, const Outcome& expected) {
  ASSERT_EQ(actual.stopped, expected.stopped)
      << (actual.stopped ? message_of(*actual.error()) : message_of(*expected.error()));
  if (actual.stopped) {
    EXPECT_EQ(actual.error()->code, expected.error()->code);
  }
  EXPECT_EQ(difference(actual.blocks, expected.blocks, Motion{}, 2e-4), "");
}

TEST(EveryProgram, IsTheSameInInchAndInMillimetres) {
  for_each_program(1, [](const Contour& contour, const TrcMode& mode) {
    const std::string metric = program_of(contour, mode, {});
    const std::string inch = program_of(contour, mode, {.millimetres_per_unit = 25.4});
    expect_same_path(to_blocks(inch), to_blocks(metric));
  });
}

TEST(EveryProgram, IsTheSameWithAbsoluteAndRelativeCenters) {
  for_each_program(2'000'000, [](const Contour& contour, const TrcMode& mode) {
    const std::string absolute = program_of(contour, mode, {});
    const std::string relative = program_of(contour, mode, {.absolute_center = false});
    expect_same_path(to_blocks(relative), to_blocks(absolute));
  });
}

TEST(EveryProgram, RunsOnTheOtherSideWithANegativeRadius) {
  for_each_program(4'000'000, [](const Contour& contour, const TrcMode& mode) {
    const std::string positive = program_of(contour, mode, {});
    const std::string negative = program_of(contour, mode, {.negative_radius = true});
    const ProgramRun expected = to_blocks(positive);
    const ProgramRun actual = to_blocks(negative);
    ASSERT_EQ(actual.stopped, expected.stopped);
    EXPECT_EQ(difference(actual.blocks, expected.blocks, Motion{}, 0), "");
  });
}

TEST(EveryProgram, IsTheSameHoweverItsTextIsCutAndSpelt) {
  for_each_program(6'000'000, [](const Contour& contour, const TrcMode& mode) {
    const std::string text = program_of(contour, mode, {});
    const ProgramRun whole = to_blocks(text);
    for (const std::size_t piece : {1U, 3U, 17U}) {
      const ProgramRun pieces = to_blocks(text, {}, piece);
      EXPECT_EQ(text_of(pieces.blocks), text_of(whole.blocks)) << piece << " bytes at a time";
      EXPECT_EQ(pieces.diagnostics.size(), whole.diagnostics.size());
    }
    const std::string spelt = program_of(contour, mode, {.crlf = true, .lower_case = true});
    EXPECT_EQ(text_of(moving(to_blocks(spelt, {}, 11).blocks)), text_of(moving(whole.blocks)));
  });
}

TEST(EveryProgram, GivesThePathOfItsBlocks) {
  for_each_program(8'000'000, [](const Contour& contour, const TrcMode& mode) {
    const std::string text = program_of(contour, mode, {});
    ProgramRun read = to_blocks(text);
    Feeding feeding;
    feeding.compensator.leads.input_resolution = LeadSettings{}.input_resolution;
    Outcome given = compensate(contour, mode, feeding);
    ASSERT_EQ(read.stopped, given.stopped);
    std::vector<CompensatedBlock> path = moving(read.blocks);
    if (!path.empty()) path.erase(path.begin());  // the motion to the start
    for (CompensatedBlock& block : path) block.source = {};
    for (CompensatedBlock& block : given.blocks) block.source = {};
    EXPECT_EQ(difference(path, given.blocks, Motion{}, 2e-4), "");
  });
}

}  // namespace
}  // namespace trc::support
