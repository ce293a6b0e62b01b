// The output, read again without TRC, is the compensated path.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "core/nc/text/number_format.h"
#include "core/trc/result/listing.h"
#include "tests/session/random_program.h"
#include "tests/support/long_run.h"
#include "tests/support/program_run.h"
#include "tests/support/random.h"

namespace trc::support {
namespace {

std::uint64_t programs() { return is_long_run() ? 100'000 : 2'000; }

bool travels(const CompensatedBlock& block) {
  if (block.origin == Origin::passthrough) return false;
  if (is_arc(block.path) || start_of(block.path) != end_of(block.path)) return true;
  if (block.normal.moves()) return true;
  for (const AxisTravel& travel : block.tracking)
    if (travel.moves()) return true;
  return false;
}

std::vector<CompensatedBlock> travelling(const std::vector<CompensatedBlock>& blocks) {
  std::vector<CompensatedBlock> moving;
  for (const CompensatedBlock& block : blocks)
    if (travels(block)) moving.push_back(block);
  return moving;
}

double largest_difference(const Position& a, const Position& b) {
  double largest = 0;
  for (std::size_t axis = 0; axis < a.size(); ++axis)
    largest = std::max(largest, std::abs(a[axis] - b[axis]));
  return largest;
}

Position start_position(const CompensatedBlock& block) {
  return from_plane(block.plane, start_of(block.path), block.normal.from);
}

Position end_position(const CompensatedBlock& block) {
  return from_plane(block.plane, end_of(block.path), block.normal.to);
}

double tracking_end(const CompensatedBlock& block) {
  return block.tracking.empty() ? 0 : block.tracking[0].to;
}

// How far a point is from the line or circle of a segment.
double off(const Point& point, const Segment& segment) {
  if (const Arc* arc = std::get_if<Arc>(&segment))
    return std::abs((point - arc->center).norm() - radius_of(*arc));
  const Line& line = std::get<Line>(segment);
  const Vector along = line.end - line.start;
  if (along.norm() < 1e-9) return (point - line.start).norm();
  return std::abs(cross(along.normalized(), point - line.start));
}

Point middle(const Segment& segment) {
  if (const Arc* arc = std::get_if<Arc>(&segment)) {
    const Vector radial = arc->start - arc->center;
    return arc->center + std::cos(arc->sweep / 2) * radial +
           std::sin(arc->sweep / 2) * left_of(radial);
  }
  return (start_of(segment) + end_of(segment)) / 2;
}

std::string text_of(const CompensatedBlock& block) {
  std::string line;
  append_listing(line, block, {}, 6);
  return line;
}

// What is wrong with `read` as the rounded form of `path`; `unit`: of the last decimal, mm.
std::string difference(const std::vector<CompensatedBlock>& path,
                       const std::vector<CompensatedBlock>& read, double unit) {
  const double half = unit / 2 * (1 + 1e-6);
  std::size_t next = 0;
  Position at = path.empty() ? Position{} : start_position(path.front());
  double tracking_at = 0;
  for (const CompensatedBlock& block : path) {
    const Arc* arc = std::get_if<Arc>(&block.path);
    bool must_travel =
        arc != nullptr && std::abs(arc->sweep) > std::numbers::pi && radius_of(*arc) > 2 * unit;
    while (must_travel || largest_difference(at, end_position(block)) > half ||
           std::abs(tracking_at - tracking_end(block)) > half) {
      if (next == read.size()) return "nothing is read for " + text_of(block);
      const CompensatedBlock& part = read[next++];
      const std::string pair = text_of(part) + " is read for " + text_of(block);
      // What is shorter than a unit may belong to the block before, too.
      const bool telling = length_of(part.path) > unit;
      if (telling && part.rapid != block.rapid) return "rapid: " + pair;
      if (telling && !block.rapid && std::abs(part.feed - block.feed) > unit)
        return "feed: " + pair;
      if (part.plane != block.plane) return "plane: " + pair;
      if (off(middle(part.path), block.path) > 5.5 * unit) return "off the path: " + pair;
      if (off(end_of(part.path), block.path) > unit) return "end off the path: " + pair;
      at = end_position(part);
      tracking_at = tracking_end(part);
      must_travel = must_travel && length_of(part.path) <= 2 * unit;
    }
    // The lengths tell an arc from its complement.
  }
  if (next != read.size()) return "also read: " + text_of(read[next]);
  double length = 0;
  for (const CompensatedBlock& block : path) length += length_of(block.path);
  for (const CompensatedBlock& block : read) length -= length_of(block.path);
  if (std::abs(length) > 10 * unit * static_cast<double>(path.size() + read.size()))
    return "length differs by " + std::to_string(length);
  return {};
}

double unit_of(const std::string& program, int places) {
  const bool inch = program.find("G70") != std::string::npos;
  return inch ? 25.4 * std::pow(10, -(places + 1)) : std::pow(10, -places);
}

TEST(ReadBack, TextIsThePathToHalfAUnit) {
  std::uint64_t compensated = 0;
  for (std::uint64_t seed = 1; seed <= programs(); ++seed) {
    const std::string program = random_program(seed, true);
    const auto decimals = static_cast<int>(seed % 6);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", decimals " + std::to_string(decimals));
    const ProgramRun path = to_blocks(program);
    if (path.stopped) continue;
    ++compensated;
    const ProgramRun text = to_text(program, with_decimals(decimals));
    ASSERT_FALSE(text.stopped) << text.codes() << "\n" << program;
    const ProgramRun read = to_blocks(text.text);
    ASSERT_FALSE(read.stopped) << read.codes() << "\n" << program << "\n->\n" << text.text;
    for (const CompensatedBlock& block : read.blocks)
      ASSERT_TRUE(block.origin == Origin::uncompensated || block.origin == Origin::passthrough);
    ASSERT_EQ(
        difference(travelling(path.blocks), travelling(read.blocks), unit_of(program, decimals)),
        "")
        << program << "\n->\n"
        << text.text;
  }
  EXPECT_GT(compensated, programs() / 4);
}

TEST(ReadBack, ProgramWithoutCompensationComesOutByteForByte) {
  for (std::uint64_t seed = 1; seed <= programs(); ++seed) {
    const std::string program = random_program(seed, false);
    const ProgramRun run = to_text(program);
    ASSERT_FALSE(run.stopped) << run.codes() << "\n" << program;
    ASSERT_EQ(run.text, program) << "seed " << seed;
  }
}

TEST(ReadBack, OutputIsItsOwnOutput) {
  std::uint64_t compensated = 0;
  for (std::uint64_t seed = 1; seed <= programs() / 4; ++seed) {
    const ProgramRun once = to_text(random_program(seed, true));
    if (once.stopped) continue;
    ++compensated;
    ASSERT_EQ(to_text(once.text).text, once.text) << "seed " << seed;
  }
  EXPECT_GT(compensated, programs() / 16);
}

TEST(ReadBack, CutAnywhereGivesTheSameBytes) {
  for (std::uint64_t seed = 1; seed <= programs() / 20; ++seed) {
    const std::string program = random_program(seed, true);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ProgramRun whole = to_text(program);
    for (const std::size_t cut : {1U, 2U, 3U, 7U, 64U}) {
      const ProgramRun pieces = to_text(program, {}, cut);
      ASSERT_EQ(pieces.text, whole.text) << "cut " << cut;
      ASSERT_EQ(pieces.codes(), whole.codes()) << "cut " << cut;
    }
  }
}

// Changes, doubles and drops bytes. Where the result is a program, its output has to be one.
std::string damaged(std::string program, std::uint64_t seed) {
  static constexpr std::string_view bytes = "0123456789.-+=GMXYZIJKRFNS%()[];#/\\ \n\r\tA\xC3";
  support::Random random(seed);
  for (std::size_t i = 1 + random.below(3); i > 0; --i) {
    const std::size_t at = random.below(program.size());
    switch (random.below(4)) {
      case 0:
        program[at] = bytes[random.below(bytes.size())];
        break;
      case 1:
        program.insert(at, 1, bytes[random.below(bytes.size())]);
        break;
      case 2:
        program.erase(at, 1 + random.below(5));
        break;
      default:
        program.insert(at, program.substr(random.below(program.size()), random.below(40)));
    }
    if (program.empty()) program = " ";
  }
  return program;
}

TEST(ReadBack, DamagedTextIsRefusedOrWrittenAsAProgram) {
  std::uint64_t accepted = 0;
  for (std::uint64_t seed = 1; seed <= programs(); ++seed) {
    const std::string program = damaged(random_program(seed, true), seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ProgramRun run = to_text(program);
    const ProgramRun pieces = to_text(program, {}, 1 + seed % 13);
    ASSERT_EQ(pieces.text, run.text) << program;
    ASSERT_EQ(pieces.codes(), run.codes()) << program;
    if (run.stopped) {
      ASSERT_FALSE(run.diagnostics.empty());
      ASSERT_EQ(run.diagnostics.back().severity, Severity::error);
      continue;
    }
    ++accepted;
    // Damage may spell the inch word in another way, so its unit counts for all.
    const double inch_unit = 25.4 * std::pow(10, -5);
    const ProgramRun read = to_blocks(run.text);
    ASSERT_FALSE(read.stopped) << read.codes() << "\n" << program << "\n->\n" << run.text;
    ASSERT_EQ(difference(travelling(to_blocks(program).blocks), travelling(read.blocks), inch_unit),
              "")
        << program << "\n->\n"
        << run.text;
  }
  EXPECT_GT(accepted, programs() / 20);
}

}  // namespace
}  // namespace trc::support
