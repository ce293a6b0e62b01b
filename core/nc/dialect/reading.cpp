#include "core/nc/dialect/reading.h"

#include <algorithm>
#include <utility>

#include "core/base/reasons.h"
#include "core/nc/state/variable_name.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/slip.h"

// The initial state of a program, and how faults of reading are reported: with the place, the
// likely intention, and all faults of a kind at once.

namespace trc {
namespace {

// Names a mistyped word as a whole, with its likely intention. In Klartext a decimal comma is none.
TextFault with_slip(const ProgramLine& line, TextFault fault, DialectName dialect) {
  constexpr std::array codes{Code::nc_syntax,   Code::nc_unknown_function, Code::nc_unsupported,
                             Code::nc_not_text, Code::nc_number,           Code::nc_axis_unknown};
  if (fault.slip.kind != SlipKind::none || std::ranges::find(codes, fault.code) == codes.end())
    return fault;
  auto found = slip_at(line.text, fault.begin);
  if (!found) return fault;
  if (found->slip.kind == SlipKind::decimal_comma && dialect == DialectName::heidenhain)
    return fault;
  fault.code = found->slip.kind == SlipKind::quotes ? Code::nc_syntax : Code::nc_number;
  fault.begin = static_cast<std::uint32_t>(found->begin);
  fault.detail = std::move(found->word);
  fault.slip = std::move(found->slip);
  return fault;
}

}  // namespace

Reading::Reading(const ReaderLimits& limits_of_text, ProgramState& state_of_program,
                 Diagnostics& diagnostics_of_program)
    : limits(limits_of_text),
      dialect(dialect_of(state_of_program.setup().dialect)),
      state(state_of_program),
      diagnostics(diagnostics_of_program),
      in_front_of_tape(dialect.name == DialectName::fanuc || dialect.name == DialectName::linuxcnc),
      motion(dialect.motion.value_or(MotionKind::rapid)),
      motion_given(dialect.motion.has_value()),
      unit(state.setup().length_unit()),
      reads_plain_lines(dialect.name == DialectName::isg) {
  diagnostics.units().count_in(unit, 0);
  state.set_length_unit(unit);
  // Programs of ISG begin with G71.
  gcode.assumed_unit.holds = state.setup().unit_is_assumed && dialect.name != DialectName::isg;
  if (dialect.name == DialectName::heidenhain) {
    state.set_absolute_center(true);
    for (const auto& [name, value] : state.setup().variables) {
      const std::string parameter = plain_variable_name(name, dialect.name);
      if (parameter.starts_with('Q')) klartext_modes.parameters[parameter] = value;
    }
  }
  axis_of_letter.fill(-1);
  for (const char main : {'X', 'Y', 'Z'})
    axis_of_letter[static_cast<std::size_t>(main - 'A')] = static_cast<std::int16_t>(main - 'X');
  std::int16_t index = 3;
  for (const std::string& name : state.setup().tracking_axes) {
    if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z') {
      std::int16_t& axis = axis_of_letter[static_cast<std::size_t>(name[0] - 'A')];
      if (axis < 0) axis = index;
    }
    ++index;
  }
}

void Reading::count_in(const ProgramLine& line, LengthUnit lengths) {
  unit = lengths;
  state.set_length_unit(unit);
  diagnostics.units().count_in(unit, line.source.index);
}

void Reading::keep_length(const ProgramLine& line, std::string_view what) {
  GcodeModes::AssumedUnit& assumed = gcode.assumed_unit;
  if (!assumed.holds || assumed.line > 0) return;
  assumed.line = line.source.line;
  assumed.kept = what;
}

bool Reading::say_unit(const ProgramLine& line, std::uint32_t begin, LengthUnit lengths) {
  const GcodeModes::AssumedUnit assumed = std::exchange(gcode.assumed_unit, {});
  if (!assumed.holds || lengths == unit) return true;
  if (assumed.line > 0) {
    const std::size_t end = line.text.find_first_not_of("Gg0123456789", begin);
    return refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = begin,
                        .detail = line.text.substr(begin, end - begin) + ", after " + assumed.kept +
                                  " in line " + std::to_string(assumed.line) + ", read in mm"});
  }
  state.forget_lengths(line.source);
  return true;
}

void Reading::place(const ProgramLine& line, std::uint32_t begin) {
  state.place(column_in(line, begin));
}

WordPlace Reading::place_of_word(const ProgramLine& line, std::uint32_t begin) const {
  return {.source = line.source, .column = column_in(line, begin)};
}

// The place of a fault is its physical line, also within a continued block.
bool Reading::refuse(const ProgramLine& line, const TextFault& given) {
  const TextFault fault = with_slip(line, given, dialect.name);
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
  if (knows_columns)
    refused.column = line_begin == 0 ? column_of(fault.begin)
                                     : static_cast<std::uint32_t>(fault.begin - line_begin + 1);
  if (is_within_slip(refused)) return false;
  refused.slip = fault.slip;
  guard_against_other_dialects(line, refused);
  return collect(std::move(refused));
}

