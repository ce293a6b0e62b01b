#include "core/session/program_session.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>

#include "core/nc/dialect/interpreter.h"
#include "core/nc/text/number_format.h"
#include "core/nc/writer/nc_writer.h"
#include "core/trc/state_archive.h"

namespace trc {
namespace {

// Text is read in pieces of this size, so that lines and blocks on their way
// stay few however long a chunk is.
constexpr std::size_t bytes_per_piece = 8 * 1024;

// So many are handed on at once, where somebody takes them.
constexpr std::size_t blocks_per_portion = 1024;

// After so many lines in a row that give no block, they come out if no block is
// on its way; if one is, they may take so many bytes.
constexpr std::uint64_t silent_lines_per_release = 256;
constexpr std::size_t most_silent_bytes = 16 * 1024 * 1024;

NcWriter::Setup writer_setup(const ProgramSessionSetup& setup) {
  const ProgramSetup& program = setup.session.program;
  const bool klartext = program.dialect == DialectName::heidenhain;
  // Decimals out of range are refused before anything is written.
  NcWriter::Setup writer{
      .decimals = std::clamp(setup.decimals, 0, most_decimals - 1),
      .start = program.start,
      .absolute_center = program.absolute_center || klartext,
      .plane = program.mode.plane,
      .inch = program.inch,
      .spelling = {.points = dialect_of(program.dialect).writes_points, .klartext = klartext}};
  // Text has no word for an axis with a longer name.
  for (const std::string& axis : program.tracking_axes)
    writer.tracking_letters += axis.size() == 1 ? axis.front() : '?';
  return writer;
}

void add(const Block& block, NcWriter::Meaning& meaning) {
  meaning.gives_block = true;
  std::visit(
      [&](const auto& given) {
        const Plane plane = given.mode->plane;
        if constexpr (std::is_same_v<decltype(given), const MotionBlock&>)
          meaning.end = from_plane(plane, end_of(given.path), given.normal.to);
        const std::size_t third = axes_of(plane).third;
        meaning.end[third] = given.normal.to;
        if (given.normal.moves()) meaning.moved |= axis_bit(third);
        for (std::size_t axis = 0; axis < given.tracking.size(); ++axis)
          if (given.tracking[axis].moves()) meaning.moved |= axis_bit(meaning.end.size() + axis);
      },
      block);
}

}  // namespace

// Reading runs ahead of compensation by up to one piece of text. What it reports
// waits in a log of its own until the blocks before that line are compensated:
// output and diagnostics come in the order of the program, however it is cut.
struct ProgramSession::Parts {
  explicit Parts(const ProgramSessionSetup& given)
      : setup(given),
        program(program_setup(setup.session), setup.session.compensator.tolerances,
                read_diagnostics, blocks),
        interpreter({.longest_line = setup.longest_line, .most_faults = setup.most_faults}, program,
                    read_diagnostics),
        compensator(compensator_setup(), setup.session.verify, diagnostics),
        writer(writer_setup(setup)),
        meaning{.end = setup.session.program.start} {
    diagnostics.speak(setup.session.language);
    diagnostics.count_as(read_diagnostics.units());
    if (const Dialect& dialect = dialect_of(setup.session.program.dialect); !dialect.available)
      diagnostics.report(diagnostic(Code::not_available, {},
                                    std::string("the dialect ").append(dialect.spelling)));
    if (setup.decimals >= 0 && setup.decimals < most_decimals) return;
    Diagnostic invalid = diagnostic(Code::field_invalid, {}, "decimals");
    invalid.values = {{"decimals", static_cast<double>(setup.decimals)}};
    diagnostics.report(std::move(invalid));
  }

  CompensatorSetup compensator_setup();

  // Compensates what has been read. Returns whether the stream goes on.
  bool advance(ProgramOutput& out);
  bool take(LinePointer& given, ProgramOutput& out);
  bool release_silent_lines(const Source& source, ProgramOutput& out);
  // Reports what reading found up to this line, behind the blocks before it.
  bool report_until(std::uint32_t line, ProgramOutput& out);
  // Compensates the blocks of all lines taken.
  bool compensate(ProgramOutput& out);
  // Gives what was reported since the last time its place: at the end of a line.
  void place(ProgramOutput& out);
  bool end(ProgramOutput& out);
  void hand_out(std::vector<CompensatedBlock>& given);

