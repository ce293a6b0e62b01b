#include <cmath>
#include <cstdint>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/nc/dialect/interpreter.h"
#include "core/nc/writer/nc_writer.h"
#include "core/session/program_session.h"
#include "tests/bench/part.h"
#include "tests/bench/timed.h"

// NC text: reading it, writing it, and the whole way from text to text in one process. Time a line
// of the program, each of which is a block.

namespace trc::bench {
namespace {

void require(bool going) {
  if (!going) throw std::runtime_error("the sample contour is refused");
}

void words(benchmark::State& state) {
  run_timed(
      state, Part::blocks_per_lap, [] {},
      [] {
        std::string_view rest = part().lap;
        while (!rest.empty()) {
          const std::size_t end = rest.find('\n');
          WordReader reader(rest.substr(0, end));
          for (Word word = reader.next(); word.kind != WordKind::end; word = reader.next())
            benchmark::DoNotOptimize(word);
          rest.remove_prefix(end + 1);
        }
      });
}

// The lap in Klartext, a line a block too: arcs by their radius.
std::string in_klartext() {
  std::ostringstream text;
  text << std::showpos << std::fixed << std::setprecision(4);
  for (const Block& block : part().lap_blocks) {
    const Segment& path = std::get<MotionBlock>(block).path;
    const Point end = end_of(path);
    const Arc* arc = std::get_if<Arc>(&path);
    text << (arc == nullptr ? "L X" : "CR X") << end.x() << " Y" << end.y();
    if (arc != nullptr)
      text << " R" << (std::copysign(radius_of(*arc), std::numbers::pi - std::abs(arc->sweep)))
           << (arc->sweep < 0 ? " DR-" : " DR+");
    text << '\n';
  }
  return text.str();
}

std::string_view lap_of(DialectName dialect) {
  static const std::string klartext = in_klartext();
  return dialect == DialectName::heidenhain ? std::string_view(klartext) : part().lap;
}

// Text and blocks of a lap, read again and again.
class Reading {
 public:
  explicit Reading(DialectName dialect = DialectName::isg)
      : lap_(lap_of(dialect)),
        state_(setup_of(dialect), {}, diagnostics_, blocks),
        interpreter_({}, state_, diagnostics_) {
    require(interpreter_.feed(dialect == DialectName::isg          ? part().prologue
                              : dialect == DialectName::heidenhain ? klartext_prologue
                                                                   : plain_prologue,
                              lines));
  }

  void forget() {
    for (LinePointer& line : lines) interpreter_.recycle(std::move(line));
    lines.clear();
    blocks.clear();
  }
  void lap() { require(interpreter_.feed(lap_, lines)); }

 private:
  Diagnostics diagnostics_;

 public:
  std::vector<Block> blocks;
  std::vector<LinePointer> lines;

 private:
  // Of the dialects that know no words of ISG.
  static constexpr std::string_view klartext_prologue = "L X+0 Y+0 R0 FMAX\nL X+1 Y+0 RL F600\n";
  static constexpr std::string_view plain_prologue = "G0 X0 Y0\nG1 F600\nG41 D1 X1 Y0\n";
  static ProgramSetup setup_of(DialectName dialect) {
    ProgramSetup setup;
    setup.dialect = dialect;
    setup.mode.tool_radius = 1;
    return setup;
  }

