#include "core/session/lines_to_writer.h"

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/tolerances.h"
#include "core/nc/writer/writer_setup.h"

namespace trc {
namespace {

// After this many lines in a row without a block, the lines come out if no block
// is on its way; otherwise they may take up to this many bytes.
constexpr std::uint64_t silent_lines_per_release = 256;
constexpr std::size_t most_silent_bytes = 16 * 1024 * 1024;

void add(const Block& block, NcWriter::Meaning& meaning) {
  meaning.gives_block = true;
  std::visit(
      [&](const auto& given) {
        const Plane plane = given.mode->plane;
        if constexpr (std::is_same_v<decltype(given), const MotionBlock&>) {
          const Point before = to_plane(plane, meaning.end);
          meaning.keeps_place = given.mode->active() && given.mode->tool_radius == 0 &&
                                (start_of(given.path) - before).norm() <= Tolerances{}.rounding;
          ++meaning.motions;
          meaning.end = from_plane(plane, end_of(given.path), given.normal.to);
        }
        const std::size_t third = axes_of(plane).third;
        meaning.end[third] = given.normal.to;
        if (given.normal.moves()) meaning.moved |= axis_bit(third);
        for (std::size_t axis = 0; axis < given.tracking.size(); ++axis)
          if (given.tracking[axis].moves()) meaning.moved |= axis_bit(meaning.end.size() + axis);
      },
      block);
}

}  // namespace

LinesToWriter::LinesToWriter(const ProgramSetup& setup, Form form, PathSession& path,
                             ProgramReader& reader)
    : form_(form),
      path_(path),
      reader_(reader),
      writer_(writer_setup(setup, dialect_of(setup.dialect))),
      meaning_{.end = setup.start},
      to_writer_([this](Answer& part) { return write(part); }) {}

void LinesToWriter::advance() {
  blocks_taken_ = 0;
  // While a corner waits for its second motion, its lines wait as well.
  const auto held =
      std::ranges::find_if(lines_, [index = path_.program().held_from()](const LinePointer& line) {
        return line->source.index >= index;
      });
  bool goes_on = !path_.diagnostics().stopped();
  for (LinePointer& line : std::span(lines_.begin(), held)) {
    goes_on = goes_on && take(line);
    if (!writes_text()) reader_.recycle(std::move(line));
  }
  lines_.erase(lines_.begin(), held);
  // A line with a fault gives no block, even if reading goes on to find more faults.
  if (path_.found().stopped())
    path_.advance(path_out());
  else
    path_.advance_before(next_item_, path_out());
  if (writer_.excess()) path_.end_item(path_out());
  writer_.release_lines([this](LinePointer line) { reader_.recycle(std::move(line)); });
  if (!writes_text() && output_->blocks().size() >= Compensator::blocks_per_portion)
    output_->portion();
  output_->hand_on();
}

bool LinesToWriter::take(LinePointer& given) {
  const ProgramLine& line = *given;
  next_item_ = line.source.index + (line.has_words ? 1 : 0);
  enter_meaning(line);
  if (writes_text() && !write_line(given)) return false;
  const bool ends = line.ends_program && !std::exchange(ended_, true);
  if (ends && !end_program(line)) return false;
  // No block can come before the lines after the program end.
  if (ended_ && writes_text()) writer_.finish(output_->text());
  if (ends) path_.end_item(path_out());
  return true;
}

void LinesToWriter::enter_meaning(const ProgramLine& line) {
  // After a corner that has become blocks of its own, the line begins elsewhere than it says.
  const std::uint32_t motions_before = std::exchange(meaning_.motions, 0U);
  meaning_.gives_block = meaning_.keeps_place = false;
  meaning_.moved = 0;
  const std::span<const Block> waiting = path_.waiting_blocks();
  while (line.has_words && blocks_taken_ < waiting.size() &&
         index_of(waiting[blocks_taken_]) == line.source.index)
    add(waiting[blocks_taken_++], meaning_);
  meaning_.keeps_place &= meaning_.motions == 1 && motions_before <= 1;
  if (meaning_.motions == 0) meaning_.motions = motions_before;
}

bool LinesToWriter::write_line(LinePointer& given) {
  const ProgramLine& line = *given;
  writer_.take(std::move(given), meaning_);
  silent_lines_ = meaning_.gives_block ? 0 : silent_lines_ + 1;
  return silent_lines_ < silent_lines_per_release || release_silent_lines(line);
}

// Depends on the lines taken, not on how they arrived, because it decides the output.
bool LinesToWriter::release_silent_lines(const ProgramLine& line) {
  silent_lines_ = 0;
  blocks_taken_ = 0;
  const bool goes_on = line.has_words ? path_.advance_through(line.source.index, path_out())
                                      : path_.advance_before(next_item_, path_out());
  if (!goes_on) return false;
  writer_.write_silent_lines(output_->text());
  path_.end_item(path_out());
  if (writer_.silent_bytes() <= most_silent_bytes) return true;
  Diagnostic overflow = diagnostic(Code::too_many_passive_blocks, line.source);
  overflow.values = {{"bytes", static_cast<double>(writer_.silent_bytes())},
                     {"limit", static_cast<double>(most_silent_bytes)}};
  path_.stop(std::move(overflow));
  return false;
}

bool LinesToWriter::end_program(const ProgramLine& line) {
  blocks_taken_ = 0;
  return path_.advance_through(line.source.index, path_out()) && path_.end(path_out());
}

void LinesToWriter::end() {
  const bool goes_on = path_.advance(path_out()) && path_.end(path_out());
  if (goes_on && writes_text()) writer_.finish(output_->text());
}

void LinesToWriter::refuse_line(const Source& source) {
  const NcWriter::Excess& excess = *writer_.excess();
  Diagnostic refused = diagnostic(Code::line_beyond_control, source);
  refused.values = {{excess.of == NcWriter::Excess::Of::digits ? "digits" : "characters",
                     static_cast<double>(excess.count)},
                    {"limit", static_cast<double>(excess.limit)}};
  path_.stop(std::move(refused));
}

bool LinesToWriter::write(Answer& part) {
  std::string& text = output_->text();
  for (const CompensatedBlock& block : part.blocks) {
    if (!writer_.excess()) writer_.write(block, text);
    if (writer_.excess() && !path_.diagnostics().stopped()) refuse_line(block.source);
  }
  output_->tell(std::move(part.diagnostics));
  return output_->wanted();
}

}  // namespace trc
