#include <algorithm>

#include "core/nc/program/fanuc_flow.h"
#include "core/nc/text/characters.h"

// Control statements of Fanuc: branches, loops and jumps.

namespace trc::program {
namespace {

bool pass_word(std::string_view line, std::string_view word, ExpressionReader& expression) {
  const std::size_t length = length_of_word_at(line, expression.at(), word);
  if (length > 0) expression.go_to(expression.at() + length);
  return length > 0;
}

constexpr std::size_t none = static_cast<std::size_t>(-1);

// IF [ ] THEN at the end of a line: it covers the lines up to ELSE or ENDIF.
bool begins_branch(std::string_view line, std::size_t at) {
  if (!has_word_at(line, at, "IF")) return false;
  constexpr std::string_view then = "THEN";
  for (std::size_t end = at; end < line.size() && line[end] != '(' && line[end] != ';'; ++end)
    if (has_word_at(line, end, then)) return is_over(line, end + then.size());
  return false;
}

}  // namespace

const FanucFlow::Outline& FanucFlow::outline_of(const Frame& frame) {
  const auto [known, is_new] = outlines_.try_emplace({frame.text, frame.end});
  Outline& outline = known->second;
  if (!is_new) return outline;
  // A call by M97 begins within a program, but can reach all of it.
  const auto unit = std::ranges::find_if(
      units_, [&](const Unit& each) { return each.text == frame.text && each.end == frame.end; });
  const ProgramText& text = text_of(frame);
  std::vector<std::pair<std::size_t, std::size_t>> open;  // number of the loop, line
  std::vector<std::size_t> branches;                      // their IF or ELSE
  for (std::size_t line = unit->begin; line < unit->end; ++line) {
    checkpoint_.pass();
    std::string_view content = text.line(line);
    std::string behind_o;
    if (may_begin_program(content)) {
      behind_o = without_head(content, program_head_of(content));
      content = behind_o;
    }
    const LineHead head = head_of(content);
    if (head.number >= 0) outline.labels[head.number].push_back(line);
    const bool ends_branch = has_word_at(content, head.behind, "ENDIF");
    if (ends_branch || has_word_at(content, head.behind, "ELSE")) {
      if (branches.empty()) continue;
      outline.feet[branches.back()] = line;
      branches.back() = line;
      if (ends_branch) branches.pop_back();
      continue;
    }
    if (begins_branch(content, head.behind)) {
      branches.push_back(line);
      continue;
    }
    const bool begins = length_of_word_at(content, head.behind, "WHILE") > 0 ||
                        has_word_at(content, head.behind, "DO");
    const bool ends = has_word_at(content, head.behind, "END");
    if (!begins && !ends) continue;
    const std::size_t number = number_of_loop(content, head.behind);
    if (begins) open.emplace_back(number, line);
    if (!ends) continue;
    while (!open.empty() && open.back().first != number) open.pop_back();
    if (open.empty()) continue;
    outline.feet[open.back().second] = line;
    outline.heads[line] = open.back().second;
    open.pop_back();
  }
  return outline;
}

// The number after DO or END, anywhere in the line; `none`: there is none.
std::size_t FanucFlow::number_of_loop(std::string_view line, std::size_t at) const {
  int depth = 0;
  for (; at < line.size(); ++at) {
    if (line[at] == '[') ++depth;
    if (line[at] == ']') --depth;
    if (depth != 0) continue;
    const std::size_t length = has_word_at(line, at, "DO")    ? 2
                               : has_word_at(line, at, "END") ? 3
                                                              : 0;
    if (length == 0) continue;
    double number = 0;
    bool whole = false;
    const std::size_t digits = behind_blanks(line, at + length);
    if (read_number(line.substr(digits), number, whole) == 0 || !is_whole(number)) return none;
    return static_cast<std::size_t>(number);
  }
  return none;
}

bool FanucFlow::execute_statement(std::string& flat) {
  ExpressionReader expression = expression_at(head_.behind);
  if (expression.pass("IF")) return branch(flat, expression);
  if (pass_word(line_, "WHILE", expression))
    return loop(flat, expression, LoopHead::with_condition);
  if (expression.pass("DO")) return loop(flat, expression, LoopHead::endless);
  if (expression.pass("ENDIF")) return finish_statement(flat, expression.at());
  if (expression.pass("ELSE"))  // after a branch that was taken
    return go_behind_foot("ELSE without ENDIF") && finish_statement(flat, expression.at());
  if (expression.pass("END")) return end_loop(flat, expression);
  pass_word(line_, "GOTO", expression);
  return jump(expression) && finish_statement(flat, expression.at());
}

bool FanucFlow::branch(std::string& flat, ExpressionReader& expression) {
  expression.pass_blanks();
  if (expression.peek() != '[')
    return refuse(Code::expression_invalid, head_.behind, "IF without [ ]");
  const bool holds = expression.operand().number != 0;
  if (expression.failed()) return refuse(expression.fault());
  expression.pass_blanks();
  const std::size_t then = expression.at();
  if (expression.pass("THEN")) {
    expression.pass_blanks();
    if (is_over(line_, expression.at()))
      return (holds || go_behind_foot("IF THEN without ENDIF")) &&
             finish_statement(flat, expression.at());
    if (expression.peek() != '#')
      return refuse(Code::nc_unsupported, then, "THEN without an assignment");
    return holds ? assign(flat, expression.at()) : true;
  }
  if (!pass_word(line_, "GOTO", expression))
    return refuse(Code::expression_invalid, then, "IF without GOTO or THEN");
  if (holds) return jump(expression) && finish_statement(flat, expression.at());
  static_cast<void>(expression.whole_operand());
  if (expression.failed()) return refuse(expression.fault());
  return finish_statement(flat, expression.at());
}

bool FanucFlow::go_behind_foot(const char* missing) {
  const Outline& outline = outline_of(frame());
  const auto found = outline.feet.find(frame().current);
  if (found == outline.feet.end()) return refuse(Code::block_structure, head_.behind, missing);
  frame().next = found->second + 1;
  return true;
}

bool FanucFlow::loop(std::string& flat, ExpressionReader& expression, LoopHead head) {
  bool holds = true;
  if (head == LoopHead::with_condition) {
    expression.pass_blanks();
    if (expression.peek() != '[')
      return refuse(Code::expression_invalid, head_.behind, "WHILE without [ ]");
    holds = expression.operand().number != 0;
    expression.pass_blanks();
    if (!expression.failed() && !expression.pass("DO"))
      return refuse(Code::expression_invalid, head_.behind, "WHILE without DO");
  }
  static_cast<void>(expression.whole_operand());
  if (expression.failed()) return refuse(expression.fault());
  const Outline& outline = outline_of(frame());
  const auto found = outline.feet.find(frame().current);
  if (found == outline.feet.end())
    return refuse(Code::block_structure, head_.behind, "DO without END");
  if (!holds) frame().next = found->second + 1;
  return finish_statement(flat, expression.at());
}

bool FanucFlow::end_loop(std::string& flat, ExpressionReader& expression) {
  static_cast<void>(expression.whole_operand());
  if (expression.failed()) return refuse(expression.fault());
  const Outline& outline = outline_of(frame());
  const auto found = outline.heads.find(frame().current);
  if (found == outline.heads.end())
    return refuse(Code::block_structure, head_.behind, "END without DO");
  frame().next = found->second;
  return finish_statement(flat, expression.at());
}

bool FanucFlow::jump(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::int64_t number = expression.whole_operand();
  if (expression.failed()) return refuse(expression.fault());
  return go_to(number, begin);
}

bool FanucFlow::go_to(std::int64_t number, std::size_t begin) {
  const auto line = line_of(frame(), number);
  if (!line)
    return refuse(Code::jump_target_unknown, begin,
                  std::string("N").append(std::to_string(number)));
  frame().next = *line;
  return true;
}

// The first such line after the executed one, else the first one from the beginning.
std::optional<std::size_t> FanucFlow::line_of(const Frame& frame, std::int64_t number) {
  const Outline& outline = outline_of(frame);
  const auto lines = outline.labels.find(number);
  if (lines == outline.labels.end()) return {};
  const auto behind = std::ranges::upper_bound(lines->second, frame.current);
  return behind == lines->second.end() ? lines->second.front() : *behind;
}

}  // namespace trc::program