  std::string_view lap_;
  ProgramState state_;
  Interpreter interpreter_;
};

void reading_as(benchmark::State& state, DialectName dialect) {
  Reading reading(dialect);
  run_timed(
      state, Part::blocks_per_lap, [] {},
      [&] {
        reading.forget();
        reading.lap();
      });
}

NcWriter::Meaning meaning_of(const MotionBlock& motion) {
  return {.gives_block = true, .end = from_plane(Plane::xy, end_of(motion.path), motion.normal.to)};
}

void writing_as(benchmark::State& state, DialectName dialect) {
  Reading reading(dialect);
  Diagnostics diagnostics;
  Compensator compensator({}, diagnostics);
  NcWriter writer({.spelling = {.points = dialect_of(dialect).writes_points,
                                .klartext = dialect == DialectName::heidenhain}});
  std::vector<CompensatedBlock> compensated;
  std::vector<std::pair<std::uint64_t, NcWriter::Meaning>> meanings;  // by Source::index
  std::string text;
  const auto prepare = [&] {
    std::vector<Block> blocks = std::exchange(reading.blocks, {});
    meanings.clear();
    for (const Block& block : blocks)
      if (const auto* motion = std::get_if<MotionBlock>(&block))
        meanings.emplace_back(motion->source.index, meaning_of(*motion));
    compensated.clear();
    require(compensator.feed(blocks, compensated));
    text.clear();
  };
  const auto write = [&] {
    std::size_t motion = 0;
    for (LinePointer& line : reading.lines) {
      NcWriter::Meaning meaning{};
      if (motion < meanings.size() && meanings[motion].first == line->source.index)
        meaning = meanings[motion++].second;
      writer.take(std::move(line), meaning);
    }
    for (const CompensatedBlock& block : compensated) writer.write(block, text);
  };
  prepare();
  write();
  run_timed(
      state, Part::blocks_per_lap,
      [&] {
        reading.lines.clear();
        writer.release_lines([&](LinePointer line) { reading.lines.push_back(std::move(line)); });
        reading.forget();
        reading.lap();
        prepare();
      },
      write);
}

// Numbers and words alone: every compensated block as a line.
void motions(benchmark::State& state) {
  Diagnostics diagnostics;
  Compensator compensator({}, diagnostics);
  std::vector<CompensatedBlock> compensated;
  std::vector<Block> blocks = part().approach;
  require(compensator.feed(blocks, compensated));
  blocks = part().lap_blocks;
  require(compensator.feed(blocks, compensated));
  MotionWriter writer(4, "");
  TextBuffer text;
  WrittenState written;
  const TrackingTravel none;
  run_timed(
      state, compensated.size(), [&] { text.clear(); },
      [&] {
        for (const CompensatedBlock& block : compensated) {
          const Position end = from_plane(Plane::xy, end_of(block.path), 0);
          const MotionWriter::Axes axes{.end = end, .tracking = none};
          if (const Arc* arc = std::get_if<Arc>(&block.path))
            writer.append_arc(text, {*arc, writer.numbers_of(*arc, Plane::xy, written)}, axes,
                              written);
          else
            writer.append_line(text, MotionKind::linear, axes, written);
        }
      });
}

void program(benchmark::State& state, bool nc_text) {
  ProgramSession session({.nc_text = nc_text});
  Answers out([](const Answer& /*part*/) { return true; });
  require(session.feed(part().prologue, out));
  run_timed(
      state, Part::blocks_per_lap, [] {}, [&] { require(session.feed(part().lap, out)); });
}

const bool registered = [] {
  add("nc: words", words);
  add("nc: reading", [](benchmark::State& state) { reading_as(state, DialectName::isg); });
  add("nc: reading, fanuc", [](benchmark::State& state) { reading_as(state, DialectName::fanuc); });
  add("nc: reading, linuxcnc",
      [](benchmark::State& state) { reading_as(state, DialectName::linuxcnc); });
  add("nc: reading, sinumerik",
      [](benchmark::State& state) { reading_as(state, DialectName::sinumerik); });
  add("nc: reading, heidenhain",
      [](benchmark::State& state) { reading_as(state, DialectName::heidenhain); });
  add("nc: writing", [](benchmark::State& state) { writing_as(state, DialectName::isg); });
  add("nc: writing, fanuc", [](benchmark::State& state) { writing_as(state, DialectName::fanuc); });
  add("nc: writing, heidenhain",
      [](benchmark::State& state) { writing_as(state, DialectName::heidenhain); });
  add("nc: motion words", motions);
  add("nc: text to blocks", [](benchmark::State& state) { program(state, false); });
  return add("nc: text to text", [](benchmark::State& state) { program(state, true); });
}();

}  // namespace
}  // namespace trc::bench
