#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "client/plot/frame.h"
#include "client/plot/picture.h"
#include "client/plot/svg.h"
#include "core/base/entry_help.h"
#include "core/messages/english.h"

namespace trc::plot {
namespace {

using std::numbers::pi;

std::shared_ptr<const TrcMode> mode(Side side, Plane plane = Plane::xy, bool remove = false) {
  TrcMode mode;
  mode.plane = plane;
  mode.side = side;
  mode.tool_radius = 10;
  mode.selection_number = side == Side::off ? 0 : 1;
  if (remove) mode.masking = Masking::on;
  mode.options.remove_masked_blocks = remove;
  return std::make_shared<const TrcMode>(mode);
}

Source source(std::int64_t number) {
  return {.index = static_cast<std::uint64_t>(number / 10),
          .number = number,
          .line = static_cast<std::uint32_t>(number / 10 + 1)};
}

MotionBlock motion(std::int64_t number, Segment path, std::shared_ptr<const TrcMode> trc,
                   bool rapid = false) {
  return {.source = source(number), .path = path, .rapid = rapid, .mode = std::move(trc)};
}

CompensatedBlock compensated(std::int64_t number, Origin origin, Segment path, bool rapid = false,
                             Plane plane = Plane::xy) {
  return {.source = source(number), .origin = origin, .plane = plane, .rapid = rapid, .path = path};
}

std::string svg_of(const std::vector<Block>& programmed, const std::vector<CompensatedBlock>& path,
                   const SvgOptions& options = {}, const std::vector<Diagnostic>& found = {}) {
  return to_svg(
      compose({.title = "part.nc", .programmed = programmed, .path = path, .diagnostics = found}),
      options);
}

// The opening tag of the first group of this class, and what is in the group.
std::string group(const std::string& svg, const std::string& name) {
  const auto begin = svg.find("<g class=\"" + name + "\"");
  if (begin == std::string::npos) return {};
  return svg.substr(begin, svg.find("</g>", begin) - begin);
}

std::vector<double> numbers_in(const std::string& text) {
  const std::regex number(R"(-?\d+(\.\d+)?)");
  std::vector<double> numbers;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i)
    numbers.push_back(std::stod(i->str()));
  return numbers;
}

// The d attributes of a group.
std::vector<std::string> paths_in(const std::string& group) {
  const std::regex d("d=\"([^\"]*)\"");
  std::vector<std::string> paths;
  for (std::sregex_iterator i(group.begin(), group.end(), d), end; i != end; ++i)
    paths.push_back((*i)[1]);
  return paths;
}

const std::vector<Block> corner_contour{
    motion(10, Line{{-20, 0}, {0, 0}}, mode(Side::left)),
    motion(20, Line{{0, 0}, {100, 0}}, mode(Side::left)),
    motion(30, Line{{100, 0}, {100, -50}}, mode(Side::left)),
    motion(40, Line{{100, -50}, {120, -70}}, mode(Side::off), true)};

const std::vector<CompensatedBlock> corner_path{
    compensated(10, Origin::approach, Line{{-20, 0}, {0, 10}}),
    compensated(20, Origin::programmed, Line{{0, 10}, {100, 10}}),
    compensated(20, Origin::transition, Arc{{100, 10}, {110, 0}, {100, 0}, -pi / 2}),
    compensated(30, Origin::programmed, Line{{110, 0}, {110, -50}}),
    compensated(40, Origin::retract, Line{{110, -50}, {120, -70}}, true)};

TEST(Svg, HasOneScaleForBothAxes) {
  const auto paths = paths_in(group(svg_of(corner_contour, corner_path), "programmed"));
  ASSERT_EQ(paths.size(), 2u);
  const auto across = numbers_in(paths[0]);  // 100 mm along X
  const auto down = numbers_in(paths[1]);    // 50 mm against Y
  ASSERT_EQ(across.size(), 4u);
  ASSERT_EQ(down.size(), 4u);
  const double scale = (across[2] - across[0]) / 100;
  EXPECT_GT(scale, 1);
  EXPECT_NEAR((down[3] - down[1]) / 50, scale, 1e-4);
  EXPECT_EQ(across[1], across[3]);
  EXPECT_EQ(down[0], across[2]);
}

TEST(Svg, DrawsLeadsThinner) {
  const std::vector<Block> contour{motion(10, Line{{-20, -20}, {-10, -10}}, mode(Side::left)),
                                   motion(20, Line{{-10, -10}, {0, 0}}, mode(Side::left)),
                                   motion(30, Line{{0, 0}, {0, 50}}, mode(Side::left)),
                                   motion(40, Line{{0, 50}, {50, 0}}, mode(Side::left)),
                                   motion(50, Line{{50, 0}, {0, 0}}, mode(Side::left)),
                                   motion(60, Line{{0, 0}, {-10, 10}}, mode(Side::left))};
  const std::string svg = svg_of(contour, {});
  EXPECT_EQ(paths_in(group(svg, "lead")).size(), 2u);
  EXPECT_EQ(paths_in(group(svg, "programmed")).size(), 3u);
  EXPECT_EQ(paths_in(group(svg, "beside")).size(), 1u);
}

// The closing point lies in the first wall: an overrun of the last one ends at it.
TEST(Svg, DrawsOneBlockThinAndThickWhereTheClosingPartsIt) {
  const std::vector<Block> contour{motion(10, Line{{-20, -20}, {-10, 0}}, mode(Side::left)),
                                   motion(20, Line{{-10, 0}, {50, 0}}, mode(Side::left)),
                                   motion(30, Line{{50, 0}, {0, -50}}, mode(Side::left)),
                                   motion(40, Line{{0, -50}, {0, 20}}, mode(Side::left))};
  const std::string svg = svg_of(contour, {});
  EXPECT_EQ(paths_in(group(svg, "programmed")).size(), 3u);
  const auto leads = paths_in(group(svg, "lead"));
  ASSERT_EQ(leads.size(), 2u);
  const auto in = numbers_in(leads[0]);   // 10 mm along X
  const auto out = numbers_in(leads[1]);  // 20 mm along Y
  ASSERT_EQ(in.size(), 4u);
  ASSERT_EQ(out.size(), 4u);
  EXPECT_EQ(in[1], in[3]);
  EXPECT_NEAR(out[1] - out[3], 2 * (in[2] - in[0]), 1e-3);
  EXPECT_NEAR(out[0], in[2], 1e-3);
}

TEST(Svg, DrawsContourBlackPathBlueAndTransitionLighter) {
  const std::string svg = svg_of(corner_contour, corner_path);
  EXPECT_NE(group(svg, "programmed").find("stroke=\"black\""), std::string::npos);
  EXPECT_NE(group(svg, "path").find("stroke=\"blue\""), std::string::npos);
  EXPECT_NE(group(svg, "transition").find("stroke=\"deepskyblue\""), std::string::npos);
  EXPECT_EQ(paths_in(group(svg, "path")).size(), 2u);
  EXPECT_EQ(paths_in(group(svg, "transition")).size(), 1u);
}

// The contour is what is cut: what leads to it and away, and rapid moves, are no walls.
TEST(Svg, DrawsApproachRetractAndRapidMovesThinnerThanTheWalls) {
  const std::string svg = svg_of(corner_contour, corner_path);
  const auto width_of = [&](const std::string& name) {
    const std::regex width("stroke-width=\"([^\"]*)\"");
    const std::string drawn = group(svg, name);
    std::smatch found;
    return std::regex_search(drawn, found, width) ? std::stod(found[1]) : 0;
  };
  EXPECT_GT(width_of("beside"), 0);
  EXPECT_LT(width_of("beside"), width_of("programmed") / 2);
  EXPECT_LT(width_of("approach"), width_of("path"));
  EXPECT_NE(group(svg, "beside").find("N10 contour"), std::string::npos);
  EXPECT_NE(group(svg, "beside rapid").find("N40 contour"), std::string::npos);
  EXPECT_EQ(paths_in(group(svg, "approach")).size(), 1u);
  EXPECT_EQ(paths_in(group(svg, "approach rapid")).size(), 1u);
}

TEST(Svg, DashesRapidMovesOnly) {
  const std::string svg = svg_of(corner_contour, corner_path);
  EXPECT_NE(group(svg, "beside rapid").find("stroke-dasharray"), std::string::npos);
  EXPECT_NE(group(svg, "approach rapid").find("stroke-dasharray"), std::string::npos);
  EXPECT_EQ(group(svg, "programmed").find("stroke-dasharray"), std::string::npos);
  EXPECT_EQ(group(svg, "path").find("stroke-dasharray"), std::string::npos);
}

TEST(Svg, TurnsArcsTheRightWayRound) {
  const auto arc_of = [](double sweep) {
    const Point end(10 * std::cos(sweep), 10 * std::sin(sweep));
    const auto svg = svg_of({motion(10, Arc{{10, 0}, end, {0, 0}, sweep}, mode(Side::off))}, {});
    return paths_in(group(svg, "beside")).at(0);
  };
  const std::regex counter_clockwise(R"(M[\d. ]+A([\d.]+) \1 0 0 0 [\d. ]+)");
  const std::regex clockwise(R"(M[\d. ]+A([\d.]+) \1 0 0 1 [\d. ]+)");
  const std::regex counter_clockwise_halves(
      R"(M[\d. ]+A([\d.]+) \1 0 0 0 [\d. ]+A\1 \1 0 0 0 [\d. ]+)");
  const std::regex clockwise_halves(R"(M[\d. ]+A([\d.]+) \1 0 0 1 [\d. ]+A\1 \1 0 0 1 [\d. ]+)");
  EXPECT_TRUE(std::regex_match(arc_of(pi / 2), counter_clockwise)) << arc_of(pi / 2);
  EXPECT_TRUE(std::regex_match(arc_of(-pi / 2), clockwise));
  EXPECT_TRUE(std::regex_match(arc_of(-pi), clockwise));
  EXPECT_TRUE(std::regex_match(arc_of(1.5 * pi), counter_clockwise_halves));
  EXPECT_TRUE(std::regex_match(arc_of(-1.5 * pi), clockwise_halves));
}

TEST(Svg, DrawsFullCirclesWhole) {
  const std::string svg =
      svg_of({motion(10, Arc{{0, 0}, {0, 0}, {30, 0}, -2 * pi}, mode(Side::off))}, {});
  const auto numbers = numbers_in(paths_in(group(svg, "beside")).at(0));
  ASSERT_EQ(numbers.size(), 16u);  // M x y, twice A rx ry 0 0 1 x y
  EXPECT_EQ(numbers[0], numbers[14]);
  EXPECT_EQ(numbers[1], numbers[15]);
  EXPECT_NEAR(numbers[7] - numbers[0], 2 * numbers[2], 2e-3);  // the far side
  // All of the circle lies inside the field.
  const auto field = numbers_in(
      std::regex_replace(svg.substr(svg.find("<rect x="), 120), std::regex("[a-z\"=<#]+"), " "));
  EXPECT_GT(numbers[1] - numbers[2], field[1]);
  EXPECT_LT(numbers[1] + numbers[2], field[1] + field[3]);
}

TEST(Svg, ShowsTheToolWhereTheSelectionBeginsAndWhereItEnds) {
  const std::string svg = svg_of(corner_contour, corner_path);
  const std::string tool = group(svg, "tool");
  const std::regex circle("cx=\"([^\"]*)\" cy=\"([^\"]*)\" r=\"([^\"]*)\"");
  std::vector<std::smatch> circles(std::sregex_iterator(tool.begin(), tool.end(), circle), {});
  ASSERT_EQ(circles.size(), 2u);
  const auto approach = numbers_in(paths_in(group(svg, "approach")).at(0));
  const auto contour = numbers_in(paths_in(group(svg, "programmed")).at(0));
  EXPECT_EQ(std::stod(circles[0][1]), approach[0]);
  EXPECT_EQ(std::stod(circles[0][2]), approach[1]);
  EXPECT_EQ(std::stod(circles[1][1]), approach[2]);
  EXPECT_EQ(std::stod(circles[1][2]), approach[3]);
  EXPECT_NEAR(std::stod(circles[0][3]), (contour[2] - contour[0]) / 10, 2e-3);
}

TEST(Svg, NamesTheAxesOfThePlane) {
  const auto names = [](Plane plane) {
    const auto svg = svg_of({motion(10, Line{{0, 0}, {10, 5}}, mode(Side::off, plane))}, {});
    const std::regex name("([XYZ]) / mm");
    const std::vector<std::smatch> found(std::sregex_iterator(svg.begin(), svg.end(), name), {});
    return found.at(0)[1].str() + found.at(1)[1].str();
  };
  EXPECT_EQ(names(Plane::xy), "XY");
  EXPECT_EQ(names(Plane::zx), "ZX");
  EXPECT_EQ(names(Plane::yz), "YZ");
}

Diagnostic masked_note(std::uint64_t first, std::uint64_t last) {
  return {.code = Code::blocks_masked,
          .severity = Severity::note,
          .source = {.index = first},
          .values = {{"first_index", static_cast<double>(first)},
                     {"last_index", static_cast<double>(last)}}};
}

TEST(Svg, MarksMaskedBlocksRed) {
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::approach, Line{{-20, 0}, {0, 10}}),
      compensated(20, Origin::masked, Line{{0, 10}, {0, 10}}),
      compensated(30, Origin::programmed, Line{{0, 10}, {0, 60}})};
  const std::string svg = svg_of(corner_contour, path, {}, {masked_note(2, 2)});
  const std::string masked = group(svg, "masked");
  EXPECT_NE(masked.find("stroke=\"red\""), std::string::npos);
  ASSERT_EQ(paths_in(masked).size(), 1u);
  EXPECT_NE(masked.find("N20 contour, not travelled"), std::string::npos);
  EXPECT_EQ(paths_in(group(svg, "programmed")).size(), 1u);
}

