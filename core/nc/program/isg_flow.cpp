#include "core/nc/program/isg_flow.h"

#include <algorithm>

#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"

namespace trc::program {

IsgFlow::IsgFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text,
                 FirstBlock first_block)
    : Flow(setup, lent) {
  texts_.push_back(std::move(text));
  add_units(0, first_block);
  const Unit main = units_.back();
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_units(texts_.size() - 1, FirstBlock::in_text);
    units_.back().name = plain_file_name(name);
  }
  frames_.push_back({.begin = main.begin,
                     .end = main.end,
                     .next = main.begin,
                     .current = main.begin,
                     .own_variables = true});
  writes_variables_ = calls_the_unknown();
}

bool IsgFlow::calls_the_unknown() const {
  for (const ProgramText& text : texts_)
    for (std::size_t line = 0; line < text.size(); ++line) {
      checkpoint_.pass();
      const std::string_view content = text.line(line);
      const std::size_t begin = isg_head_of(content).behind;
      const IsgCall call = isg_call_at(content, begin);
      if (isg_call_behind_words(content, begin) != std::string_view::npos ||
          (call.is_call && (!call.is_local || call.is_joined) &&
           given_subprogram(setup_, call.name) == nullptr))
        return true;
    }
  return false;
}

// The subprograms of a text, then its program. After subprograms the program begins with its own %,
// without subprograms with any block.
void IsgFlow::add_units(std::size_t text, FirstBlock first_block) {
  const ProgramText& lines = texts_[text];
  Unit unit{.text = text};
  bool has_begun = first_block == FirstBlock::before_text;
  bool in_comment = false;
  for (std::size_t line = 0; line < lines.size() && !has_begun; ++line) {
    checkpoint_.pass();
    const std::string_view content = lines.line(line);
    if (bounds_isg_comment(content)) in_comment = begins_isg_comment(content);
    const std::string name = isg_subprogram_of(content);
    if (begins_isg_program(content) || !name.empty()) {
      unit.end = line;
      if (!unit.name.empty()) units_.push_back(unit);
      has_begun = name.empty();
      unit = {.name = name, .text = text, .begin = has_begun ? line : line + 1};
    } else if (unit.name.empty() && !in_comment && !bounds_isg_comment(content)) {
      has_begun = !is_isg_line_over(content, behind_blanks(content, 0));
    }
  }
  unit.end = lines.size();
  if (!unit.name.empty()) {  // no program after its subprograms
    units_.push_back(unit);
    unit = {.text = text, .begin = unit.end};
  }
  unit.end = lines.size();
  units_.push_back(unit);
}

// A lone % with nothing after it.
bool IsgFlow::ends_tape(const ProgramText& text, std::size_t line) const {
  const std::string_view sign = text.line(line);
  std::size_t at = behind_blanks(sign, 0);
  if (at >= sign.size() || sign[at] != '%') return false;
  for (++at; line < text.size() && is_isg_line_over(text.line(line), at); at = 0) {
    checkpoint_.pass();
    ++line;
  }
  return line == text.size();
}

// The name for a line with % that is not the first of the executed ones.
std::string IsgFlow::name_of_second(std::string_view line) {
  return isg_subprogram_of(line).empty() ? "%, a second program"
                                         : "%L, a subprogram after the program";
}

void IsgFlow::know(std::string_view lines) {
  const ProgramText text({}, std::string(lines), 1, &checkpoint_);
  for (std::size_t line = 0; line < text.size(); ++line) take_line_in_front(text.line(line));
}

void IsgFlow::take_line_in_front(std::string_view line) {
  line_ = line;
  head_ = isg_head_of(line_);
  if (bounds_isg_comment(line_)) in_comment_ = begins_isg_comment(line_);
  if (in_comment_ || !is_isg_variable_at(line_, head_.behind)) return;
  ExpressionReader expression = expression_at(head_.behind);
  const std::string name = place_at(expression);
  expression.pass_blanks();
  if (expression.failed() || expression.peek() != '=' || name.starts_with("V.G.")) return;
  expression.go_to(expression.at() + 1);
  const Value value = expression.expression();
  if (!expression.failed()) values_of(name)[name] = value;
}

void IsgFlow::take_line() {
  Frame& at = frame();
  at.current = at.next++;
  assigned_.clear();
  const ProgramText& text = text_of(at);
  line_ = text.line(at.current);
  is_joined_ = is_continued(line_);
  if (is_joined_) {
    joined_ = line_;
    while (is_continued(joined_) && at.next < at.end) {
      joined_.resize(without_blanks_behind(joined_).size() - 1);
      joined_.append(" ").append(text.line(at.next++));
    }
    line_ = joined_;
  }
  head_ = isg_head_of(line_);
  head_.to_skip = may_be_skipped(head_.to_skip);
  is_as_written_ = false;
}

