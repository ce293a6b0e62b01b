#include "tests/session/run_program.h"

#include <algorithm>

#include "core/trc/result/listing.h"

namespace trc::testing {

std::string ProgramRun::listing() const {
  std::string lines;
  for (const CompensatedBlock& block : blocks) {
    append_listing(lines, block);
    lines += '\n';
  }
  return lines;
}

std::string ProgramRun::reports() const {
  std::string all;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!all.empty()) all += "; ";
    all += std::to_string(static_cast<int>(diagnostic.code));
    all += " at line " + std::to_string(diagnostic.source.line);
  }
  return all;
}

ProgramRun to_text(std::string_view program, const ProgramSessionSetup& setup, std::size_t cut) {
  ProgramSession session(setup);
  Answers answers;
  bool goes_on = true;
  const std::size_t step = cut == 0 ? std::max<std::size_t>(program.size(), 1) : cut;
  for (std::size_t at = 0; goes_on && at < program.size(); at += step)
    goes_on = session.feed(program.substr(at, step), answers);
  if (goes_on) goes_on = session.finish(answers);
  Answer out = answers.take();
  return {.text = std::move(out.text),
          .blocks = std::move(out.blocks),
          .diagnostics = std::move(out.diagnostics),
          .completed = goes_on};
}

ProgramRun to_blocks(std::string_view program, ProgramSessionSetup setup) {
  setup.nc_text = false;
  return to_text(program, setup);
}

}  // namespace trc::testing
