// A program in C gets what the sessions of the core give; a call that is at fault is told why.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "client/c/trc.h"
#include "core/session/program_session.h"
#include "tests/support/places.h"
#include "tests/support/process.h"
#include "tests/support/random.h"

namespace trc::testing_support {
namespace {

struct Free {
  void operator()(trc_session* session) const { trc_free(session); }
};
using Session = std::unique_ptr<trc_session, Free>;

// Null, and `status` something else than TRC_OK, where it is refused.
Session create(int input, const std::vector<const char*>& settings, const char* json = nullptr,
               int* status = nullptr) {
  trc_setup setup{};
  setup.size = sizeof setup;
  setup.input = input;
  setup.setting_count = static_cast<std::uint32_t>(settings.size());
  setup.settings = settings.data();
  setup.json = json;
  trc_session* session = nullptr;
  const int given = trc_create(&setup, &session);
  if (status != nullptr) *status = given;
  return Session(session);
}

// All that a session has said, copied.
struct Said {
  std::string text;
  std::vector<trc_motion> motions;
  std::vector<std::string> texts;  // of the motions
  std::vector<trc_diagnostic> diagnostics;
  std::vector<std::string> told;
  std::string order;  // "t", "m" or "d" for each
};

void take(trc_session* session, Said& said) {
  trc_answer answer{};
  answer.size = sizeof answer;
  int status = TRC_OK;
  while ((status = trc_next(session, &answer)) == TRC_OK) {
    if (answer.kind == TRC_ANSWER_TEXT) {
      said.text.append(answer.text, answer.text_length);
      said.order += 't';
    } else if (answer.kind == TRC_ANSWER_MOTION) {
      said.motions.push_back(*answer.motion);
      said.texts.emplace_back(answer.motion->text);
      said.order += 'm';
    } else {
      said.diagnostics.push_back(*answer.diagnostic);
      said.told.emplace_back(answer.diagnostic->text);
      said.order += 'd';
    }
  }
  EXPECT_EQ(status, TRC_END);
}

trc_block line(double x, double y) {
  trc_block block{};
  block.kind = TRC_LINE;
  block.given = TRC_HAS_X | TRC_HAS_Y;
  block.x = x;
  block.y = y;
  return block;
}

trc_block of_kind(int kind) {
  trc_block block{};
  block.kind = kind;
  return block;
}

int feed(trc_session* session, const std::vector<trc_block>& blocks) {
  return trc_feed_blocks(session, blocks.data(), blocks.size(), sizeof(trc_block));
}

// Around two corners and an arc, tool radius 10.
std::vector<trc_block> contour() {
  trc_block arc = line(60, 50);
  arc.kind = TRC_COUNTER_CLOCKWISE;
  arc.given |= TRC_HAS_J | TRC_HAS_NUMBER;
  arc.j = 25;
  arc.number = 70;
  trc_block text = of_kind(TRC_TEXT);
  text.text = "M8";
  trc_block first = line(30, 0);
  first.given |= TRC_HAS_FEED;
  first.feed = 800;
  return {of_kind(TRC_LEFT), first,      text, line(60, 0), arc, line(30, 50),
          of_kind(TRC_OFF),  line(0, 80)};
}

// contour() in the words of a program.
const std::string program =
    "V.G.WZ_AKT.R = 10\nG41 G01 X30 Y0 F800\nM8\nX60\nN70 G03 Y50 J25\nG01 X30\nG40\nX0 Y80\nM30\n";

std::vector<CompensatedBlock> blocks_of_core() {
  ProgramSessionSetup setup;
  setup.nc_text = false;
  ProgramSession session(setup);
  Answers out;
  EXPECT_TRUE(session.feed(program, out) && session.finish(out));
  return out.take().blocks;
}

TEST(CApi, BlocksGiveThePathOfTheCore) {
  const Session session = create(TRC_INPUT_BLOCKS, {"tool_radius=10"});
  ASSERT_TRUE(session) << trc_last_error();
  Said said;
  for (const trc_block& block : contour()) {
    ASSERT_EQ(feed(session.get(), {block}), TRC_OK) << trc_last_error();
    take(session.get(), said);
  }
  ASSERT_EQ(trc_finish(session.get()), TRC_OK);
  take(session.get(), said);

  std::vector<trc_motion> motions;
  for (const trc_motion& motion : said.motions)
    if (motion.kind != TRC_TEXT) motions.push_back(motion);
  std::vector<CompensatedBlock> expected = blocks_of_core();
  std::erase_if(expected, [](const auto& b) { return b.origin == Origin::passthrough; });
  ASSERT_EQ(motions.size(), expected.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const trc_motion& motion = motions[i];
    EXPECT_NEAR(motion.start[0], start_of(expected[i].path).x(), 1e-4) << i;
    EXPECT_NEAR(motion.start[1], start_of(expected[i].path).y(), 1e-4) << i;
    EXPECT_NEAR(motion.end[0], end_of(expected[i].path).x(), 1e-4) << i;
    EXPECT_NEAR(motion.end[1], end_of(expected[i].path).y(), 1e-4) << i;
    EXPECT_EQ(motion.feed, expected[i].feed);
    EXPECT_EQ(motion.plane, 17);
    const auto* arc = std::get_if<Arc>(&expected[i].path);
    ASSERT_EQ(motion.kind, arc ? TRC_COUNTER_CLOCKWISE : TRC_LINE) << i;
    if (arc == nullptr) continue;
    EXPECT_NEAR(motion.center[1], arc->center.y(), 1e-4);
    EXPECT_NEAR(motion.sweep, arc->sweep, 1e-9);
    EXPECT_EQ(motion.number, 70);
    EXPECT_EQ(motion.index, 4U);
  }
  // The inside of the arc of 25 mm is cut with 10 mm beside it.
  EXPECT_NEAR(motions[2].start[1], 10, 1e-4);
  EXPECT_NEAR(motions[2].end[1], 40, 1e-4);
  EXPECT_EQ(std::count(said.texts.begin(), said.texts.end(), "M8"), 1);

  trc_summary summary{};
  summary.size = sizeof summary;
  ASSERT_EQ(trc_summarize(session.get(), &summary), TRC_OK);
  EXPECT_EQ(summary.blocks_out, said.motions.size());
  EXPECT_EQ(summary.effective_radius, 10);
  EXPECT_EQ(summary.lines_in, 0U);
}

TEST(CApi, BlocksMayBeGivenAllAtOnce) {
  const auto path_of = [](std::size_t at_once) {
    const Session session = create(TRC_INPUT_BLOCKS, {"tool_radius=1", "axis_names=A"});
    std::vector<trc_block> blocks = {of_kind(TRC_LEFT)};
    trc_axis axis{};
    for (int i = 0; i < 1000; ++i) blocks.push_back(line(10 * i, (i % 2) * 10));
    axis.position = 45;
    blocks[500].axes = &axis;
    blocks[500].axis_count = 1;
    for (std::size_t i = 0; i < blocks.size(); i += at_once)
      EXPECT_EQ(trc_feed_blocks(session.get(), &blocks[i], std::min(at_once, blocks.size() - i),
                                sizeof(trc_block)),
                TRC_OK)
          << trc_last_error();
    EXPECT_EQ(trc_finish(session.get()), TRC_OK) << trc_last_error();
    Said said;
    double last_axis = 0;
    trc_answer answer{};
    answer.size = sizeof answer;
    while (trc_next(session.get(), &answer) == TRC_OK)
      if (answer.kind == TRC_ANSWER_MOTION) {
        said.motions.push_back(*answer.motion);
        if (answer.motion->axis_count == 1) last_axis = answer.motion->axis_end[0];
      }
    EXPECT_EQ(last_axis, 45);
    return said.motions;
  };
  const auto one = path_of(1);
  ASSERT_EQ(one.size(), 1000U);
  for (const std::size_t at_once : {7U, 256U, 5000U}) {
    const auto many = path_of(at_once);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].end[0], one[i].end[0]);
      EXPECT_EQ(many[i].end[1], one[i].end[1]);
    }
  }
}