// As the notes name them: the last block of a loop is left by the transition after it, and a block
// the tool just fits beside is travelled on the spot.
TEST(Svg, MarksBlocksOfRemovedLoopsRed) {
  const auto removing = mode(Side::left, Plane::xy, true);
  const std::vector<Block> contour{
      motion(10, Line{{-20, 0}, {0, 0}}, removing), motion(20, Line{{0, 0}, {5, 5}}, removing),
      motion(30, Line{{5, 5}, {5, 9}}, removing), motion(40, Line{{5, 9}, {5, 50}}, removing),
      motion(50, Line{{5, 50}, {5, 50.5}}, removing)};
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::approach, Line{{-20, 0}, {-5, 10}}),
      compensated(30, Origin::transition, Line{{-5, 10}, {-5, 11}}),
      compensated(40, Origin::programmed, Line{{-5, 11}, {-5, 50}}),
      compensated(50, Origin::programmed, Line{{-5, 50}, {-5, 50}})};
  const std::string masked = group(svg_of(contour, path, {}, {masked_note(2, 3)}), "masked");
  EXPECT_EQ(paths_in(masked).size(), 2u);
  EXPECT_NE(masked.find("N20"), std::string::npos);
  EXPECT_NE(masked.find("N30"), std::string::npos);
}

