#include "tests/programs/written.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "tests/support/english_words.h"

namespace trc::support {

std::string Written::report() const {
  std::ostringstream out;
  for (const Diagnostic& found : diagnostics)
    out << found.source.line << ": " << static_cast<int>(found.code) << ' ' << message_of(found)
        << '\n';
  return out.str();
}

Written run(const std::string& text, ProgramSessionSetup setup, bool nc_text, std::size_t piece) {
  setup.nc_text = nc_text;
  ProgramSession session(setup);
  Answers answers;
  bool running = true;
  const std::size_t step = piece == 0 ? std::max<std::size_t>(text.size(), 1) : piece;
  for (std::size_t at = 0; running && at < text.size(); at += step)
    running = session.feed(std::string_view(text).substr(at, step), answers);
  if (running) session.finish(answers);
  Answer output = answers.take();
  for (const Diagnostic& found : output.diagnostics) EXPECT_EQ(english_word_in_german(found), "");
  return {.text = std::move(output.text),
          .blocks = std::move(output.blocks),
          .diagnostics = std::move(output.diagnostics),
          .stopped = session.diagnostics().stopped()};
}

Eigen::Vector3d place_at(const CompensatedBlock& block, double t) {
  const double height = block.normal.from + t * (block.normal.to - block.normal.from);
  const Position place = from_plane(block.plane, point_at(block.path, t), height);
  return {place[0], place[1], place[2]};
}

}  // namespace trc::support