TEST(CApi, TextInPiecesGivesTheBytesOfTheCommandLine) {
  const std::string samples = source_dir() + "/client/samples/";
  for (const std::string name : {"bracket.nc", "g239_demo.nc"}) {
    const std::string text = content_of(samples + name);
    const Ended ended = run({trc_program(), "compensate", samples + name, "--server", ""});
    ASSERT_EQ(ended.code, 0) << ended.err;
    for (const std::size_t size : {1UL, 7UL, 64UL, text.size()}) {
      const Session session = create(TRC_INPUT_TEXT, {});
      Said said;
      for (std::size_t at = 0; at < text.size(); at += size) {
        const std::string piece = text.substr(at, size);
        ASSERT_EQ(trc_feed_text(session.get(), piece.data(), piece.size()), TRC_OK);
        take(session.get(), said);
      }
      ASSERT_EQ(trc_finish(session.get()), TRC_OK) << trc_last_error();
      take(session.get(), said);
      EXPECT_EQ(said.text, ended.out) << name << " in pieces of " << size;
    }
  }
}

TEST(CApi, TextMayComeOutAsBlocksAndTheSetupFromJson) {
  const char* json = R"({"output": "PROGRAM_OUTPUT_BLOCKS", "dialect": "DIALECT_FANUC",
                         "tools": [{"number": 1, "radius": 5}], "path": {"verify": "VERIFICATION_REPORT"}})";
  const Session session = create(TRC_INPUT_TEXT, {}, json);
  ASSERT_TRUE(session) << trc_last_error();
  const std::string text = "G90 G17\nG0 X0 Y0\nG41 D1 G1 X10 Y0 F500\nX50\nG40 X60 Y20\nM30\n";
  ASSERT_EQ(trc_feed_text(session.get(), text.data(), text.size()), TRC_OK) << trc_last_error();
  ASSERT_EQ(trc_finish(session.get()), TRC_OK) << trc_last_error();
  Said said;
  take(session.get(), said);
  EXPECT_EQ(said.text, "");
  const auto contour = std::find_if(said.motions.begin(), said.motions.end(),
                                    [](const auto& m) { return m.origin == TRC_PROGRAMMED; });
  ASSERT_NE(contour, said.motions.end());
  EXPECT_NEAR(contour->end[0], 50, 1e-4);
  EXPECT_NEAR(contour->end[1], 5, 1e-4);
  EXPECT_EQ(contour->line, 4U);
  trc_summary summary{};
  summary.size = sizeof summary;
  ASSERT_EQ(trc_summarize(session.get(), &summary), TRC_OK);
  EXPECT_GT(summary.checked, 0U);
  EXPECT_NEAR(summary.clearance, 5, 1e-4);
  EXPECT_NEAR(summary.required, 5, 1e-4);
}