  // All lines read have been taken when a call has ended, but for those of a corner; a helix gives
  // blocks of several turns, of which the last waits for its corner.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(read_diagnostics, diagnostics, program, interpreter, compensator, writer, meaning,
            silent_lines, ended, lines, blocks);
  }

  ProgramSessionSetup setup;
  Diagnostics read_diagnostics;
  Diagnostics diagnostics;
  std::vector<Block> blocks;
  ProgramState program;
  Interpreter interpreter;
  VerifiedCompensator compensator;
  NcWriter writer;

  std::vector<LinePointer> lines;
  std::vector<Diagnostic> reported;  // by the reader; the first `reports_taken` are passed on
  std::size_t reports_taken = 0;
  std::size_t blocks_taken = 0;  // of `blocks`: those of the lines taken
  std::vector<CompensatedBlock> compensated;
  ProgramOutput* output = nullptr;  // of the call
  std::size_t placed = 0;           // of the pending diagnostics
  NcWriter::Meaning meaning{};      // of the last line taken
  std::uint64_t line_taken = 0;     // its Source::index
  std::uint64_t silent_lines = 0;
  bool ended = false;
};

CompensatorSetup ProgramSession::Parts::compensator_setup() {
  CompensatorSetup result = setup.session.compensator;
  result.start = setup.session.program.start;
  result.take_portion = [this](std::vector<CompensatedBlock>& given) { hand_out(given); };
  return result;
}

bool ProgramSession::Parts::advance(ProgramOutput& out) {
  reported = read_diagnostics.take();
  reports_taken = 0;
  bool goes_on = true;
  // Of a corner that waits for its second motion the lines wait as well.
  const auto held =
      std::ranges::find_if(lines, [index = program.held_from()](const LinePointer& line) {
        return line->source.index >= index;
      });
  for (LinePointer& line : std::span(lines.begin(), held)) {
    goes_on = goes_on && take(line, out);
    if (goes_on && diagnostics.pending().size() > placed) {
      goes_on = compensate(out);
      place(out);
    }
    if (!setup.nc_text) interpreter.recycle(std::move(line));
  }
  lines.erase(lines.begin(), held);
  goes_on =
      goes_on && report_until(std::numeric_limits<std::uint32_t>::max(), out) && compensate(out);
  place(out);
  writer.release_lines([this](LinePointer line) { interpreter.recycle(std::move(line)); });
  return goes_on;
}

bool ProgramSession::Parts::take(LinePointer& given, ProgramOutput& out) {
  const ProgramLine& line = *given;
  line_taken = line.source.index;
  if (reports_taken < reported.size() && !report_until(line.source.line, out)) return false;
  meaning.gives_block = false;
  meaning.moved = 0;
  while (line.has_words && blocks_taken < blocks.size() &&
         index_of(blocks[blocks_taken]) == line.source.index)
    add(blocks[blocks_taken++], meaning);
  const bool ends_program = line.ends_program;
  if (setup.nc_text) {
    const Source source = line.source;
    writer.take(std::move(given), meaning);
    silent_lines = meaning.gives_block ? 0 : silent_lines + 1;
    if (silent_lines >= silent_lines_per_release && !release_silent_lines(source, out))
      return false;
  }
  if (ends_program && !end(out)) return false;
  // Nothing can come before the lines behind the program end.
  if (ended && setup.nc_text) writer.finish(out.text);
  return true;
}

// A matter of the lines taken, not of how they arrived: the output depends on it.
bool ProgramSession::Parts::release_silent_lines(const Source& source, ProgramOutput& out) {
  silent_lines = 0;
  if (!compensate(out)) return false;
  writer.write_silent_lines(out.text);
  if (writer.silent_bytes() <= most_silent_bytes) return true;
  Diagnostic overflow = diagnostic(Code::too_many_passive_blocks, source);
  overflow.values = {{"bytes", static_cast<double>(writer.silent_bytes())},
                     {"limit", static_cast<double>(most_silent_bytes)}};
  return diagnostics.report(std::move(overflow));
}

