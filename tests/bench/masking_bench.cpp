#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/pages.h"
#include "core/messages/diagnostic_text.h"
#include "core/session/verified_compensator.h"
#include "tests/bench/workloads.h"

// The core from native blocks to native blocks: G140, and G141 with
// REMOVE_MASKED_BLOCKS over the whole contour, in a window, and over the whole contour with the
// path measured on its way.

namespace trc::bench {
namespace {

enum class Way { plain, whole, window, measured };

using Contours = std::vector<std::vector<Segment>>;

// Each contour is a selection of its own.
std::vector<Block> program(const Contours& contours, double tool_radius, Way way) {
  TrcMode off;
  off.transition = Transition::circular;
  off.selection = Selection::direct;
  off.tool_radius = tool_radius;
  if (way != Way::plain) {
    off.masking = Masking::on;
    off.options.remove_masked_blocks = true;
  }
  TrcMode on = off;
  on.side = Side::right;
  const auto deselected = std::make_shared<const TrcMode>(off);
  std::vector<Block> program;
  const auto add = [&](const Segment& path, const std::shared_ptr<const TrcMode>& mode) {
    program.emplace_back(
        MotionBlock{.source = {.index = program.size()}, .path = path, .feed = 1000, .mode = mode});
  };
  for (const std::vector<Segment>& contour : contours) {
    ++on.selection_number;
    const auto selected = std::make_shared<const TrcMode>(on);
    const Point start = start_of(contour.front());
    const Point outside = start + 3 * tool_radius * start.normalized();
    if (!program.empty())
      add(Line{.start = end_of(std::get<MotionBlock>(program.back()).path), .end = outside},
          deselected);
    add(Line{.start = outside, .end = start}, selected);
    for (const Segment& segment : contour) add(segment, selected);
    add(Line{.start = start, .end = outside}, deselected);
  }
  return program;
}

std::size_t bytes_in_use() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd + PagePiece::count() * PagePiece::bytes;
}

void compensate(benchmark::State& state, const std::vector<Block>& given, Way way) {
  const Line first = std::get<Line>(std::get<MotionBlock>(given.front()).path);
  CompensatorSetup setup;
  setup.start = {first.start.x(), first.start.y(), 0};
  setup.largest_masked_share = 1;  // all of the spiral's arm is left out in one stretch
  if (way == Way::window) setup.limits.look_ahead_blocks = 1000;
  std::size_t out_blocks = 0;
  const auto take = [&](std::vector<CompensatedBlock>& out) {
    out_blocks += out.size();
    out.clear();
  };
  std::size_t bytes_before = 0;
  std::size_t bytes_held = 0;  // when the last batch is still to come
  std::vector<Block> rest;
  for (auto _ : state) {
    state.PauseTiming();
    rest = given;
    bytes_before = bytes_in_use();
    state.ResumeTiming();
    Diagnostics diagnostics;
    VerifiedCompensator compensator(setup, way == Way::measured ? Verify::report : Verify::off,
                                    diagnostics);
    std::vector<CompensatedBlock> out;
    const auto release = [&] {
      for (take(out); compensator.is_releasing(); take(out)) compensator.release(out);
      if (!diagnostics.stopped()) static_cast<void>(diagnostics.take());
      return !diagnostics.stopped();
    };
    bool going = true;
    out_blocks = 0;
    for (std::span<Block> left(rest); !left.empty() && going;) {
      const auto batch = left.first(std::min<std::size_t>(left.size(), 1024));
      if (batch.size() == left.size()) bytes_held = bytes_in_use() - bytes_before;
      left = left.subspan(compensator.feed_until_report(batch, out));
      going = release();
    }
    if (going) compensator.finish_until_portion(TrcMode{}, out);
    going = going && release();
    if (!going) {
      state.SkipWithError(message_of(diagnostics.pending().back()).c_str());
      break;
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(given.size()));
  state.counters["blocks_out"] = static_cast<double>(out_blocks);
  state.counters["bytes_a_block"] =
      static_cast<double>(bytes_held) / static_cast<double>(given.size());
}

void compensate_workload(benchmark::State& state, const Workload& workload, Way way) {
  const auto blocks = static_cast<std::size_t>(state.range(0));
  compensate(state, program({workload.contour(blocks)}, workload.tool_radius, way), way);
}

// A regular polygon: no loop, transitions at all corners.
std::vector<Segment> ring(std::size_t blocks) {
  constexpr double radius = 20;
  const auto corner = [&](std::size_t number) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(number % blocks) / static_cast<double>(blocks);
    return Point(radius * std::cos(angle), radius * std::sin(angle));
  };
  std::vector<Segment> contour;
  for (std::size_t i = 0; i < blocks; ++i)
    contour.emplace_back(Line{.start = corner(i), .end = corner(i + 1)});
  return contour;
}

constexpr std::size_t small_blocks = 20'000;  // of all small selections together

benchmark::Counter each(std::size_t selections) {
  return {static_cast<double>(selections),
          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

// Most contours of CAM are small: many selections in one session …
void compensate_small(benchmark::State& state, Way way) {
  const auto blocks = static_cast<std::size_t>(state.range(0));
  const std::size_t selections = small_blocks / blocks;
  compensate(state, program(Contours(selections, ring(blocks)), 1, way), way);
  state.counters["selection"] = each(selections);
}

// … and a session for each.
void compensate_alone(benchmark::State& state, Way way) {
  const auto blocks = static_cast<std::size_t>(state.range(0));
  const std::vector<Block> given = program({ring(blocks)}, 1, way);
  const std::vector<std::vector<Block>> all(small_blocks / blocks, given);
  const Line first = std::get<Line>(std::get<MotionBlock>(given.front()).path);
  CompensatorSetup setup;
  setup.start = {first.start.x(), first.start.y(), 0};
  std::vector<CompensatedBlock> out;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<std::vector<Block>> rest = all;
    state.ResumeTiming();
    for (std::vector<Block>& one : rest) {
      Diagnostics diagnostics;
      VerifiedCompensator compensator(setup, Verify::off, diagnostics);
      out.clear();
      if (compensator.feed_until_report(one, out) == one.size() &&
          compensator.finish_until_portion(TrcMode{}, out))
        continue;
      state.SkipWithError("a small selection was refused");
      return;
    }
  }
  state.counters["selection"] = each(all.size());
}

void compensate_shapes(benchmark::State& state, const RealShapes& shapes, Way way) try {
  compensate(state, program(shapes.contours(), shapes.tool_radius, way), way);
} catch (const std::exception& missing) {
  state.SkipWithError(missing.what());
}

std::string name_of(const std::string& shape, double tool_radius, const char* way) {
  std::string radius = std::to_string(tool_radius);
  radius.erase(radius.find_last_not_of("0") + 1);
  if (radius.back() == '.') radius.pop_back();
  return shape + " R" + radius + " " + way;
}

constexpr std::pair<Way, const char*> ways[] = {{Way::plain, "G140"},
                                                {Way::whole, "removed"},
                                                {Way::window, "window 1000"},
                                                {Way::measured, "removed and measured"}};

// Growth is seen over the whole contour, with ten times as many again.
const bool registered = [] {
  for (const Workload& workload : workloads())
    for (const auto& [way, name] : ways) {
      auto* measured =
          benchmark::RegisterBenchmark(name_of(workload.name, workload.tool_radius, name).c_str(),
                                       compensate_workload, workload, way);
      measured->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
      if (way == Way::whole || way == Way::measured) measured->Arg(10'000)->Arg(10'000'000);
    }
  for (const auto& [way, name] : {ways[0], ways[1]})
    for (const auto& [run, of] : {std::pair{&compensate_small, "in one session "},
                                  std::pair{&compensate_alone, "a session each "}})
      benchmark::RegisterBenchmark((std::string("small selections, ") + of + name).c_str(), run,
                                   way)
          ->Arg(4)
          ->Arg(16)
          ->Arg(60)
          ->Arg(200)
          ->Unit(benchmark::kMillisecond);
  for (const RealShapes& shapes : real_shapes())
    for (const auto& [way, name] : ways)
      benchmark::RegisterBenchmark(name_of(shapes.name, shapes.tool_radius, name).c_str(),
                                   compensate_shapes, shapes, way)
          ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace trc::bench