TEST(CApi, ARefusedProgramIsToldWithCodeLineAndText) {
  const Session session = create(TRC_INPUT_TEXT, {});
  const std::string text = "G90 G17 G0 X0 Y20\nN20 G02 X20 Y40 I25 J0\nM30\n";
  int status = trc_feed_text(session.get(), text.data(), text.size());
  if (status == TRC_OK) status = trc_finish(session.get());
  EXPECT_EQ(status, TRC_REFUSED);
  EXPECT_NE(std::string(trc_last_error()).find("line 2"), std::string::npos) << trc_last_error();
  EXPECT_NE(std::string(trc_last_error()).find("20035"), std::string::npos) << trc_last_error();
  Said said;
  take(session.get(), said);
  ASSERT_FALSE(said.diagnostics.empty());
  const trc_diagnostic& told = said.diagnostics.back();
  EXPECT_EQ(told.code, 20035);
  EXPECT_EQ(told.severity, TRC_ERROR);
  EXPECT_EQ(told.line, 2U);
  EXPECT_EQ(told.number, 20);
  EXPECT_GT(told.value_count, 0U);
  EXPECT_NE(said.told.back().find("mm"), std::string::npos) << said.told.back();
  EXPECT_EQ(said.order.back(), 'd');
  // It stays refused.
  EXPECT_EQ(trc_feed_text(session.get(), "M30\n", 4), TRC_REFUSED);
  EXPECT_EQ(trc_finish(session.get()), TRC_REFUSED);
  trc_summary summary{};
  summary.size = sizeof summary;
  EXPECT_EQ(trc_summarize(session.get(), &summary), TRC_REFUSED);
}

