#include <algorithm>
#include <utility>

#include "core/nc/dialect/interpreter.h"
#include "core/nc/text/slip.h"

// How what cannot be read is told: its place, what was meant, all of a kind at once.

namespace trc {

// What was mistyped is named as a whole, with what was meant.
TextFault Interpreter::with_slip(const ProgramLine& line, TextFault fault) {
  constexpr std::array codes{Code::nc_syntax,   Code::nc_unknown_function, Code::nc_unsupported,
                             Code::nc_not_text, Code::nc_number,           Code::nc_axis_unknown};
  if (fault.slip.kind != SlipKind::none || std::ranges::find(codes, fault.code) == codes.end())
    return fault;
  auto found = slip_at(line.text, fault.begin);
  if (!found) return fault;
  fault.code = found->slip.kind == SlipKind::quotes ? Code::nc_syntax : Code::nc_number;
  fault.begin = static_cast<std::uint32_t>(found->begin);
  fault.detail = std::move(found->word);
  fault.slip = std::move(found->slip);
  return fault;
}

// The place of a fault is its physical line, also within a continued block.
bool Interpreter::refuse(const ProgramLine& line, const TextFault& given) {
  const TextFault fault = with_slip(line, given);
  Source source = line.source;
  std::size_t line_begin = 0;
  for (std::size_t at = 0; at < fault.begin && at < line.text.size(); ++at) {
    const bool ends =
        line.text[at] == '\n' || (line.text[at] == '\r' && line.text.compare(at, 2, "\r\n") != 0);
    if (!ends) continue;
    ++source.line;
    line_begin = at + 1;
  }
  Diagnostic refused = diagnostic(fault.code, source, fault.detail);
  if (knows_columns_)
    refused.column = line_begin == 0 ? column_of(fault.begin)
                                     : static_cast<std::uint32_t>(fault.begin - line_begin + 1);
  if (is_within_slip(refused)) return false;
  refused.slip = fault.slip;
  guard_against_other_dialects(line, refused);
  return collect(std::move(refused));
}

// The rest of a word that was told as a whole.
bool Interpreter::is_within_slip(const Diagnostic& found) const {
  if (faults_.empty() || faults_.back().slip.kind == SlipKind::none) return false;
  const Fault& told = faults_.back();
  return told.source.line == found.source.line && found.column > told.column &&
         found.column < told.column + told.detail.size();
}

bool Interpreter::refuse_at(const WordPlace& place, Code code, std::string detail) {
  Diagnostic refused = diagnostic(code, place.source, std::move(detail));
  refused.column = place.column;
  return collect(std::move(refused));
}

// What cannot be read as ISG, in a program that has no word of its own, may be of another dialect.
// Of a dialect that was declared that is said of Klartext alone, whose lines look like nothing
// else.
void Interpreter::guard_against_other_dialects(const ProgramLine& line, Diagnostic& fault) const {
  constexpr std::array codes{Code::nc_syntax, Code::nc_unknown_function, Code::nc_unsupported,
                             Code::nc_number, Code::nc_axis_unknown,     Code::nc_word_twice};
  const bool is_of_words = std::ranges::find(codes, fault.code) != codes.end();
  if (is_of_words && is_heidenhain_iso(line.text)) {
    fault.code = Code::nc_unsupported;
    fault.detail = "a block of DIN/ISO of Heidenhain";
    fault.slip = {};
    return;
  }
  if (is_of_words && dialect_.name == DialectName::isg && is_of_okuma(line.text)) {
    fault.code = Code::nc_unsupported;
    fault.detail = "a block of Okuma";
    fault.slip = {};
    return;
  }
  const bool mistyped =
      fault.slip.kind != SlipKind::none && fault.slip.kind != SlipKind::unit_of_another;
  if (isg_word_seen_ || mistyped || !is_of_words) return;
  const auto other = looks_like(line.text);
  const bool is_declared = dialect_.name != DialectName::isg;
  if (!other || *other == dialect_.name || (is_declared && *other != DialectName::heidenhain))
    return;
  fault.code = Code::other_dialect;
  fault.detail.append(", as in ").append(dialect_of(*other).spelling);
}

// Faults of one kind, word and reason alike, are one with the number of its lines.
bool Interpreter::collect(Diagnostic fault) {
  if (limits_.most_faults <= 1) return diagnostics_.report(std::move(fault));
  if (faults_.empty()) scanned_trc_ = state_.contour_open();
  reads_plain_lines_ = false;
  const auto alike = std::ranges::find_if(faults_, [&](const Fault& known) {
    return known.code == fault.code && known.detail == fault.detail;
  });
  if (alike != faults_.end()) {
    if (alike->last_line != fault.source.line) ++alike->lines;
    alike->last_line = fault.source.line;
    return false;
  }
  faults_.push_back({.code = fault.code,
                     .source = fault.source,
                     .column = fault.column,
                     .detail = std::move(fault.detail),
                     .slip = std::move(fault.slip),
                     .last_line = fault.source.line,
                     .calls = fault.calls.empty() ? diagnostics_.calls().of(fault.source.index)
                                                  : std::move(fault.calls),
                     .values = std::move(fault.values)});
  return faults_.size() >= limits_.most_faults && report_faults();
}

bool Interpreter::report_faults() { return diagnostics_.report_together(told_faults()); }

std::vector<Diagnostic> Interpreter::told_faults() const {
  // Which call each stands in has been seen when it was found.
  diagnostics_.calls().stand(blocks_read_, CallPlaces::main_program, 0);
  std::vector<Diagnostic> all;
  for (const Fault& fault : faults_) {
    Diagnostic found = diagnostic(fault.code, fault.source, fault.detail);
    found.column = fault.column;
    found.slip = fault.slip;
    found.calls = fault.calls;
    found.values = fault.values;
    if (fault.lines > 1) found.values.push_back({"lines", static_cast<double>(fault.lines)});
    all.push_back(std::move(found));
  }
  return all;
}

bool Interpreter::refuse(const ProgramLine& line, const Word& word, Code code, std::string detail) {
  if (detail.empty()) detail = line.text.substr(word.begin, word.end - word.begin);
  return refuse(line, TextFault{.code = code, .begin = word.begin, .detail = std::move(detail)});
}

}  // namespace trc
