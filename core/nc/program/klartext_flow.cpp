#include "core/nc/program/klartext_flow.h"

#include <utility>

namespace trc::program {
namespace {

// Names are stored without their last quotation mark.
std::string shown(const std::string& label) {
  return "LBL " + label + (label.starts_with('"') ? "\"" : "");
}

}  // namespace

bool klartext_computes(std::string_view line) {
  return line.find_first_of("bB") != std::string_view::npos &&
         label_statement_in(line).kind == LabelStatement::Kind::call;
}

KlartextFlow::KlartextFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text,
                           std::size_t start)
    : Flow(setup, lent) {
  texts_.push_back(std::move(text));
  frames_.push_back({.end = texts_.front().size(), .next = start, .current = start});
}

void KlartextFlow::read_outline() {
  using Execution = KlartextOutline::Execution;
  const std::string_view line = texts_.front().line(lines_in_outline_++);
  const std::size_t sign = line.find_first_not_of("0123456789 \t");
  const bool may_be = may_be_skipped(sign != std::string_view::npos && line[sign] == '/');
  outline_.read(line, is_left_out(line) ? Execution::never
                      : may_be          ? Execution::perhaps
                                        : Execution::certain);
  if (lines_in_outline_ == texts_.front().size()) outline_.finish();
}

// Reading a line of the outline is a step too, so that a long text can be interrupted.
Flow::Step KlartextFlow::execute_next(std::string& flat) {
  if (lines_in_outline_ < texts_.front().size()) {
    read_outline();
    return Step::goes_on;
  }
  while (frame().next >= frame().end) {
    if (frames_.size() == 1) return Step::ended;
    if (frame().repetitions_left == 0) {
      frames_.pop_back();
      continue;
    }
    --frame().repetitions_left;
    frame().next = frame().restart;
    flat.append("; ").append(frame().name).append(line_end());
    // If no lines are in between, the repetition itself counts as executed.
    if (frame().next == frame().end) return count_line() ? Step::goes_on : Step::refused;
  }
  return execute_line(flat) ? Step::goes_on : Step::refused;
}

bool KlartextFlow::execute_line(std::string& flat) {
  frame().current = frame().next++;
  if (!count_line()) return false;
  if (!outline_.repeats_contour()) {
    take_effects_of_call();
    write_as_written(flat);
    return true;
  }
  if (behind_end_) return write_behind_end(flat);
  const std::string_view line = text_of(frame()).line(frame().current);
  const LabelStatement statement = label_statement_in(line);
  switch (statement.kind) {
    case LabelStatement::Kind::none:
      break;
    case LabelStatement::Kind::program_end:
      if (frames_.size() > 1)
        return refuse(Code::nc_unsupported, statement.begin, "the end of the program in a label");
      (looks_ahead() ? ended_ : behind_end_) = true;
      break;
    case LabelStatement::Kind::call:
      if (is_left_out(line)) return true;
      if (may_be_skipped(line.substr(0, statement.begin).find('/') != std::string_view::npos))
        return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
      return execute_call(statement, flat);
    case LabelStatement::Kind::label:
      // The called lines have been written out, so nothing leads to the label any more.
      if (statement.label != "0" && frames_.size() == 1) write_name(flat, statement.label);
      return true;
  }
  write_as_written(flat);
  return true;
}

// The label stays in its place.
void KlartextFlow::take_effects_of_call() {
  const std::string_view line = text_of(frame()).line(frame().current);
  if (!klartext_computes(line)) return;
  const LabelStatement statement = label_statement_in(line);
  if (!statement.repeats) call_leaves_ = outline_.effects_of(statement.label);
}

void KlartextFlow::write_as_written(std::string& flat) {
  is_as_written_ = true;
  flat.append(text_of(frame()).line(frame().current)).append(line_end());
}

void KlartextFlow::write_name(std::string& flat, const std::string& label) {
  is_as_written_ = false;
  flat.append("; ").append(shown(label)).append(line_end());
}

bool KlartextFlow::execute_call(const LabelStatement& statement, std::string& flat) {
  const KlartextOutline::Label* const called = outline_.label(statement.label);
  const auto refused = [&](Code code, std::string detail) {
    return refuse(code, statement.begin, std::move(detail));
  };
  if (statement.label.starts_with('Q') || (statement.repeats && !statement.repetitions))
    return refused(Code::nc_unsupported, "CALL LBL with a parameter");
  if (called == nullptr) return refused(Code::subprogram_unknown, shown(statement.label));
  const KlartextOutline::Label& label = *called;
  if (label.is_twice)
    return refused(Code::subprogram_unknown, shown(statement.label) + ", which is there twice");
  if (statement.repeats && *statement.repetitions == 0) return true;
  if (statement.repeats && label.line >= frame().current)
    return refused(Code::block_structure, "CALL " + shown(statement.label) + " REP");
  if (!statement.repeats && label.end == KlartextOutline::nowhere)
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

// Labels that have been written out can no longer be called.
bool KlartextFlow::write_behind_end(std::string& flat) {
  const LabelStatement statement = label_statement_in(text_of(frame()).line(frame().current));
  if (statement.kind == LabelStatement::Kind::label) {
    const bool left_out = leaves_out_;
    const KlartextOutline::Label* const label = outline_.label(statement.label);
    // Nested lines that are repeated are left out with the label.
    leaves_out_ = statement.label != "0" && (left_out || (label != nullptr && label->is_called));
    if (leaves_out_ || (left_out && statement.label == "0")) return true;
  }
  if (!leaves_out_) write_as_written(flat);
  return true;
}

}  // namespace trc::program
