#include <array>
#include <stdexcept>
#include <string>

#include "core/messages/diagnostic_text.h"
#include "core/session/program_session.h"
#include "core/trc/compensator.h"
#include "core/trc/pass.h"
#include "core/trc/passes/bottlenecks.h"
#include "core/trc/passes/contour_masking.h"
#include "core/trc/passes/contour_violations.h"
#include "core/trc/passes/convert_circles.h"
#include "core/trc/passes/inside_corner.h"
#include "core/trc/passes/kerf_masking.h"
#include "core/trc/passes/loop_removal.h"
#include "core/trc/passes/offset.h"
#include "core/trc/passes/relevant_blocks.h"
#include "core/trc/passes/reporting.h"
#include "core/trc/passes/split.h"
#include "core/trc/passes/transitions.h"
#include "core/trc/result/refused_way.h"
#include "tests/bench/part.h"
#include "tests/bench/timed.h"

// The core without text or wire: the whole pipeline, then what each of its passes takes of it.
// Time a programmed block.

namespace trc::bench {
namespace {

CompensatorSetup setup() { return {}; }

void require(bool going, Diagnostics& diagnostics) {
  if (!going) throw std::runtime_error(message_of(diagnostics.take().back()));
}

void pipeline(benchmark::State& state, Engine engine) {
  Diagnostics diagnostics;
  CompensatorSetup given = setup();
  given.engine = engine;
  Compensator compensator(given, diagnostics);
  std::vector<CompensatedBlock> out;
  std::vector<Block> batch = part().approach;
  require(compensator.feed(batch, out), diagnostics);
  run_timed(
      state, Part::blocks_per_lap, [&] { batch = part().lap_blocks; },
      [&] {
        out.clear();
        compensator.feed_until_report(batch, out);
        require(!diagnostics.stopped(), diagnostics);
      });
}

// The order of Compensator, a lap at a time instead of a block, with a clock between the passes.
class Passes {
 public:
  static constexpr std::array<const char*, 12> names{
      "relevant blocks", "convert circles", "kerf masking", "offset",
      "inside corner",   "contour masking", "transitions",  "loop removal",
      "violations",      "clearance",       "split",        "reporting"};

  void feed(const std::vector<Block>& blocks) {
    programmed_ = blocks;
    next_ = 0;
    timed([&] {
      return advance(relevant_blocks_, programmed_, path_.blocks, Input::more, checkpoint_);
    });
    timed([&] { return apply(convert_circles_, path_.blocks); });
    timed([&] { return advance(kerf_masking_, path_, Input::more, checkpoint_); });
    timed([&] { return apply(offset_, path_.blocks); });
    timed([&] { return advance(inside_corner_, path_, Input::more, checkpoint_); });
    timed([&] { return advance(contour_masking_, path_, Input::more, checkpoint_); });
    timed([&] { return advance(transitions_, path_, Input::more, checkpoint_); });
    timed([&] { return advance(loop_removal_, path_, Input::more, checkpoint_); });
    timed([&] { return apply(contour_violations_, path_.blocks); });
    timed([&] { return advance(bottlenecks_, path_, Input::more, checkpoint_); });
    timed([&] { return advance(split_, path_, Input::more, checkpoint_); });
    timed([&] {
      out_.clear();
      return advance(reporting_, path_.blocks, out_, Input::more, checkpoint_);
    });
  }

  // Of the last lap.
  [[nodiscard]] double seconds(std::size_t pass) const { return seconds_[pass]; }

 private:
  template <class Work>
  void timed(Work work) {
    const double begin = cpu_seconds();
    const bool going = work();
    seconds_[next_++] = cpu_seconds() - begin;
    require(going, diagnostics_);
  }

  Diagnostics diagnostics_;
  Checkpoint checkpoint_{{}};
  std::optional<RefusedWay> refused_way_;
  RelevantBlocks relevant_blocks_{setup(), diagnostics_, refused_way_};
  ConvertCircles convert_circles_{setup().tolerances};
  KerfMasking kerf_masking_{true, setup().tolerances};
  Offset offset_{setup().tolerances, diagnostics_};
  InsideCorner inside_corner_{setup().limits.selection_blocks, setup().tolerances, diagnostics_,
                              checkpoint_, refused_way_};
  ContourMasking contour_masking_{setup(), diagnostics_, checkpoint_};
  Transitions transitions_{setup().tolerances, diagnostics_, refused_way_};
  LoopRemoval loop_removal_{setup(), diagnostics_, checkpoint_};
  ContourViolations contour_violations_{setup().tolerances, diagnostics_};
  Bottlenecks bottlenecks_{setup(), diagnostics_, checkpoint_};
  Split split_{setup().tolerances};
  Reporting reporting_{setup(), diagnostics_};

  std::vector<Block> programmed_;
  OnTheWay<PathBlockPtr> path_;
  std::vector<CompensatedBlock> out_;
  std::array<double, names.size()> seconds_{};
  std::size_t next_ = 0;
};

void pass(benchmark::State& state, std::size_t number) {
  Passes passes;
  passes.feed(part().approach);
  for (auto _ : state) {
    passes.feed(part().lap_blocks);
    state.SetIterationTime(passes.seconds(number));
  }
  state.counters["each"] = per_item(Part::blocks_per_lap);
}

const bool registered = [] {
  add("core: blocks to blocks",
      [](benchmark::State& state) { pipeline(state, Engine::automatic); });
  add("core: blocks through all passes",
      [](benchmark::State& state) { pipeline(state, Engine::passes); });
  for (std::size_t number = 0; number < Passes::names.size(); ++number)
    add(("pass: " + std::string(Passes::names[number])).c_str(),
        [number](benchmark::State& state) { pass(state, number); });
  return true;
}();

}  // namespace
}  // namespace trc::bench