// Whether the fault lies in a word that has been reported as a whole.
bool Reading::is_within_slip(const Diagnostic& found) const {
  if (faults.empty() || faults.back().slip.kind == SlipKind::none) return false;
  const Fault& told = faults.back();
  return told.source.line == found.source.line && found.column > told.column &&
         found.column < told.column + told.detail.size();
}

bool Reading::refuse_at(const WordPlace& place, Code code, std::string detail) {
  Diagnostic refused = diagnostic(code, place.source, std::move(detail));
  refused.column = place.column;
  refused.told_after = blocks_read;
  return collect(std::move(refused));
}

// A fault in an ISG program without a word of ISG's own may mean that the program is of another
// dialect. If the dialect was declared, only Klartext is suspected: its lines look like no other.
void Reading::guard_against_other_dialects(const ProgramLine& line, Diagnostic& fault) const {
  constexpr std::array codes{Code::nc_syntax, Code::nc_unknown_function, Code::nc_unsupported,
                             Code::nc_number, Code::nc_axis_unknown,     Code::nc_word_twice};
  const bool is_of_words = std::ranges::find(codes, fault.code) != codes.end();
  if (is_of_words && is_heidenhain_iso(line.text)) {
    fault.code = Code::nc_unsupported;
    fault.detail = "a block of DIN/ISO of Heidenhain";
    fault.slip = {};
    return;
  }
  if (is_of_words && dialect.name == DialectName::isg && is_of_okuma(line.text)) {
    fault.code = Code::nc_unsupported;
    fault.detail = "a block of Okuma";
    fault.slip = {};
    return;
  }
  const bool mistyped =
      fault.slip.kind != SlipKind::none && fault.slip.kind != SlipKind::unit_of_another;
  if (isg_word_seen || mistyped || !is_of_words) return;
  const auto other = looks_like(line.text);
  const bool is_declared = dialect.name != DialectName::isg;
  if (!other || *other == dialect.name || (is_declared && *other != DialectName::heidenhain))
    return;
  fault.code = Code::other_dialect;
  fault.detail.append(reason::as_in_dialect).append(dialect_of(*other).spelling);
}

bool Reading::Fault::counts(std::uint32_t line, const std::vector<CallPlace>& chain) {
  const bool has_own_text = !chain.empty() && chain.front().line_within > 0;
  std::vector<bool>& of_text = counted[has_own_text ? chain.front().subprogram : ""];
  const std::uint32_t at = has_own_text ? chain.front().line_within : line;
  if (of_text.size() <= at) of_text.resize(at + 1);
  const bool is_new = !of_text[at];
  of_text[at] = true;
  return is_new;
}

bool Reading::collect(Diagnostic fault) {
  if (limits.most_faults <= 1) return diagnostics.report(std::move(fault));
  if (faults.empty()) scanned_trc = state.contour_open();
  reads_plain_lines = false;
  if (fault.calls.empty()) fault.calls = diagnostics.calls().of(fault.source.index);
  const auto alike = std::ranges::find_if(faults, [&](const Fault& known) {
    return known.code == fault.code && known.detail == fault.detail;
  });
  if (alike != faults.end()) {
    const bool may_count = reads_flat || alike->last_line != fault.source.line;
    if (may_count && alike->counts(fault.source.line, fault.calls)) ++alike->lines;
    alike->last_line = fault.source.line;
    return false;
  }
  faults.push_back({.code = fault.code,
                    .source = fault.source,
                    .column = fault.column,
                    .detail = std::move(fault.detail),
                    .slip = std::move(fault.slip),
                    .last_line = fault.source.line,
                    .calls = std::move(fault.calls),
                    .values = std::move(fault.values),
                    .told_after = fault.told_after});
  Fault& told = faults.back();
  told.counts(told.source.line, told.calls);
  return faults.size() >= limits.most_faults && report_faults();
}

bool Reading::report_faults() { return diagnostics.report_together(told_faults()); }

std::vector<Diagnostic> Reading::told_faults() const {
  // Each fault has recorded its call when it was found.
  diagnostics.calls().stand(blocks_read, CallPlaces::main_program, 0);
  // What else is wrong in a program of another dialect is wrong in this one alone.
  const bool is_of_another =
      !isg_word_seen && !faults.empty() && faults.front().code == Code::other_dialect;
  std::vector<Diagnostic> all;
  for (const Fault& fault : faults) {
    if (is_of_another && fault.code != Code::other_dialect) continue;
    Diagnostic found = diagnostic(fault.code, fault.source, fault.detail);
    found.column = fault.column;
    found.slip = fault.slip;
    found.calls = fault.calls;
    found.values = fault.values;
    found.told_after = fault.told_after;
    if (fault.lines > 1) found.values.push_back({"lines", static_cast<double>(fault.lines)});
    all.push_back(std::move(found));
  }
  return all;
}

bool Reading::refuse(const ProgramLine& line, const Word& word, Code code, std::string detail) {
  if (detail.empty()) detail = line.text.substr(word.begin, word.end - word.begin);
  return refuse(line, TextFault{.code = code, .begin = word.begin, .detail = std::move(detail)});
}

}  // namespace trc
