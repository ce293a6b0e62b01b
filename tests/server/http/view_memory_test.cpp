// Programs that unroll to millions of lines: work for a view goes in steps, and all that it takes
// from the heap is charged while it is taken.

#include "server/http/view/view_memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "proto/wire/setup.h"
#include "server/http/view/view_builder.h"
#include "server/http/view/view_contour.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server::http {
namespace {

constexpr std::size_t mib = 1U << 20U;

wire::ProgramSettings fanuc() {
  v1::ProgramSetup setup;
  setup.set_dialect(v1::DIALECT_FANUC);
  v1::Tool& tool = *setup.add_tools();
  tool.set_number(1);
  tool.set_radius(5);
  wire::FieldFaults faults;
  wire::ProgramSettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  EXPECT_TRUE(faults.empty());
  return settings;
}

std::string repeated(int rounds, const std::string& lines) {
  return "#1=0\nWHILE[#1LT" + std::to_string(rounds) + "]DO1\n#1=#1+1\n" + lines + "END1\n";
}

// A contour, then lines that repeat; the tool does not fit into `width`.
std::string contour(int width, const std::string& repeated_lines) {
  const std::string x = std::to_string(width);
  return "O1\nG21 G90 G17\nG0 X-20 Y-20\nG41 G1 X0 Y0 D1 F1000\nY50\nX" + x +
         "\nY0\nX0\nG40 X-20 Y-20\n" + repeated_lines + "M30\n";
}

// How often the first look passes.
int passes_of(const std::string& text) {
  int passes = 0;
  static_cast<void>(first_look(text, fanuc().path.session, [&] { ++passes; }));
  return passes;
}

std::unique_ptr<ViewBuilder> builder_of(const std::string& text, Memory& memory) {
  return std::make_unique<ViewBuilder>(
      ViewedProgram{.text = std::make_shared<const std::string>(text), .settings = fanuc()}, memory,
      [] { return false; });
}

std::shared_ptr<View> view_of(const std::string& text, Memory& memory) {
  return builder_of(text, memory)->finish("view", {});
}

TEST(FirstLook, PassesWhileAProgramIsUnrolled) {
  const std::string moves = "O1\nG21 G91\n" + repeated(20'000, "G0 X1\nX-1\n") + "M30\n";
  EXPECT_GT(passes_of(moves), 100);
  const std::string nothing = "O1\nG21 G91\n" + repeated(50'000, "") + "M30\n";
  EXPECT_GT(passes_of(nothing), 100);
}

TEST(FirstLook, EndsWhereTheToolIsKnown) {
  EXPECT_LT(passes_of(contour(50, repeated(50'000, "G0 X1\nX-1\n"))), 10);
}

TEST(FirstLook, KnowsPlaneAndUnitOfAProgramThatComputes) {
  const auto look = [](const std::string& text) {
    return first_look(text, fanuc().path.session, {});
  };
  const FirstLook late = look("O1\nG20 G90 G17\n" + repeated(1000, "G0 X#1 Y#1\n") +
                              "G18\nG41 G1 X0 Z0 D1 F50\nX50\nM30\n");
  EXPECT_TRUE(late.moves);
  EXPECT_TRUE(late.is_inch);
  EXPECT_EQ(late.plane, Plane::zx);
  const FirstLook without = look("O1\nG21 G90 G18\n" + repeated(1000, "G0 X#1\n") + "M30\n");
  EXPECT_TRUE(without.moves);
  EXPECT_FALSE(without.is_inch);
  EXPECT_EQ(without.plane, Plane::zx);
}

TEST(ViewMemory, IsWhatTheHeapGave) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  Memory all(4 * mib);
  ViewMemory memory(all);
  std::vector<char> held;
  {
    ViewMemory::Turn turn(memory, {});
    held.resize(3 * mib);
    EXPECT_TRUE(turn.has_room());
    EXPECT_GE(all.used_bytes(), 3 * mib);
    EXPECT_FALSE(turn.has_room(2 * mib));
    EXPECT_THROW(turn.check(2 * mib), NoMemory);
    std::vector<char>().swap(held);
    EXPECT_TRUE(turn.has_room(2 * mib));
  }
  EXPECT_LT(all.used_bytes(), mib);
}

// Freeing something else must not make it look smaller than it is.
TEST(ViewMemory, DoesNotCountWhatIsGivenUpForIt) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  Memory all(4 * mib);
  auto other = std::make_unique<ViewMemory>(all);
  std::vector<char> of_other;
  {
    ViewMemory::Turn turn(*other, {});
    of_other.resize(3 * mib);
  }
  const ViewMemory::MakeRoom make_room = [&] {
    std::vector<char>().swap(of_other);
    other.reset();
    return true;
  };
  ViewMemory memory(all);
  ViewMemory::Turn turn(memory, make_room);
  const std::vector<char> held(2 * mib);
  EXPECT_TRUE(turn.has_room());
  EXPECT_GE(memory.bytes(), 2 * mib);
  EXPECT_GE(all.used_bytes(), 2 * mib);
}

// Its contour is read from the text, and goes on after the error.
TEST(RefusedView, IsReadInStepsAndWithinItsMemory) {
  const std::string text = contour(1, repeated(100'000, "G4 P1\n"));
  Memory much(1024 * mib);
  int passes = 0;
  const auto builder = builder_of(text, much);
  builder->set_refused();
  EXPECT_NE(builder->finish("view", [&] { ++passes; }), nullptr);
  EXPECT_GT(passes, 100);

  if (!counts_heap) return;
  Memory little(4 * mib);
  const auto poor = builder_of(contour(1, repeated(100'000, "G0 X#1\n")), little);
  poor->set_refused();
  EXPECT_EQ(poor->finish("view", {}), nullptr);
}

TEST(CompensatedText, IsChargedByWhatItTakes) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  // 60 MB, of a program of 60 KB.
  const std::string text = contour(50, repeated(1000, "(" + std::string(60'000, 'A') + ")\n"));
  Memory much(512 * mib);
  const auto rich = view_of(text, much);
  ASSERT_NE(rich, nullptr);
  const std::size_t before = much.used_bytes();
  std::size_t most = 0;
  rich->make_output([&] { most = std::max(most, much.used_bytes()); }, {});
  ASSERT_NE(rich->output(), nullptr);
  EXPECT_FALSE(rich->lacks_output());
  EXPECT_GT(rich->output()->text().size(), 60'000'000U);
  EXPECT_GE(much.used_bytes() - before, rich->output()->text().size());
  EXPECT_GE(most, much.used_bytes());

  Memory little(16 * mib);
  const auto poor = view_of(text, little);
  ASSERT_NE(poor, nullptr);
  const std::size_t of_view = little.used_bytes();
  poor->make_output([] {}, {});
  EXPECT_EQ(poor->output(), nullptr);
  EXPECT_TRUE(poor->lacks_output());
  EXPECT_FALSE(poor->said_by_now().measuring());
  // All that it took is given back.
  EXPECT_LT(little.used_bytes(), of_view + mib / 4);
}

// Other views are given up for it first.
TEST(CompensatedText, AsksForRoom) {
  if (!counts_heap) GTEST_SKIP() << "the heap is not counted";
  const std::string text = contour(50, repeated(100, "(" + std::string(60'000, 'A') + ")\n"));
  Memory memory(64 * mib);
  const auto view = view_of(text, memory);
  ASSERT_NE(view, nullptr);
  Share others(memory);
  ASSERT_TRUE(others.take(60 * mib));
  view->make_output([] {},
                    [&] {
                      others.release();
                      return true;
                    });
  EXPECT_NE(view->output(), nullptr);
}

}  // namespace
}  // namespace trc::server::http
