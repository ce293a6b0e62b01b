#include "core/session/contour_reader.h"

#include <utility>

namespace trc {

ContourReader::ContourReader(const SessionSetup& session)
    : state_(program_setup(session), session.compensator.tolerances, diagnostics_, blocks_),
      reader_({}, state_, diagnostics_) {}

void ContourReader::feed(std::string_view text) {
  reading_ = reading_ && reader_.feed(text, lines_);
  recycle();
}

void ContourReader::recycle() {
  for (LinePointer& line : lines_) reader_.recycle(std::move(line));
  lines_.clear();
}

std::vector<Block> ContourReader::finish() {
  if (reading_) {
    while (reader_.resolve(lines_)) recycle();
    reader_.finish(lines_);
  }
  return std::move(blocks_);
}

}  // namespace trc
