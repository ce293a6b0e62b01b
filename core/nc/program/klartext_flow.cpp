#include "core/nc/program/klartext_flow.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/nc/dialect/klartext_block.h"

namespace trc::program {
namespace {

// Contours of cycles stand in labels as well, which the control itself looks up.
bool names_labels_for_cycles(std::string_view statement) {
  return begins_with_word(statement, "CYCL DEF 14") || begins_with_word(statement, "CONTOUR DEF") ||
         begins_with_word(statement, "SEL CONTOUR");
}

bool has_word(std::string_view statement, std::string_view word) {
  for (std::size_t at = statement.find(word); at != std::string_view::npos;
       at = statement.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || statement[at - 1] == ' ') && (end == statement.size() || statement[end] == ' '))
      return true;
  }
  return false;
}

bool ends_program(std::string_view statement) {
  return begins_with_word(statement, "END") || has_word(statement, "M2") ||
         has_word(statement, "M02") || has_word(statement, "M30");
}

// Names are kept without their last quotation mark.
std::string shown(const std::string& label) {
  return "LBL " + label + (label.starts_with('"') ? "\"" : "");
}

// Behind the number of the block, and what may be skipped.
std::size_t begin_of_statement(std::string_view line) {
  return std::min(line.find_first_not_of("0123456789 \t/"), line.size());
}

}  // namespace

bool klartext_computes(std::string_view line) {
  return line.find_first_of("bB") != std::string_view::npos &&
         begins_with_word(statement_of(line.substr(begin_of_statement(line))), "CALL LBL");
}

KlartextFlow::KlartextFlow(const ProgramSetup& setup, CallPlaces& calls, ProgramText text,
                           std::size_t start)
    : Flow(setup, calls) {
  texts_.push_back(std::move(text));
  find_labels();
  expands_ = expands();
  frames_.push_back({.end = texts_.front().size(), .next = start, .current = start});
}

KlartextFlow::Statement KlartextFlow::statement_in(std::string_view line) {
  Statement found{.begin = begin_of_statement(line)};
  const std::string statement = statement_of(line.substr(found.begin));
  const bool calls = begins_with_word(statement, "CALL LBL");
  if (ends_program(statement)) found.kind = Statement::Kind::program_end;
  if (!calls && !begins_with_word(statement, "LBL")) return found;
  found.kind = calls ? Statement::Kind::call : Statement::Kind::label;
  found.label = label_of(line, found.begin, statement);
  const std::size_t behind = calls ? statement.find(" REP") : std::string::npos;
  if (behind == std::string::npos) return found;
  found.repeats = true;
  const std::size_t digits =
      std::min(statement.find_first_not_of(' ', behind + 4), statement.size());
  std::uint64_t times = 0;
  const char* const end = statement.data() + statement.size();
  // REP 3/2 counts what is left behind the stroke. Without a number it is once.
  const auto read = std::from_chars(statement.data() + digits, end, times);
  const bool is_number = read.ec == std::errc{} && (read.ptr == end || *read.ptr == '/');
  if (digits == statement.size()) found.repetitions = 1;
  if (is_number) found.repetitions = times;
  return found;
}

void KlartextFlow::find_labels() {
  const ProgramText& text = texts_.front();
  for (std::size_t line = 0; line < text.size(); ++line) {
    const Statement statement = statement_in(text.line(line));
    if (statement.kind != Statement::Kind::label) continue;
    if (statement.label == "0") {
      for (auto& [name, label] : labels_)
        if (label.end == nowhere) label.end = line;
      continue;
    }
    const auto [known, is_new] = labels_.try_emplace(statement.label, Label{.line = line});
    known->second.is_twice |= !is_new;
  }
  for (std::size_t line = 0; line < text.size(); ++line) {
    const Statement statement = statement_in(text.line(line));
    if (statement.kind != Statement::Kind::call || statement.repeats) continue;
    if (const auto called = labels_.find(statement.label); called != labels_.end())
      called->second.is_called = true;
  }
}

bool KlartextFlow::expands() const {
  const ProgramText& text = texts_.front();
  bool in_contour = false;
  bool has_any = false;
  for (std::size_t line = 0; line < text.size(); ++line) {
    const std::string_view content = text.line(line);
    const std::string words = statement_of(content.substr(begin_of_statement(content)));
    if (names_labels_for_cycles(words)) return false;
    if (place_of_klartext_side(content) != nowhere) in_contour = true;
    if (has_word(words, "R0") || begins_with_word(words, "DEP")) in_contour = false;
    const Statement statement = statement_in(content);
    if (statement.kind != Statement::Kind::call) continue;
    const auto called = labels_.find(statement.label);
    if (called == labels_.end()) continue;
    const Label& label = called->second;
    const bool has = statement.repeats
                         ? label.line < line && has_contour(label.line, line, 0)
                         : label.end != nowhere && has_contour(label.line, label.end, 0);
    has_any |= has || in_contour;
  }
  return has_any;
}

