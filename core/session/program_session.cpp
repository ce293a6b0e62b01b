#include "core/session/program_session.h"

#include <span>
#include <utility>

#include "core/nc/program/program_reader.h"
#include "core/nc/text/number_format.h"
#include "core/session/lines_to_writer.h"
#include "core/trc/state_archive.h"

namespace trc {
namespace {

// Lines and blocks of this much text at most are on their way through the session: they stay few
// however long a chunk is.
constexpr std::size_t bytes_on_their_way = 8 * 1024;

}  // namespace

// The reader gives lines to the writer and their blocks to the path. It runs ahead of both by up
// to one piece of text: the path brings diagnostics into the order of the program, and the writer
// holds each line until a block from after it comes (LinesToWriter).
struct ProgramSession::Parts {
  explicit Parts(const ProgramSessionSetup& given)
      : setup(given),
        path(setup.session),
        reader({.longest_line = setup.longest_line, .most_faults = setup.most_faults},
               path.program(), path.found(), setup.session.compensator.interrupt),
        lines(setup.session.program,
              setup.nc_text ? LinesToWriter::Form::nc_text : LinesToWriter::Form::blocks, path,
              reader) {
    const int decimals = setup.session.program.decimals.value_or(default_decimals);
    if (decimals >= 0 && decimals < most_decimals) return;
    Diagnostic invalid = diagnostic(Code::field_invalid, {}, "decimals");
    invalid.values = {{"decimals", static_cast<double>(decimals)}};
    path.stop(std::move(invalid));
  }

  [[nodiscard]] bool stopped() const { return path.diagnostics().stopped(); }

  // Calls `read`, which gives lines and blocks, and passes the new blocks to `blocks_read`.
  template <class Read>
  auto reading(const Read& read) {
    const std::size_t before = path.waiting_blocks().size();
    const auto result = read();
    const std::span<const Block> waiting = path.waiting_blocks();
    if (setup.blocks_read && waiting.size() > before) setup.blocks_read(waiting.subspan(before));
    return result;
  }

  // At the end of a call all lines read have been taken, except those of a corner.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(path, reader, lines);
  }

  ProgramSessionSetup setup;
  PathSession path;
  ProgramReader reader;
  LinesToWriter lines;
};

ProgramSession::ProgramSession(const ProgramSessionSetup& setup)
    : parts_(std::make_unique<Parts>(setup)) {}

ProgramSession::~ProgramSession() = default;

bool ProgramSession::feed(std::string_view text, Answers& out) {
  Parts& parts = *parts_;
  parts.lines.answer_to(out);
  if (parts.stopped()) parts.lines.advance();
  while (!text.empty() && !parts.stopped() && out.wanted()) {
    const std::string_view piece = text.substr(0, bytes_on_their_way);
    text.remove_prefix(piece.size());
    parts.reading([&] { return parts.reader.feed(piece, parts.lines.read()); });
    parts.lines.advance();
  }
  return !parts.stopped() && out.wanted();
}

bool ProgramSession::resolve(Answers& out) {
  Parts& parts = *parts_;
  parts.lines.answer_to(out);
  if (parts.stopped()) return false;
  const bool is_left = parts.reading([&] { return parts.reader.resolve(parts.lines.read()); });
  parts.lines.advance();
  return is_left && !parts.stopped() && out.wanted();
}

bool ProgramSession::finish(Answers& out) {
  while (resolve(out)) continue;
  if (!out.wanted()) return false;
  Parts& parts = *parts_;
  parts.lines.answer_to(out);
  if (!parts.stopped()) {
    parts.reading([&] {
      parts.reader.finish(parts.lines.read());
      return true;
    });
    parts.lines.advance();
    parts.lines.end();
  }
  parts.lines.advance();
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