bool ProgramSession::Parts::report_until(std::uint32_t line, ProgramOutput& out) {
  for (; reports_taken < reported.size(); ++reports_taken) {
    Diagnostic& next = reported[reports_taken];
    if (next.source.line > line) break;
    if (diagnostics.stopped() && !next.found_together) return false;
    if (!diagnostics.stopped()) {
      if (!compensate(out)) return false;
      // Where nothing is selected, all that was read before an error is certain.
      if (next.severity == Severity::error && !program.contour_open() && !end(out)) return false;
    }
    diagnostics.report(std::move(next));
  }
  return !diagnostics.stopped();
}

bool ProgramSession::Parts::compensate(ProgramOutput& out) {
  std::span<Block> taken(blocks.data(), blocks_taken);
  while (!taken.empty() && !diagnostics.stopped()) {
    const std::size_t count = compensator.feed_until_report(taken, compensated);
    const bool line_goes_on = index_of(taken[count - 1]) == line_taken;
    taken = taken.subspan(count);
    hand_out(compensated);
    if (!line_goes_on) place(out);
  }
  blocks.erase(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(blocks_taken));
  blocks_taken = 0;
  return !diagnostics.stopped();
}

void ProgramSession::Parts::place(ProgramOutput& out) {
  const std::size_t reports = diagnostics.pending().size();
  if (reports == placed) return;
  out.places.push_back({.blocks = out.blocks_before + out.blocks.size(),
                        .bytes = out.text.size(),
                        .diagnostics = reports});
  placed = reports;
}

bool ProgramSession::Parts::end(ProgramOutput& out) {
  if (std::exchange(ended, true)) return true;
  if (!compensate(out)) return false;
  const bool goes_on = compensator.finish(program.mode(), compensated);
  hand_out(compensated);
  return goes_on;
}

void ProgramSession::Parts::hand_out(std::vector<CompensatedBlock>& given) {
  if (setup.nc_text) {
    for (const CompensatedBlock& block : given) writer.write(block, output->text);
  } else {
    output->blocks.insert(output->blocks.end(), std::make_move_iterator(given.begin()),
                          std::make_move_iterator(given.end()));
    const TakePortion& take = setup.session.compensator.take_portion;
    if (take && output->blocks.size() >= blocks_per_portion) take(output->blocks);
  }
  given.clear();
}

ProgramSession::ProgramSession(const ProgramSessionSetup& setup)
    : parts_(std::make_unique<Parts>(setup)) {}

ProgramSession::~ProgramSession() = default;

bool ProgramSession::feed(std::string_view text, ProgramOutput& out) {
  Parts& parts = *parts_;
  parts.output = &out;
  parts.placed = parts.diagnostics.pending().size();
  while (!text.empty() && !parts.diagnostics.stopped()) {
    const std::string_view piece = text.substr(0, bytes_per_piece);
    text.remove_prefix(piece.size());
    parts.interpreter.feed(piece, parts.lines);
    parts.advance(out);
  }
  return !parts.diagnostics.stopped();
}

bool ProgramSession::finish(ProgramOutput& out) {
  Parts& parts = *parts_;
  if (parts.diagnostics.stopped()) return false;
  parts.output = &out;
  parts.placed = parts.diagnostics.pending().size();
  parts.interpreter.finish(parts.lines);
  if (!parts.advance(out) || !parts.end(out)) return false;
  if (parts.setup.nc_text) parts.writer.finish(out.text);
  return true;
}

void ProgramSession::save(StateWriter& archive) const { archive(*parts_); }
void ProgramSession::load(StateReader& archive) { archive(*parts_); }

Diagnostics& ProgramSession::diagnostics() { return parts_->diagnostics; }
const Summary& ProgramSession::summary() const { return parts_->compensator.summary(); }
const verify::ClearanceReport* ProgramSession::clearance() const {
  return parts_->compensator.clearance();
}
std::size_t ProgramSession::verification_bytes() const {
  return parts_->compensator.verification_bytes();
}
const RadiusTerms& ProgramSession::radius_terms() const { return parts_->program.tool().terms(); }
std::uint64_t ProgramSession::lines_read() const { return parts_->interpreter.lines_read(); }

}  // namespace trc