TEST(CApi, ARefusedPathNamesItsBlock) {
  const Session session = create(TRC_INPUT_BLOCKS, {});
  EXPECT_EQ(feed(session.get(), {of_kind(TRC_LEFT), line(10, 0)}), TRC_REFUSED);
  Said said;
  take(session.get(), said);
  ASSERT_FALSE(said.diagnostics.empty());
  EXPECT_EQ(said.diagnostics.back().code, 900219);
  EXPECT_EQ(said.diagnostics.back().index, 1U);
  EXPECT_EQ(said.diagnostics.back().line, 0U);
}

// The path goes on with a corrected block.
TEST(CApi, ABlockThatCannotBeTakenIsNamedAndNotTaken) {
  trc_block far = line(20, 0);
  far.x = 2e6;
  trc_block not_a_number = line(20, 0);
  not_a_number.y = std::numeric_limits<double>::quiet_NaN();
  trc_block radius_of_line = line(20, 0);
  radius_of_line.given |= TRC_HAS_RADIUS;
  trc_block two_ways = line(20, 0);
  two_ways.kind = TRC_CLOCKWISE;
  two_ways.given |= TRC_HAS_RADIUS | TRC_HAS_I;
  trc_block no_center = line(20, 0);
  no_center.kind = TRC_CLOCKWISE;
  trc_block negative_number = line(20, 0);
  negative_number.given |= TRC_HAS_NUMBER;
  negative_number.number = -5;
  trc_block no_axes = line(20, 0);
  no_axes.axis_count = 1;
  trc_block stopped = line(20, 0);
  stopped.given |= TRC_HAS_FEED;
  trc_block role = line(20, 0);
  role.role = 3;
  trc_block no_utf8 = of_kind(TRC_TEXT);
  no_utf8.text = "M8 \xff";
  trc_block two_lines = of_kind(TRC_TEXT);
  two_lines.text = "M8\nM9";
  trc_block no_json = of_kind(TRC_COMMAND);
  no_json.text = "{\"side\": 77777777777777}";
  trc_block unknown_field = of_kind(TRC_COMMAND);
  unknown_field.text = "{\"radius\": 5}";
  const struct {
    trc_block block;
    const char* names;
  } rows[] = {{of_kind(0), "kind"},
              {of_kind(99), "kind"},
              {far, "end.x"},
              {not_a_number, "end.y"},
              {radius_of_line, "given"},
              {two_ways, "radius and a centre"},
              {no_center, "center"},
              {negative_number, "number"},
              {no_axes, "axes"},
              {stopped, "feed"},
              {role, "role"},
              {no_utf8, "UTF-8"},
              {two_lines, "control"},
              {no_json, "text"},
              {unknown_field, "radius"},
              {of_kind(TRC_TEXT), "text"},
              {of_kind(TRC_COMMAND), "text"}};
  for (const auto& row : rows) {
    const Session session = create(TRC_INPUT_BLOCKS, {"tool_radius=5"});
    EXPECT_EQ(feed(session.get(), {line(10, 0), row.block, line(90, 0)}), TRC_ARGUMENT)
        << row.names;
    const std::string said_wrong = trc_last_error();
    EXPECT_EQ(said_wrong.rfind("block 1: ", 0), 0U) << said_wrong;
    EXPECT_NE(said_wrong.find(row.names), std::string::npos) << said_wrong;
    EXPECT_EQ(feed(session.get(), {line(20, 0)}), TRC_OK);
    EXPECT_EQ(trc_finish(session.get()), TRC_OK);
    Said said;
    take(session.get(), said);
    ASSERT_EQ(said.motions.size(), 2U) << row.names;
    EXPECT_NEAR(said.motions[1].end[0], 20, 1e-4);
    EXPECT_EQ(said.motions[1].index, 1U);
  }
}