TEST(Svg, KeepsHugeCoordinatesOnTheSheet) {
  const std::string svg =
      svg_of({motion(10, Line{{999990, -1e6}, {1e6, -999990}}, mode(Side::off)),
              motion(20, Line{{1e6, -999990}, {1e6, -999995}}, mode(Side::off))},
             {});
  for (const std::string& path : paths_in(group(svg, "beside")))
    for (const double number : numbers_in(path)) {
      EXPECT_GT(number, 0);
      EXPECT_LT(number, 1000);
    }
  EXPECT_NE(svg.find(">999992<"), std::string::npos);
}

TEST(Svg, EnlargesTinyContours) {
  const std::string svg = svg_of({motion(10, Line{{0, 0}, {0.001, 0.0005}}, mode(Side::off))}, {});
  const auto numbers = numbers_in(paths_in(group(svg, "beside")).at(0));
  EXPECT_GT(numbers[2] - numbers[0], 300);
  EXPECT_NE(svg.find(">0.0002<"), std::string::npos);
}

TEST(Svg, DrawsAnEmptyProgramAsEmptyAxes) {
  const std::string svg = svg_of({}, {});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("X / mm"), std::string::npos);
  EXPECT_EQ(svg.find("<path"), std::string::npos);
}

TEST(Svg, ShowsWhyAndWhereAProgramWasRefused) {
  const std::vector<CompensatedBlock> certain(corner_path.begin(), corner_path.begin() + 2);
  const std::vector<Diagnostic> found{{.code = Code::line_reversed, .source = source(30)}};
  const std::string svg = svg_of(corner_contour, certain, {}, found);
  EXPECT_NE(svg.find("error 90019 in line 4 (N30): "), std::string::npos);
  const std::regex circle("cx=\"([^\"]*)\" cy=\"([^\"]*)\"");
  const std::string fault = group(svg, "fault");
  std::smatch place;
  ASSERT_TRUE(std::regex_search(fault, place, circle));
  EXPECT_NE(fault.find("<title>error 90019"), std::string::npos);
  EXPECT_NE(svg.find(">Use a smaller tool"), std::string::npos);
  const auto at_fault = numbers_in(paths_in(group(svg, "programmed")).at(1));
  EXPECT_NEAR(std::stod(place[1]), at_fault[0], 2e-3);
  EXPECT_NEAR(std::stod(place[2]), (at_fault[1] + at_fault[3]) / 2, 2e-3);
}

