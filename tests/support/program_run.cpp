#include "tests/support/program_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/trc/result/listing.h"
#include "tests/support/english_words.h"

namespace trc::support {
namespace {

ProgramRun run(std::string_view program, const ProgramSessionSetup& setup, std::size_t piece,
               German german) {
  ProgramSession session(setup);
  Answers answers;
  bool goes_on = true;
  const std::size_t step = piece == 0 ? std::max<std::size_t>(program.size(), 1) : piece;
  for (std::size_t at = 0; goes_on && at < program.size(); at += step)
    goes_on = session.feed(program.substr(at, step), answers);
  if (goes_on) session.finish(answers);
  Answer out = answers.take();
  if (german == German::checked) {
    for (const Diagnostic& found : out.diagnostics) EXPECT_EQ(english_word_in_german(found), "");
  }
  ProgramRun made;
  made.blocks = std::move(out.blocks);
  made.diagnostics = std::move(out.diagnostics);
  made.stopped = session.diagnostics().stopped();
  made.text = std::move(out.text);
  return made;
}

}  // namespace

std::string ProgramRun::listing() const { return listing_of(blocks); }

std::string ProgramRun::codes() const {
  std::string all;
  for (const Diagnostic& found : diagnostics) {
    if (!all.empty()) all += "; ";
    all += std::to_string(static_cast<int>(found.code));
    all += " at line " + std::to_string(found.source.line);
  }
  return all;
}

std::string ProgramRun::report() const {
  std::string lines;
  for (const Diagnostic& found : diagnostics) {
    lines += std::to_string(found.source.line) + ": ";
    lines += std::to_string(static_cast<int>(found.code)) + ' ' + message_of(found) + '\n';
  }
  return lines;
}

ProgramRun to_text(std::string_view program, ProgramSessionSetup setup, std::size_t piece,
                   German german) {
  setup.nc_text = true;
  return run(program, setup, piece, german);
}

ProgramRun to_blocks(std::string_view program, ProgramSessionSetup setup, std::size_t piece,
                     German german) {
  setup.nc_text = false;
  return run(program, setup, piece, german);
}

ProgramSessionSetup with_decimals(int decimals) {
  ProgramSessionSetup setup;
  setup.session.program.decimals = decimals;
  return setup;
}

Eigen::Vector3d point_in_space(const CompensatedBlock& block, double t) {
  const double height = block.normal.from + t * (block.normal.to - block.normal.from);
  const Position place = from_plane(block.plane, point_at(block.path, t), height);
  return {place[0], place[1], place[2]};
}

std::string listing_of(const std::vector<CompensatedBlock>& blocks) {
  std::string lines;
  for (const CompensatedBlock& block : blocks) {
    append_listing(lines, block);
    lines += '\n';
  }
  return lines;
}

}  // namespace trc::support