// Whatever stands in a block: it is taken, refused, or named as wrong.
TEST(CApi, NoBlockWhateverItHoldsGivesAnythingElse) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> odd = {0,    1,     -5,     10,       25,        1e-9,     999999,
                                   -1e7, 1e300, 1e-310, infinite, -infinite, no_number};
  const std::vector<const char*> texts = {nullptr, "", "{}", "M8", "{\"plane\": 2}"};
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    support::Random random(seed);
    const Session session = create(TRC_INPUT_BLOCKS, {"tool_radius=2", "verify=report"});
    int status = TRC_OK;
    for (int i = 0; i < 40 && status != TRC_REFUSED; ++i) {
      trc_block block = of_kind(static_cast<int>(random.below(11)));
      block.given = static_cast<std::uint32_t>(random.below(random.chance(0.25) ? 1024 : 8));
      for (double* value :
           {&block.x, &block.y, &block.z, &block.i, &block.j, &block.k, &block.radius, &block.feed})
        *value = random.chance(0.1) ? odd[random.below(odd.size())] : random.between(0, 100);
      block.number = static_cast<std::int64_t>(random.below(3)) - 1;
      block.role = static_cast<int>(random.below(50) == 0 ? 7 : random.below(3));
      block.text = texts[random.below(texts.size())];
      trc_axis axis{};
      axis.axis = static_cast<std::uint32_t>(random.below(8));
      axis.position = odd[random.below(odd.size())];
      block.axes = &axis;
      block.axis_count = random.chance(0.1) ? 1 : 0;
      status = feed(session.get(), {block});
      EXPECT_TRUE(status == TRC_OK || status == TRC_REFUSED || status == TRC_ARGUMENT)
          << status << ": " << trc_last_error();
    }
    status = trc_finish(session.get());
    EXPECT_TRUE(status == TRC_OK || status == TRC_REFUSED) << status << ": " << trc_last_error();
    Said said;
    take(session.get(), said);
    for (const trc_motion& motion : said.motions)
      for (const double coordinate : motion.end) EXPECT_TRUE(std::isfinite(coordinate));
    EXPECT_EQ(status == TRC_REFUSED,
              !said.diagnostics.empty() && said.diagnostics.back().severity == TRC_ERROR);
  }
}

TEST(CApi, AChangeOfAnyKindIsACommandInJson) {
  const Session session = create(TRC_INPUT_BLOCKS, {});
  trc_block command = of_kind(TRC_COMMAND);
  command.text = R"({"toolRadius": 7, "side": "COMPENSATION_SIDE_RIGHT"})";
  ASSERT_EQ(feed(session.get(), {command, line(10, 0), line(50, 0)}), TRC_OK) << trc_last_error();
  ASSERT_EQ(trc_finish(session.get()), TRC_OK);
  Said said;
  take(session.get(), said);
  ASSERT_EQ(said.motions.size(), 2U);
  EXPECT_NEAR(said.motions[1].end[1], -7, 1e-4);
}

TEST(CApi, WrongSetupsAreRefusedWithWhatIsWrong) {
  const struct {
    int input;
    std::vector<const char*> settings;
    const char* json;
    const char* names;
  } rows[] = {{0, {}, nullptr, "setup.input"},
              {TRC_INPUT_TEXT, {"tool_radious=5"}, nullptr, "tool_radius"},
              {TRC_INPUT_TEXT, {"tool_radius=5", "nothing"}, nullptr, "settings[1]"},
              {TRC_INPUT_TEXT, {nullptr}, nullptr, "settings[0]"},
              {TRC_INPUT_TEXT, {"tool_radius=1e9"}, nullptr, "setup.path.tool_radius"},
              {TRC_INPUT_BLOCKS, {"max_passive_blocks=0"}, nullptr, "setup.max_passive_blocks"},
              {TRC_INPUT_BLOCKS, {"tools=1:5"}, nullptr, "tools"},
              {TRC_INPUT_BLOCKS, {}, "{\"path\": {}}", "path"},
              {TRC_INPUT_TEXT, {}, "{", "json"},
              {TRC_INPUT_TEXT, {}, "{\"fileName\": \"\xff\"}", "json"},
              {TRC_INPUT_TEXT, {}, "{\"path\": {\"resumeToken\": \"AAAA\"}}", "resume_token"}};
  for (const auto& row : rows) {
    int status = TRC_OK;
    EXPECT_FALSE(create(row.input, row.settings, row.json, &status)) << row.names;
    EXPECT_EQ(status, TRC_ARGUMENT) << row.names;
    EXPECT_NE(std::string(trc_last_error()).find(row.names), std::string::npos)
        << row.names << ": " << trc_last_error();
  }
}