// R 10: the notch (50,0) (53,-8) (56,0) has its bottom raised to (53,-2), so that the path
// runs beside the new sides.
TEST(Svg, ShowsTheMovedPointOfAKerfAndWhatWasProgrammed) {
  const std::vector<Block> programmed{
      motion(10, Line{{50, 0}, {53, -8}}, mode(Side::left)),
      motion(20, Line{{53, -8}, {56, 0}}, mode(Side::left)),
  };
  const auto beside = [](const Point& start, const Point& end) {
    const Vector shift = 10 * left_of((end - start).normalized());
    return Line{.start = start + shift, .end = end + shift};
  };
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::kerf, beside({50, 0}, {53, -2})),
      compensated(20, Origin::kerf, beside({53, -2}, {56, 0})),
  };
  const Picture picture = compose({.programmed = programmed, .path = path});
  std::vector<Point> corners;
  for (const Stroke& stroke : picture.strokes)
    if (stroke.layer == Layer::programmed) corners.push_back(end_of(stroke.segments.at(0)));
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_LT((corners[0] - Point(53, -2)).norm(), 1e-9);
  EXPECT_LT((corners[1] - Point(56, 0)).norm(), 1e-9);
  const std::string replaced = group(svg_of(programmed, path), "replaced");
  EXPECT_EQ(paths_in(replaced).size(), 2U);
  EXPECT_NE(replaced.find("stroke=\"red\""), std::string::npos);
  EXPECT_NE(replaced.find("stroke-dasharray"), std::string::npos);
}