Flow::Step IsgFlow::execute_next(std::string& flat) {
  const bool goes_on = frame().next >= frame().end ? end_of_frame(flat) : execute_line(flat);
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

bool IsgFlow::execute_line(std::string& flat) {
  take_line();
  if (!count_line()) return false;
  const bool was_comment = in_comment_;
  if (bounds_isg_comment(line_)) in_comment_ = begins_isg_comment(line_);
  if (was_comment || in_comment_) return pass_line(flat);
  if (is_left_out(line_)) return true;
  if (head_.to_skip && (head_.is_target || !head_.label.empty()))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (is_isg_line_over(line_, head_.behind)) return pass_line(flat);
  if (in_declaration_) return declare(flat);
  if (line_[behind_blanks(line_, 0)] == '%') return pass_header(flat);
  if (line_[head_.behind] == '$') {
    // The target of a statement counts lines as they are written.
    return !is_joined_
               ? follow(flat)
               : refuse(Code::nc_unsupported, head_.behind, "$, a statement on several lines");
  }
  const IsgCall called = isg_call_at(line_, head_.behind);
  return called.is_call ? call(flat, called) : execute_words(flat);
}

bool IsgFlow::pass_header(std::string& flat) {
  const Frame& at = frame();
  if (at.current == at.begin) return at.text > 0 || pass_line(flat);
  if (ends_tape(text_of(at), at.current)) return end_of_frame(flat);
  return refuse(Code::nc_unsupported, behind_blanks(line_, 0), name_of_second(line_));
}

bool IsgFlow::pass_line(std::string& flat) {
  const bool is_target = head_.is_target || !head_.label.empty();
  if (is_target && !in_comment_) {
    if (head_.behind < line_.size() || head_.is_target)
      write_behind_number(flat, line_.substr(head_.behind));
    return true;
  }
  is_as_written_ = joined_.empty() || line_.data() != joined_.data();
  flat.append(line_).append(line_end());
  return true;
}

// By their numbers: whether they belong to a comment of several lines, or bound one.
std::vector<bool> IsgFlow::comment_lines(const ProgramText& text, std::size_t begin,
                                         std::size_t end) const {
  std::vector<bool> found(end);
  bool in_comment = false;
  for (std::size_t line = begin; line < end; ++line) {
    checkpoint_.pass();
    const bool bounds = bounds_isg_comment(text.line(line));
    if (bounds) in_comment = begins_isg_comment(text.line(line));
    found[line] = in_comment || bounds;
  }
  return found;
}

// A subprogram needs no word at its end.
bool IsgFlow::end_of_frame(std::string& flat) {
  return frames_.size() == 1 ? end_of_program(flat) : return_from(flat);
}

bool IsgFlow::end_of_program(std::string& flat) {
  ended_ = true;
  if (looks_ahead()) return true;
  const Frame& main = frames_.front();
  const ProgramText& text = texts_.front();
  if (main.begin == main.end && units_.front().text == 0 && !units_.front().name.empty())
    return refuse_behind_end(text.size() - 1, Code::block_structure,
                             "%, the beginning of the program after its subprograms");
  const std::vector<bool> is_comment = comment_lines(text, main.current + 1, main.end);
  for (std::size_t line = main.current + 1; line < main.end; ++line) {
    checkpoint_.pass();
    const std::string_view content = text.line(line);
    const bool is_header = !isg_subprogram_of(content).empty() || begins_isg_program(content);
    if (is_header && !is_comment[line] && !ends_tape(text, line))
      return refuse_behind_end(line, Code::nc_unsupported, name_of_second(content));
  }
  // $IF … M30 $ENDIF: other values lead to the lines after it.
  std::ptrdiff_t branches = 0;
  for (const auto& [line, structure] : outline_of(main).structures) {
    if (line > main.current) break;
    branches += structure == Structure::branch ? 1 : 0;
    branches -= structure == Structure::end_branch ? 1 : 0;
  }
  if (branches > 0) return true;
  std::size_t copied = main.end;
  for (std::size_t line = main.current + 1; line < main.end; ++line) {
    checkpoint_.pass();
    const std::string_view content = text.line(line);
    const IsgHead head = isg_head_of(content);
    const bool is_target = !is_comment[line] && (head.is_target || !head.label.empty());
    if (is_target) copied = std::min(copied, line);
    if (is_target) break;
    // In a comment of several lines, too, as in a program that does not compute.
    if (first_with('G', 41, 42, line, line + 1) == line) return refuse_contour_behind_end(line);
    const bool computes_there = !is_comment[line] && computes(setup_, content);
    if (was_seen(main, line) || computes_there) copied = std::min(copied, line);
  }
  copy_text_behind_end(flat, copied);
  return true;
}

// Nothing leads to that line of the program.
bool IsgFlow::refuse_behind_end(std::size_t line, Code code, std::string detail) {
  ended_ = false;
  frames_.erase(frames_.begin() + 1, frames_.end());
  locals_.resize(1);
  frames_.front().current = line;
  return refuse(code, 0, std::move(detail));
}

void IsgFlow::write_behind_number(std::string& flat, std::string_view text) {
  if (head_.number >= 0) {
    flat.append(line_.substr(head_.number_begin, head_.number_end - head_.number_begin));
    if (!text.empty()) flat.append(" ");
  }
  flat.append(text).append(line_end());
}

}  // namespace trc::program