TEST(CApi, NothingAtAllIsRefusedAndNeverRead) {
  trc_session* session = nullptr;
  trc_setup setup{};
  EXPECT_EQ(trc_create(nullptr, &session), TRC_ARGUMENT);
  EXPECT_EQ(trc_create(&setup, nullptr), TRC_ARGUMENT);
  for (const std::size_t size : {std::size_t{0}, sizeof setup - 1, std::size_t{1} << 40}) {
    setup.size = size;
    EXPECT_EQ(trc_create(&setup, &session), TRC_ARGUMENT);
    EXPECT_NE(std::string(trc_last_error()).find("sizeof(trc_setup)"), std::string::npos);
    EXPECT_EQ(session, nullptr);
  }
  setup.size = sizeof setup;
  setup.input = TRC_INPUT_TEXT;
  setup.setting_count = 1;
  EXPECT_EQ(trc_create(&setup, &session), TRC_ARGUMENT);
  setup.setting_count = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(trc_create(&setup, &session), TRC_ARGUMENT);

  trc_answer answer{};
  trc_summary summary{};
  EXPECT_EQ(trc_feed_text(nullptr, "", 0), TRC_ARGUMENT);
  EXPECT_EQ(trc_feed_blocks(nullptr, nullptr, 0, sizeof(trc_block)), TRC_ARGUMENT);
  EXPECT_EQ(trc_finish(nullptr), TRC_ARGUMENT);
  EXPECT_EQ(trc_next(nullptr, &answer), TRC_ARGUMENT);
  EXPECT_EQ(trc_summarize(nullptr, &summary), TRC_ARGUMENT);
  trc_free(nullptr);

  const Session text = create(TRC_INPUT_TEXT, {});
  const Session blocks = create(TRC_INPUT_BLOCKS, {});
  EXPECT_EQ(trc_feed_text(text.get(), nullptr, 1), TRC_ARGUMENT);
  EXPECT_EQ(trc_feed_text(text.get(), nullptr, 0), TRC_OK);
  EXPECT_EQ(trc_feed_blocks(blocks.get(), nullptr, 1, sizeof(trc_block)), TRC_ARGUMENT);
  EXPECT_EQ(trc_feed_blocks(blocks.get(), nullptr, 0, sizeof(trc_block)), TRC_OK);
  EXPECT_EQ(trc_feed_blocks(blocks.get(), nullptr, 0, 0), TRC_ARGUMENT);
  EXPECT_EQ(trc_feed_text(blocks.get(), "", 0), TRC_ORDER);
  EXPECT_EQ(trc_feed_blocks(text.get(), nullptr, 0, sizeof(trc_block)), TRC_ORDER);
  EXPECT_EQ(trc_next(text.get(), nullptr), TRC_ARGUMENT);
  EXPECT_EQ(trc_next(text.get(), &answer), TRC_ARGUMENT);
  EXPECT_EQ(trc_summarize(text.get(), nullptr), TRC_ARGUMENT);
  EXPECT_EQ(trc_summarize(text.get(), &summary), TRC_ARGUMENT);
  summary.size = sizeof summary;
  EXPECT_EQ(trc_summarize(text.get(), &summary), TRC_ORDER);
  EXPECT_EQ(trc_finish(blocks.get()), TRC_OK);
  EXPECT_EQ(trc_finish(blocks.get()), TRC_OK);
  EXPECT_EQ(trc_feed_blocks(blocks.get(), nullptr, 0, sizeof(trc_block)), TRC_ORDER);
  EXPECT_STREQ(trc_version(), "0.1.0");
}