// The tool stands still in the raised notch: both sides touch it.
TEST(Picture, FindsTheMovedPointOfAKerfThatLeavesNoPath) {
  const std::vector<Block> programmed{
      motion(10, Line{{-5, 0}, {0, -20}}, mode(Side::left)),
      motion(20, Line{{0, -20}, {5, 0}}, mode(Side::left)),
  };
  const Point bottom(0, -2);
  // R 10 above the sides from (-5,0) and (5,0) to the bottom.
  const double slope = std::atan2(2, 5);
  const Point tool(0, -2 + 10 / std::cos(slope));
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::kerf, Line{tool, tool}),
      compensated(20, Origin::kerf, Line{tool, tool}),
  };
  const Picture picture = compose({.programmed = programmed, .path = path});
  std::vector<Line> sides;
  for (const Stroke& stroke : picture.strokes)
    if (stroke.layer == Layer::programmed) sides.push_back(std::get<Line>(stroke.segments.at(0)));
  ASSERT_EQ(sides.size(), 2U);
  EXPECT_LT((sides[0].end - bottom).norm(), 1e-9);
  EXPECT_EQ(sides[0].end, sides[1].start);
}

TEST(Svg, ShowsTheChordOfAConvertedCircle) {
  const std::vector<Block> programmed{
      motion(10, Arc{{0, 0}, {2, 2}, {0, 2}, pi / 2}, mode(Side::left))};
  const Vector shift = 10 * left_of(Vector(1, 1).normalized());
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::converted_circle, Line{Point(shift), Point(shift + Vector(2, 2))})};
  const Picture picture = compose({.programmed = programmed, .path = path});
  ASSERT_EQ(picture.strokes.size(), 3U);
  EXPECT_EQ(picture.strokes[0].layer, Layer::programmed);
  EXPECT_EQ(std::get<Line>(picture.strokes[0].segments.at(0)), (Line{{0, 0}, {2, 2}}));
  EXPECT_EQ(picture.strokes[1].layer, Layer::replaced);
  EXPECT_TRUE(is_arc(picture.strokes[1].segments.at(0)));
}

TEST(Picture, ShowsWhatIsInsertedAtTheApproachAsATransition) {
  const std::vector<Block> programmed{motion(10, Line{{0, 0}, {50, 0}}, mode(Side::left))};
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::approach, Line{{0, 0}, {40, 0}}),
      compensated(10, Origin::approach, Arc{{40, 0}, {50, 10}, {50, 0}, -pi / 2}),
      compensated(20, Origin::retract, Arc{{90, 10}, {100, 0}, {90, 0}, -pi / 2}),
      compensated(30, Origin::retract, Line{{100, 0}, {100, -20}}),
      compensated(40, Origin::approach, Line{{0, 0}, {25, 0}}),
      compensated(40, Origin::approach, Line{{25, 0}, {30, 0}}),
  };
  const Picture picture = compose({.programmed = programmed, .path = path});
  std::size_t inserted = 0;
  for (const Stroke& stroke : picture.strokes) inserted += stroke.layer == Layer::transition;
  EXPECT_EQ(inserted, 2U);
}

TEST(Svg, MarksWarningsAtTheirPlace) {
  Diagnostic warning = diagnostic(Code::side_changed_at_corner, source(20));
  warning.point = DiagnosticPoint{.x = 100, .y = 0};
  const std::string svg = svg_of(corner_contour, {}, {}, {warning});
  EXPECT_EQ(paths_in(group(svg, "warning")).size(), 1U);
  EXPECT_NE(group(svg, "warning").find("gold"), std::string::npos);
  EXPECT_NE(svg.find("warning 900217 in line 3 (N20)"), std::string::npos);
  const std::string remedy(english_row_of(Code::side_changed_at_corner).remedy);
  EXPECT_NE(svg.find(escaped(remedy.substr(0, remedy.find(' ', 20)))), std::string::npos);
}

TEST(Svg, TellsNotesInWordsWithoutAMark) {
  const std::string svg = svg_of(corner_contour, {}, {}, {masked_note(2, 2)});
  EXPECT_NE(svg.find("note 900213"), std::string::npos) << svg;
  EXPECT_NE(svg.find("Use a smaller tool"), std::string::npos);
  EXPECT_EQ(group(svg, "warning"), "");
}

TEST(Picture, DrawsTheToolAtTheFault) {
  Diagnostic error = diagnostic(Code::line_reversed, source(20));
  error.point = DiagnosticPoint{.x = 100, .y = 10};
  const std::vector<Diagnostic> found{error};
  const Picture picture = compose({.programmed = corner_contour, .diagnostics = found});
  ASSERT_TRUE(picture.fault);
  EXPECT_EQ(picture.fault->tool_radius, 10);
}

