#include "tests/bench/part.h"

#include <stdexcept>
#include <string_view>

#include "client/load/sample_program.h"
#include "core/nc/dialect/interpreter.h"

namespace trc::bench {
namespace {

std::string sample_program() {
  std::string text;
  const std::string fault =
      load::generate({.shape = "random", .blocks = 2 * Part::blocks_per_lap}, [&](auto piece) {
        text += piece;
        return true;
      });
  if (!fault.empty()) throw std::logic_error(fault);
  return text;
}

// Takes so many lines off the front.
std::string take_lines(std::string_view& text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t line = 0; line < count; ++line) end = text.find('\n', end) + 1;
  const std::string lines(text.substr(0, end));
  text.remove_prefix(end);
  return lines;
}

Part make_part() {
  const std::string program = sample_program();
  std::string_view rest = program;
  Part part;
  part.prologue = take_lines(rest, 3);
  part.prologue += "G26\n";
  part.prologue += take_lines(rest, 1);
  part.lap = take_lines(rest, Part::blocks_per_lap);

  Diagnostics diagnostics;
  std::vector<Block> blocks;
  std::vector<LinePointer> lines;
  ProgramState state({}, {}, diagnostics, blocks);
  Interpreter interpreter({}, state, diagnostics);
  interpreter.feed(part.prologue, lines);
  part.approach = blocks;
  blocks.clear();
  interpreter.feed(part.lap, lines);
  part.lap_blocks = blocks;
  if (diagnostics.stopped() || part.lap_blocks.size() != Part::blocks_per_lap)
    throw std::logic_error("the sample contour cannot be read");
  return part;
}

}  // namespace

const Part& part() {
  static const Part made = make_part();
  return made;
}

}  // namespace trc::bench