// A program made with a later header, with members that this library does not know.
TEST(CApi, LargerStructuresAreTakenWhereTheySayNothingNew) {
  struct Later {
    trc_setup setup;
    std::uint64_t more;
  } later{};
  later.setup.size = sizeof later;
  later.setup.input = TRC_INPUT_BLOCKS;
  trc_session* made = nullptr;
  later.more = 1;
  EXPECT_EQ(trc_create(&later.setup, &made), TRC_ARGUMENT);
  EXPECT_NE(std::string(trc_last_error()).find("newer"), std::string::npos);
  later.more = 0;
  ASSERT_EQ(trc_create(&later.setup, &made), TRC_OK);
  const Session session(made);

  struct LaterBlock {
    trc_block block;
    std::uint64_t more;
  };
  std::vector<LaterBlock> blocks = {{line(10, 0), 0}, {line(20, 0), 0}};
  EXPECT_EQ(trc_feed_blocks(made, &blocks[0].block, 2, sizeof(LaterBlock)), TRC_OK);
  blocks[1].more = 1;
  EXPECT_EQ(trc_feed_blocks(made, &blocks[0].block, 2, sizeof(LaterBlock)), TRC_ARGUMENT);
  EXPECT_EQ(std::string(trc_last_error()).rfind("block 3: ", 0), 0U) << trc_last_error();
  EXPECT_EQ(trc_finish(made), TRC_OK);

  struct LaterAnswer {
    trc_answer answer;
    std::uint64_t more;
  } answer{};
  answer.answer.size = sizeof answer;
  answer.more = 7;
  EXPECT_EQ(trc_next(made, &answer.answer), TRC_OK);
  EXPECT_EQ(answer.answer.size, sizeof answer);
  EXPECT_EQ(answer.more, 0U);
}

// The layout and the numbers that programs have been compiled with must not change.
TEST(CApi, StructuresKeepTheirLayout) {
  if (sizeof(void*) != 8) GTEST_SKIP() << "counted for pointers of 8 bytes";
  EXPECT_EQ(sizeof(trc_setup), 32U);
  EXPECT_EQ(sizeof(trc_axis), 16U);
  EXPECT_EQ(sizeof(trc_block), 104U);
  EXPECT_EQ(offsetof(trc_block, text), 96U);
  EXPECT_EQ(offsetof(trc_motion, text), 152U);
  EXPECT_EQ(offsetof(trc_diagnostic, point), 96U);
  EXPECT_EQ(sizeof(trc_answer), 48U);
  EXPECT_EQ(offsetof(trc_summary, clearance_wall), 144U);
}

TEST(CApi, SessionsWorkSideBySide) {
  const std::string text = content_of(source_dir() + "/client/samples/bracket.nc");
  const auto compensated = [&text] {
    std::string last;
    for (int i = 0; i < 20; ++i) {
      const Session session = create(TRC_INPUT_TEXT, {"verify=report"});
      EXPECT_EQ(trc_feed_text(session.get(), text.data(), text.size()), TRC_OK);
      EXPECT_EQ(trc_finish(session.get()), TRC_OK);
      Said said;
      take(session.get(), said);
      EXPECT_TRUE(last.empty() || last == said.text);
      last = said.text;
    }
    return last;
  };
  std::string there;
  // A fault in one thread is not told to another one.
  std::thread other([&] { there = compensated(); });
  EXPECT_EQ(trc_finish(nullptr), TRC_ARGUMENT);
  const std::string wrong = trc_last_error();
  const std::string here = compensated();
  other.join();
  EXPECT_EQ(here, there);
  EXPECT_EQ(trc_last_error(), wrong);
  std::thread([] { EXPECT_STREQ(trc_last_error(), ""); }).join();
}

}  // namespace
}  // namespace trc::testing_support
