#include "core/session/contour_reader.h"

#include <utility>

namespace trc {

ContourReader::ContourReader(const SessionSetup& session)
    : state_(program_setup(session), session.compensator.tolerances, diagnostics_, blocks_),
      interpreter_({}, state_, diagnostics_) {}

void ContourReader::feed(std::string_view text) {
  reading_ = reading_ && interpreter_.feed(text, lines_);
  for (LinePointer& line : lines_) interpreter_.recycle(std::move(line));
  lines_.clear();
}

std::vector<Block> ContourReader::finish() {
  if (reading_) interpreter_.finish(lines_);
  return std::move(blocks_);
}

}  // namespace trc