TEST(Svg, DrawsProposalsGreenAndDashed) {
  EntryHelp help{.tried_on = 1};
  help.proposals.push_back({.start = {.x = -300}, .blocks = {{.end = {.x = 0}}}});
  help.proposals.push_back(
      {.shape = EntryProposal::Shape::quarter_circle,
       .start = {.x = 0, .y = 20},
       .blocks = {{.end = {.x = -20, .y = 20}},
                  {.end = {}, .center = DiagnosticPoint{.x = 0, .y = 20}, .sweep = pi / 2}}});
  Diagnostic error = diagnostic(Code::selection_block_too_short, source(20));
  error.entry_help = std::make_shared<const EntryHelp>(help);
  const std::string drawn = group(svg_of(corner_contour, {}, {}, {error}), "proposal");
  EXPECT_NE(drawn.find("stroke=\"green\""), std::string::npos);
  EXPECT_NE(drawn.find("stroke-dasharray"), std::string::npos);
  EXPECT_EQ(paths_in(drawn).size(), 2U);
  // Across another plane there is nothing to be seen of an arc.
  help.third_axis = 0;
  error.entry_help = std::make_shared<const EntryHelp>(help);
  EXPECT_EQ(group(svg_of(corner_contour, {}, {}, {error}), "proposal"), "");
  EXPECT_EQ(group(svg_of(corner_contour, {}), "proposal"), "");
}

TEST(Svg, WritesBlockNumbersOnDemandOnly) {
  EXPECT_TRUE(group(svg_of(corner_contour, corner_path), "numbers").empty());
  const std::string numbers =
      group(svg_of(corner_contour, corner_path, {.numbers = true}), "numbers");
  EXPECT_NE(numbers.find(">N20<"), std::string::npos);
  EXPECT_NE(numbers.find(">N30<"), std::string::npos);
}

TEST(Svg, PutsArrowsOnPathsOfShortPieces) {
  std::vector<CompensatedBlock> path;
  for (int i = 0; i < 1000; ++i)
    path.push_back(compensated(10 * i, Origin::programmed, Line{{0.1 * i, 0}, {0.1 * (i + 1), 0}}));
  const auto arrows = paths_in(group(svg_of({}, path), "arrows"));
  ASSERT_GE(arrows.size(), 5u);
  // To the right: the tip is ahead of both other corners.
  const auto corners = numbers_in(arrows.front());
  EXPECT_GT(corners[0], corners[2] + 5);
  EXPECT_NEAR(corners[0] - corners[2], corners[0] - corners[4], 1e-3);
  // Where the way turns back and forth there is no direction to show.
  const auto zigzag = [](int i) { return Point(i % 2 == 0 ? 0.0 : 0.1, 0.01 * i); };
  for (int i = 0; i < 1000; ++i)
    path[static_cast<std::size_t>(i)].path = Line{zigzag(i), zigzag(i + 1)};
  EXPECT_EQ(paths_in(group(svg_of({}, path), "arrows")).size(), 0u);
}

TEST(Svg, KeepsArrowsThereAndBackApart) {
  const std::vector<CompensatedBlock> path{
      compensated(10, Origin::programmed, Line{{0, 0}, {100, 0}}),
      compensated(20, Origin::programmed, Line{{100, 0}, {0, 0}})};
  const auto arrows = paths_in(group(svg_of({}, path), "arrows"));
  ASSERT_EQ(arrows.size(), 2u);
  const auto there = numbers_in(arrows[0]);
  const auto back = numbers_in(arrows[1]);
  EXPECT_GT(there[0], there[2]);
  EXPECT_LT(back[0], back[2]);
  // From tail to tail, which are the nearest corners.
  EXPECT_GT(there[2] - back[2], 13);
  // Again and again the same way: none on another one.
  std::vector<CompensatedBlock> often;
  for (int i = 0; i < 10; ++i) often.insert(often.end(), path.begin(), path.end());
  EXPECT_EQ(paths_in(group(svg_of({}, often), "arrows")).size(), 2u);
}

TEST(Svg, CountsAsTheProgramDoes) {
  const auto ends = [](const std::string& svg) {
    const std::string axes = group(svg, "axes");
    return axes.substr(axes.rfind("<text"));
  };
  const Contents contents{.programmed = corner_contour, .path = corner_path};
  EXPECT_NE(ends(to_svg(compose(contents), {})).find("Y / mm"), std::string::npos);
  Contents inch = contents;
  inch.inch = true;
  const std::string svg = to_svg(compose(inch), {});
  EXPECT_NE(ends(svg).find("Y / inch"), std::string::npos);
  EXPECT_NE(svg.find("R 0.3937 inch"), std::string::npos) << "a tool of 10 mm";
}