bool KlartextFlow::has_contour(std::size_t begin, std::size_t end, std::size_t depth) const {
  const ProgramText& text = texts_.front();
  for (std::size_t line = begin; line < end; ++line) {
    if (place_of_klartext_side(text.line(line)) != nowhere) return true;
    const Statement statement = statement_in(text.line(line));
    if (statement.kind != Statement::Kind::call || statement.repeats || depth == deepest_call)
      continue;
    const auto called = labels_.find(statement.label);
    if (called != labels_.end() && called->second.end != nowhere &&
        has_contour(called->second.line, called->second.end, depth + 1))
      return true;
  }
  return false;
}

Flow::Step KlartextFlow::execute_next(std::string& flat) {
  while (frame().next >= frame().end) {
    if (frames_.size() == 1) return Step::ended;
    if (frame().repetitions_left == 0) {
      frames_.pop_back();
      continue;
    }
    --frame().repetitions_left;
    frame().next = frame().restart;
    flat.append("; ").append(frame().name).append(line_end());
  }
  return execute_line(flat) ? Step::goes_on : Step::refused;
}

bool KlartextFlow::execute_line(std::string& flat) {
  frame().current = frame().next++;
  if (!count_line()) return false;
  if (!expands_) {
    write_as_written(flat);
    return true;
  }
  if (behind_end_) return write_behind_end(flat);
  const std::string_view line = text_of(frame()).line(frame().current);
  const Statement statement = statement_in(line);
  switch (statement.kind) {
    case Statement::Kind::none:
      break;
    case Statement::Kind::program_end:
      if (frames_.size() > 1)
        return refuse(Code::nc_unsupported, statement.begin, "the end of the program in a label");
      (looks_ahead() ? ended_ : behind_end_) = true;
      break;
    case Statement::Kind::call:
      if (is_left_out(line)) return true;
      if (may_be_skipped(line.substr(0, statement.begin).find('/') != nowhere))
        return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
      return execute_call(statement, flat);
    case Statement::Kind::label:
      // What is called has been written out, so that nothing leads to the label any more.
      if (statement.label != "0" && frames_.size() == 1) write_name(flat, statement.label);
      return true;
  }
  write_as_written(flat);
  return true;
}

void KlartextFlow::write_as_written(std::string& flat) {
  is_as_written_ = true;
  flat.append(text_of(frame()).line(frame().current)).append(line_end());
}

void KlartextFlow::write_name(std::string& flat, const std::string& label) {
  is_as_written_ = false;
  flat.append("; ").append(shown(label)).append(line_end());
}

bool KlartextFlow::execute_call(const Statement& statement, std::string& flat) {
  const auto called = labels_.find(statement.label);
  const auto refused = [&](Code code, std::string detail) {
    return refuse(code, statement.begin, std::move(detail));
  };
  if (statement.label.starts_with('Q') || (statement.repeats && !statement.repetitions))
    return refused(Code::nc_unsupported, "CALL LBL with a parameter");
  if (called == labels_.end()) return refused(Code::subprogram_unknown, shown(statement.label));
  const Label& label = called->second;
  if (label.is_twice)
    return refused(Code::subprogram_unknown, shown(statement.label) + ", which is there twice");
  if (statement.repeats && *statement.repetitions == 0) return true;
  if (statement.repeats && label.line >= frame().current)
    return refused(Code::block_structure, "CALL " + shown(statement.label) + " REP");
  if (!statement.repeats && label.end == nowhere)
    return refused(Code::block_structure, shown(statement.label));
  write_name(flat, statement.label);
  const std::size_t begin = label.line + 1;
  return enter({.begin = begin,
                .end = statement.repeats ? frame().current : label.end,
                .next = begin,
                .current = begin,
                .restart = begin,
                .repetitions_left = statement.repeats ? *statement.repetitions - 1 : 0,
                .name = shown(statement.label)});
}

// Labels that have been written out are no longer there to be called.
bool KlartextFlow::write_behind_end(std::string& flat) {
  const Statement statement = statement_in(text_of(frame()).line(frame().current));
  if (statement.kind == Statement::Kind::label) {
    const bool left_out = leaves_out_;
    const auto label = labels_.find(statement.label);
    leaves_out_ = label != labels_.end() && label->second.is_called;
    if (leaves_out_ || (left_out && statement.label == "0")) return true;
  }
  if (!leaves_out_) write_as_written(flat);
  return true;
}

}  // namespace trc::program
