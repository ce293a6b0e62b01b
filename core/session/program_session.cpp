#include "core/session/program_session.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>

#include "core/nc/program/program_reader.h"
#include "core/nc/text/number_format.h"
#include "core/nc/writer/nc_writer.h"
#include "core/trc/state_archive.h"

namespace trc {
namespace {

// Text is read in pieces of this size, so that lines and blocks on their way
// stay few however long a chunk is.
constexpr std::size_t bytes_per_piece = 8 * 1024;

// After so many lines in a row that give no block, they come out if no block is
// on its way; if one is, they may take so many bytes.
constexpr std::uint64_t silent_lines_per_release = 256;
constexpr std::size_t most_silent_bytes = 16 * 1024 * 1024;

NcWriter::Setup writer_setup(const ProgramSessionSetup& setup) {
  const ProgramSetup& program = setup.session.program;
  const Dialect& dialect = dialect_of(program.dialect);
  const bool klartext = dialect.name == DialectName::heidenhain;
  // Decimals out of range are refused before anything is written.
  NcWriter::Setup writer{.decimals = std::clamp(program.decimals, 0, most_decimals - 1),
                         .start = program.start,
                         .motion = dialect.motion.value_or(MotionKind::rapid),
                         .absolute_center = program.absolute_center || klartext,
                         .plane = program.mode.plane,
                         .inch = program.inch,
                         .spelling = {.points = dialect.writes_points, .klartext = klartext},
                         .renumbers = program.renumbers};
  for (const std::string& axis : program.tracking_axes) {
    writer.tracking_letters += axis.size() == 1 ? axis.front() : '?';
    writer.tracking_names.push_back(axis.size() == 1 ? "" : axis);
  }
  return writer;
}

constexpr double same_place = 1e-9;  // mm

void add(const Block& block, NcWriter::Meaning& meaning) {
  meaning.gives_block = true;
  std::visit(
      [&](const auto& given) {
        const Plane plane = given.mode->plane;
        if constexpr (std::is_same_v<decltype(given), const MotionBlock&>) {
          const Point before = to_plane(plane, meaning.end);
          meaning.keeps_place = given.mode->active() && given.mode->tool_radius == 0 &&
                                (start_of(given.path) - before).norm() <= same_place;
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

// The reader gives lines to the writer and what they mean to the path. It runs ahead of both by up
// to one piece of text: the path brings what it finds into the order of the program, and the writer
// holds each line until a block comes from behind it.
struct ProgramSession::Parts {
  explicit Parts(const ProgramSessionSetup& given)
      : setup(given),
        path(setup.session),
        reader({.longest_line = setup.longest_line, .most_faults = setup.most_faults},
               path.program(), path.found(), setup.session.compensator.interrupt),
        writer(writer_setup(setup)),
        meaning{.end = setup.session.program.start},
        to_writer([this](Answer& part) { return write(part); }) {
    const int decimals = setup.session.program.decimals;
    if (decimals >= 0 && decimals < most_decimals) return;
    Diagnostic invalid = diagnostic(Code::field_invalid, {}, "decimals");
    invalid.values = {{"decimals", static_cast<double>(decimals)}};
    path.stop(std::move(invalid));
  }

  [[nodiscard]] bool stopped() const { return path.diagnostics().stopped(); }
  // Where the path answers to.
  [[nodiscard]] Answers& path_out() { return setup.nc_text ? to_writer : *output; }

  // Reads: `read` gives lines and blocks.
  template <class Read>
  auto reading(const Read& read) {
    const std::size_t before = path.waiting().size();
    const auto result = read();
    const std::span<const Block> waiting = path.waiting();
    if (setup.blocks_read && waiting.size() > before) setup.blocks_read(waiting.subspan(before));
    return result;
  }
  // Compensates and writes what has been read.
  void advance();
  bool take(LinePointer& given);
  bool release_silent_lines(const ProgramLine& line);
  bool end(const ProgramLine& line);
  bool write(Answer& part);

  // All lines read have been taken when a call has ended, but for those of a corner.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(path, reader, writer, lines, next_item, meaning, silent_lines, ended);
  }

  ProgramSessionSetup setup;
  PathSession path;
  ProgramReader reader;
  NcWriter writer;

  std::vector<LinePointer> lines;
  std::size_t blocks_taken = 0;    // of those that wait for the path: of the lines taken
  std::uint64_t next_item = 0;     // behind the lines taken
  NcWriter::Meaning meaning{};     // of the last line taken
  std::uint64_t silent_lines = 0;  // taken in a row
  bool ended = false;              // by M02 or M30
  Answers to_writer;
  Answers* output = nullptr;  // of the call
};

void ProgramSession::Parts::advance() {
  blocks_taken = 0;
  // Of a corner that waits for its second motion the lines wait as well.
  const auto held =
      std::ranges::find_if(lines, [index = path.program().held_from()](const LinePointer& line) {
        return line->source.index >= index;
      });
  bool goes_on = !stopped();
  for (LinePointer& line : std::span(lines.begin(), held)) {
    goes_on = goes_on && take(line);
    if (!setup.nc_text) reader.recycle(std::move(line));
  }
  lines.erase(lines.begin(), held);
  // A line with a fault gives nothing, also where reading goes on for more of them.
  if (path.found().stopped())
    path.advance(path_out());
  else
    path.advance_before(next_item, path_out());
  writer.release_lines([this](LinePointer line) { reader.recycle(std::move(line)); });
  if (!setup.nc_text && output->blocks().size() >= Compensator::portion) output->portion();
  output->hand_on();
}

bool ProgramSession::Parts::take(LinePointer& given) {
  const ProgramLine& line = *given;
  next_item = line.source.index + (line.has_words ? 1 : 0);
  // Behind a corner that has become blocks of its own the line begins elsewhere than it says.
  const std::uint32_t motions_before = std::exchange(meaning.motions, 0U);
  meaning.gives_block = meaning.keeps_place = false;
  meaning.moved = 0;
  const std::span<const Block> waiting = path.waiting();
  while (line.has_words && blocks_taken < waiting.size() &&
         index_of(waiting[blocks_taken]) == line.source.index)
    add(waiting[blocks_taken++], meaning);
  meaning.keeps_place &= meaning.motions == 1 && motions_before <= 1;
  if (meaning.motions == 0) meaning.motions = motions_before;
  if (setup.nc_text) {
    writer.take(std::move(given), meaning);
    silent_lines = meaning.gives_block ? 0 : silent_lines + 1;
    if (silent_lines >= silent_lines_per_release && !release_silent_lines(line)) return false;
  }
  const bool ends = line.ends_program && !std::exchange(ended, true);
  if (ends && !end(line)) return false;
  // Nothing can come before the lines behind the program end.
  if (ended && setup.nc_text) writer.finish(output->text());
  if (ends) path.end_item(path_out());
  return true;
}

// A matter of the lines taken, not of how they arrived: the output depends on it.
bool ProgramSession::Parts::release_silent_lines(const ProgramLine& line) {
  silent_lines = 0;
  blocks_taken = 0;
  const bool goes_on = line.has_words ? path.advance_through(line.source.index, path_out())
                                      : path.advance_before(next_item, path_out());
  if (!goes_on) return false;
  writer.write_silent_lines(output->text());
  path.end_item(path_out());
  if (writer.silent_bytes() <= most_silent_bytes) return true;
  Diagnostic overflow = diagnostic(Code::too_many_passive_blocks, line.source);
  overflow.values = {{"bytes", static_cast<double>(writer.silent_bytes())},
                     {"limit", static_cast<double>(most_silent_bytes)}};
  path.stop(std::move(overflow));
  return false;
}

bool ProgramSession::Parts::end(const ProgramLine& line) {
  blocks_taken = 0;
  return path.advance_through(line.source.index, path_out()) && path.end(path_out());
}

bool ProgramSession::Parts::write(Answer& part) {
  std::string& text = output->text();
  for (const CompensatedBlock& block : part.blocks) writer.write(block, text);
  output->tell(std::move(part.diagnostics));
  return output->wanted();
}

ProgramSession::ProgramSession(const ProgramSessionSetup& setup)
    : parts_(std::make_unique<Parts>(setup)) {}

ProgramSession::~ProgramSession() = default;

bool ProgramSession::feed(std::string_view text, Answers& out) {
  Parts& parts = *parts_;
  parts.output = &out;
  if (parts.stopped()) parts.advance();
  while (!text.empty() && !parts.stopped() && out.wanted()) {
    const std::string_view piece = text.substr(0, bytes_per_piece);
    text.remove_prefix(piece.size());
    parts.reading([&] { return parts.reader.feed(piece, parts.lines); });
    parts.advance();
  }
  return !parts.stopped() && out.wanted();
}

bool ProgramSession::resolve(Answers& out) {
  Parts& parts = *parts_;
  parts.output = &out;
  if (parts.stopped()) return false;
  const bool is_left = parts.reading([&] { return parts.reader.resolve(parts.lines); });
  parts.advance();
  return is_left && !parts.stopped() && out.wanted();
}

bool ProgramSession::finish(Answers& out) {
  while (resolve(out)) continue;
  if (!out.wanted()) return false;
  Parts& parts = *parts_;
  parts.output = &out;
  if (!parts.stopped()) {
    parts.reading([&] {
      parts.reader.finish(parts.lines);
      return true;
    });
    parts.advance();
    const bool goes_on = parts.path.advance(parts.path_out()) && parts.path.end(parts.path_out());
    if (goes_on && parts.setup.nc_text) parts.writer.finish(out.text());
  }
  parts.advance();
  return !parts.stopped() && out.wanted();
}

void ProgramSession::save(StateWriter& archive) const { archive(*parts_); }
void ProgramSession::load(StateReader& archive) { archive(*parts_); }

const Diagnostics& ProgramSession::diagnostics() const { return parts_->path.diagnostics(); }
const Summary& ProgramSession::summary() const { return parts_->path.summary(); }
const verify::ClearanceReport* ProgramSession::clearance() const {
  return parts_->path.clearance();
}
std::size_t ProgramSession::verification_bytes() const { return parts_->path.verification_bytes(); }
const RadiusTerms& ProgramSession::radius_terms() const { return parts_->path.radius_terms(); }
std::uint64_t ProgramSession::lines_read() const { return parts_->reader.lines_read(); }
bool ProgramSession::is_computing() const { return parts_->reader.is_computing(); }
std::uint64_t ProgramSession::executed_lines() const { return parts_->reader.executed_lines(); }

}  // namespace trc
