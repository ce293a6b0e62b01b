#include "core/session/contour_reader.h"

#include <utility>

namespace trc {

ContourReader::ContourReader(const SessionSetup& session)
    : interrupt_(session.compensator.interrupt),
      state_(program_setup(session), session.compensator.tolerances, diagnostics_, blocks_),
      reader_({}, state_, diagnostics_, interrupt_) {}

void ContourReader::read(std::string_view text, const Taker& take) {
  constexpr std::size_t bytes_per_piece = ProgramReader::bytes_between_questions;
  for (std::size_t at = 0; at < text.size(); at += bytes_per_piece) {
    if (interrupt_) interrupt_();
    feed(text.substr(at, bytes_per_piece));
    if (!take(this->take())) return;
  }
  while (resolve())
    if (!take(this->take())) return;
  take(finish());
}

void ContourReader::feed(std::string_view text) {
  reading_ = reading_ && reader_.feed(text, lines_);
  recycle();
}

void ContourReader::recycle() {
  for (LinePointer& line : lines_) reader_.recycle(std::move(line));
  lines_.clear();
}

bool ContourReader::resolve() {
  const bool is_left = reading_ && reader_.resolve(lines_);
  recycle();
  return is_left;
}

std::vector<Block> ContourReader::finish() {
  while (resolve()) continue;
  if (reading_) reader_.finish(lines_);
  recycle();
  return std::move(blocks_);
}

}  // namespace trc