TEST(Svg, IsTheSameInGermanButForItsWords) {
  std::vector<Diagnostic> found{diagnostic(Code::clearance_violated, source(20))};
  found.front().severity = Severity::warning;
  found.front().language = Language::german;
  Contents contents{.programmed = corner_contour, .path = corner_path, .diagnostics = found};
  contents.language = Language::german;
  const std::string svg = to_svg(compose(contents), {});
  for (const char* word : {"programmierte Kontur", "korrigierte Bahn", "Werkzeug, R 10 mm",
                           "Warnung 900216 in Zeile 3 (N20): nachgemessen"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  for (const char* word : {"programmed", "warning 9", "tool radius", "approach", "contour<"})
    EXPECT_EQ(svg.find(word, svg.find("class=\"legend\"")), std::string::npos) << word;
  // The text of the service is shown unchanged.
  found.front().texts = std::make_shared<const DiagnosticTexts>(
      DiagnosticTexts{.text = "said so", .help = "do that"});
  const std::string said = to_svg(compose(contents), {});
  EXPECT_NE(said.find(">Warnung 900216 in Zeile 3 (N20): said so<"), std::string::npos);
  EXPECT_NE(said.find(">do that<"), std::string::npos);
}

TEST(Svg, DrawsBothToolsWhereTheRadiusChanges) {
  TrcMode larger = *mode(Side::left);
  larger.tool_radius = 20;
  std::vector<Block> contour = corner_contour;
  contour[2] = motion(30, Line{{100, 0}, {100, -50}}, std::make_shared<const TrcMode>(larger));
  std::vector<CompensatedBlock> path = corner_path;
  path[3].path = Line{{110, 0}, {120, -50}};
  const Picture picture = compose({.programmed = contour, .path = path});
  ASSERT_EQ(picture.tools.size(), 4u);  // at the start of the approach, at its end, and both here
  EXPECT_EQ(picture.tools[2].center, Point(110, 0));
  EXPECT_EQ(picture.tools[2].radius, 10);
  EXPECT_EQ(picture.tools[3].center, Point(120, -50));
  EXPECT_EQ(picture.tools[3].radius, 20);
  EXPECT_NE(to_svg(picture, {}).find(">tool, R 10, 20 mm<"), std::string::npos);
}

TEST(Svg, MarksWhereBlocksEndOnDemandOnly) {
  EXPECT_EQ(group(svg_of(corner_contour, corner_path), "points"), "");
  const std::string points = group(svg_of(corner_contour, corner_path, {.points = true}), "points");
  const std::regex circle("<circle [^>]*stroke=\"blue\"");
  // Of the five blocks of the path the last one ends where the contour does.
  EXPECT_EQ(std::distance(std::sregex_iterator(points.begin(), points.end(), circle), {}), 4);
  // An arc seen from the side is drawn as chords, which are no blocks.
  const std::vector<CompensatedBlock> round{compensated(
      10, Origin::programmed, Arc{.start = {0, 0}, .end = {40, 0}, .center = {20, 0}, .sweep = -pi},
      false, Plane::zx)};
  const std::string side =
      group(to_svg(compose({.path = round, .plane = Plane::xy}), {.points = true}), "points");
  EXPECT_EQ(std::distance(std::sregex_iterator(side.begin(), side.end(), circle), {}), 1);
}

TEST(Svg, ShowsDepthsAndOtherPlanesInViewsOfTheirOwn) {
  const auto seen = [](const std::vector<Block>& contour) {
    const auto views = compose_views({.title = "part.nc", .programmed = contour});
    std::vector<Plane> planes;
    for (const Picture& view : views) planes.push_back(view.plane);
    return planes;
  };
  EXPECT_EQ(seen(corner_contour), std::vector{Plane::xy});
  // A plunge is seen from the side: along X, with Z upwards.
  std::vector<Block> deep = corner_contour;
  deep.insert(deep.begin() + 1, PassiveBlock{.source = source(15),
                                             .normal = {.from = 0, .to = -4},
                                             .moves = true,
                                             .mode = mode(Side::left)});
  EXPECT_EQ(seen(deep), (std::vector{Plane::xy, Plane::yz}));
  std::vector<Block> two = corner_contour;
  two[3] = motion(40, Line{{0, 0}, {10, 0}}, mode(Side::left, Plane::zx));
  EXPECT_EQ(seen(two), (std::vector{Plane::xy, Plane::zx}));
  // Messages stand below the first view only.
  const std::string svg = to_svg(compose_views({.title = "part.nc", .programmed = deep}), {});
  EXPECT_LT(svg.find("class=\"legend\""), svg.find(">plane YZ<"));
  EXPECT_EQ(svg.find("class=\"legend\""), svg.rfind("class=\"legend\""));
}

TEST(Svg, EscapesMarkupAndWhatIsNoText) {
  EXPECT_EQ(escaped("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(escaped("M\xC3\xBCnchen"), "M\xC3\xBCnchen");
  EXPECT_EQ(escaped("\xC3"), "\xEF\xBF\xBD");
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(escaped(std::string("a\0b\x1B", 4)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
}

TEST(Picture, JoinsStrokesOfLongPrograms) {
  std::vector<Block> long_program;
  for (std::size_t i = 0; i <= most_single_strokes; ++i) {
    const auto x = static_cast<double>(i);
    long_program.emplace_back(motion(10, Line{{x, 0}, {x + 1, 1}}, mode(Side::off)));
  }
  const Picture picture = compose({.programmed = long_program});
  ASSERT_EQ(picture.strokes.size(), 1u);
  EXPECT_EQ(picture.strokes[0].segments.size(), most_single_strokes + 1);
}

TEST(Picture, LeavesOutTheRapidThatComesFromWhereNobodyHasSaid) {
  const std::vector<Block> contour{motion(10, Line{{0, 0}, {-20, -20}}, mode(Side::off), true),
                                   motion(20, Line{{-20, -20}, {0, 0}}, mode(Side::left)),
                                   motion(30, Line{{0, 0}, {50, 0}}, mode(Side::left)),
                                   motion(40, Line{{50, 0}, {70, -20}}, mode(Side::off), true)};
  std::vector<CompensatedBlock> path{
      compensated(10, Origin::uncompensated, Line{{0, 0}, {-20, -20}}, true),
      compensated(30, Origin::programmed, Line{{0, 10}, {50, 10}})};
  const auto rapids = [&](const Position& start) {
    const Picture picture = compose({.programmed = contour, .path = path, .start = start});
    return std::ranges::count_if(picture.strokes, &Stroke::rapid);
  };
  EXPECT_EQ(rapids({0, 0, 0}), 1);
  EXPECT_EQ(rapids({1, 1, 0}), 3);
  // A motion to where it stands says where that is.
  std::vector<Block> said = contour;
  said.insert(said.begin(), motion(5, Line{{0, 0}, {0, 0}}, mode(Side::off), true));
  EXPECT_GE(std::ranges::count_if(compose({.programmed = said}).strokes, &Stroke::rapid), 2);
}

TEST(Picture, SeesOtherPlanesFromTheSide) {
  // A half circle in ZX at Y 5, from X 0 to X 20, seen from above: a line along X.
  const Picture picture = compose(
      {.programmed = std::vector<Block>{motion(10, Line{{0, 0}, {0, 5}}, mode(Side::left)),
                                        MotionBlock{.source = source(20),
                                                    .path = Arc{{0, 0}, {0, 20}, {0, 10}, pi},
                                                    .normal = {.from = 5, .to = 5},
                                                    .mode = mode(Side::off, Plane::zx)}}});
  EXPECT_EQ(picture.plane, Plane::xy);
  ASSERT_EQ(picture.strokes.size(), 2u);
  const auto& seen = picture.strokes[1].segments;
  EXPECT_EQ(place_at(seen.front(), 0).point, Point(0, 5));
  EXPECT_EQ(place_at(seen.back(), 1).point, Point(20, 5));
  for (const Segment& segment : seen) EXPECT_TRUE(std::holds_alternative<Line>(segment));
}

TEST(Picture, LeavesOutWhatIsNoNumber) {
  const Picture picture = compose({.path = std::vector<CompensatedBlock>{compensated(
                                       10, Origin::programmed, Line{{0, 0}, {std::nan(""), 1}})}});
  EXPECT_TRUE(picture.strokes.empty());
}

TEST(Bounds, HoldTheBowOfAnArc) {
  Bounds bounds;
  bounds.add(Arc{{10, 0}, {-10, 0}, {0, 0}, pi});
  EXPECT_EQ(bounds.high, Point(10, 10));
  EXPECT_EQ(bounds.low, Point(-10, 0));
  Bounds below;
  below.add(Arc{{10, 0}, {-10, 0}, {0, 0}, -pi});
  EXPECT_EQ(below.low, Point(-10, -10));
}

TEST(Ticks, StandAtRoundNumbers) {
  const Ticks ticks = ticks_between(-0.13, 0.42, 0.07);
  EXPECT_EQ(ticks.step, 0.1);
  EXPECT_EQ(ticks.decimals, 1);
  ASSERT_EQ(ticks.at.size(), 6u);
  EXPECT_EQ(decimal(ticks.at[1], ticks.decimals), "0");
  EXPECT_EQ(decimal(ticks.at[5], ticks.decimals), "0.4");
  EXPECT_EQ(ticks_between(0, 1000, 130).step, 200);
  EXPECT_EQ(decimal(-0.0001, 2), "0");
}

}  // namespace
}  // namespace trc::plot
