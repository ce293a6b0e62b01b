#include "core/nc/program/linuxcnc_flow.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

bool is_o_word_at(std::string_view line, std::size_t at) {
  return at < line.size() && upper(line[at]) == 'O';
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char sign : name)
    if (sign != ' ' && sign != '\t')
      plain += sign >= 'A' && sign <= 'Z' ? static_cast<char>(sign - 'A' + 'a') : sign;
  return plain;
}

LinuxcncFlow::Statement LinuxcncFlow::statement_at(std::string_view line, std::size_t& at) {
  using enum Statement;
  constexpr auto statements = std::to_array<std::pair<std::string_view, Statement>>({
      {"SUB", sub},
      {"ENDSUB", endsub},
      {"CALL", call},
      {"RETURN", give_back},
      {"IF", if_true},
      {"ELSEIF", elseif},
      {"ELSE", otherwise},
      {"ENDIF", endif},
      {"WHILE", while_true},
      {"ENDWHILE", endwhile},
      {"DO", do_once},
      {"REPEAT", repeat},
      {"ENDREPEAT", endrepeat},
      {"BREAK", leave},
      {"CONTINUE", go_on},
  });
  at = behind_blanks(line, at);
  std::size_t end = at;
  while (end < line.size() && is_letter(line[end])) ++end;
  const std::string word = in_upper_case(line.substr(at, end - at));
  for (const auto& [spelling, statement] : statements) {
    if (word != spelling) continue;
    at = end;
    return statement;
  }
  return none;
}

namespace {

// After a literal label, whose text goes to `label`; 0: the label is computed, or missing.
std::size_t behind_label(std::string_view line, std::size_t at, std::string& label) {
  at = behind_blanks(line, at + 1);
  if (at < line.size() && line[at] == '<') {
    const std::size_t close = line.find('>', at);
    if (close == std::string_view::npos) return 0;
    label = plain_name(line.substr(at, close + 1 - at));
    return close + 1;
  }
  const std::size_t begin = at;
  while (at < line.size() && is_digit(line[at])) ++at;
  if (at == begin) return 0;
  label = std::string(line.substr(begin, at - begin));
  label.erase(0, std::min(label.find_first_not_of('0'), label.size() - 1));
  return at;
}

}  // namespace

bool linuxcnc_computes(std::string_view line) {
  const LineHead head = head_of(line);
  if (is_o_word_at(line, head.behind)) {
    std::string label;
    const std::size_t behind = behind_label(line, head.behind, label);
    // The number of a program, with its title.
    return behind == 0 || label.front() == '<' || !is_over(line, behind);
  }
  for (std::size_t at = head.behind; at < line.size();) {
    const char sign = line[at];
    if (sign == '#' || sign == '[') return true;
    if (sign == ';') return false;
    if (sign == '(') {
      at = behind_comment(line, at);
      if (at == 0) return false;
      continue;
    }
    const std::size_t behind = behind_blanks(line, ++at);
    double number = 0;
    bool whole = false;
    if (upper(sign) == 'M' && read_number(line.substr(behind), number, whole) > 0 && number == 98)
      return true;
  }
  return false;
}

LinuxcncFlow::LinuxcncFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text,
                           std::size_t start)
    : GcodeFlow(setup, lent, linuxcnc_grammar()) {
  texts_.push_back(std::move(text));
  add_o_words(0);
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_o_words(texts_.size() - 1);
  }
  frames_.push_back({.end = texts_[0].size(), .next = start, .current = start});
}

void LinuxcncFlow::add_o_words(std::size_t text) {
  const ProgramText& lines = texts_[text];
  Labelled& words = o_words_.emplace_back();
  std::size_t scope = 0;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    checkpoint_.pass();
    const std::string_view content = lines.line(line);
    const std::size_t at = head_of(content).behind;
    if (!is_o_word_at(content, at)) continue;
    std::string label;
    std::size_t behind = behind_label(content, at, label);
    if (behind == 0) continue;
    const Statement statement = statement_at(content, behind);
    // Both ends of a subprogram belong to the scope around it.
    if (statement == Statement::endsub) scope = 0;
    words[{scope, label, statement}].push_back(line);
    if (statement == Statement::sub) scope = line + 1;
  }
}

Flow::Step LinuxcncFlow::execute_next(std::string& flat) {
  bool goes_on = false;
  if (frame().next < frame().end)
    goes_on = execute_line(flat);
  else
    goes_on = frames_.size() == 1 ? end_program(flat)
                                  : refuse(Code::block_structure, 0,
                                           frame().name + ", a subprogram without its end");
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

bool LinuxcncFlow::execute_line(std::string& flat) {
  begin_line();
  return count_line() && (is_left_out(line_) || execute(flat));
}

// An O word after the end may begin a subprogram that nothing has called.
bool LinuxcncFlow::end_main_program(std::string& flat) {
  if (looks_ahead()) return ended_ = true;
  const Frame& main = frames_.front();
  const ProgramText& text = texts_.front();
  std::size_t behind = main.current + 1;
  const auto is_part = [&](std::string_view line) {
    return !is_o_word_at(line, head_of(line).behind);
  };
  for (; behind < main.end && is_part(text.line(behind)); ++behind) checkpoint_.pass();
  const std::size_t lost = first_with('G', 41, 42, main.current + 1, behind);
  if (lost < behind) return refuse_contour_behind_end(lost);
  written_behind_ = write_text_behind_end(flat, without_end_of_tape(main.current + 1, behind));
  return end_program(flat);
}

bool LinuxcncFlow::execute(std::string& flat) {
  if (is_percent(line_)) {
    if (looks_ahead()) return ended_ = true;
    if (frame().current > 0 && frames_.size() == 1) return end_program(flat);
    write_as_it_is(flat);
    return true;
  }
  if (!is_o_word_at(line_, head_.behind)) return execute_words(flat);
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  return execute_statement(flat);
}

std::optional<std::string> LinuxcncFlow::label_at(std::size_t& at) {
  std::string label;
  if (const std::size_t behind = behind_label(line_, at, label); behind > 0) {
    at = behind;
    return label;
  }
  ExpressionReader expression = expression_at(at + 1);
  const std::int64_t number = expression.whole_operand();
  at = expression.at();
  if (!expression.failed()) return std::to_string(number);
  refuse(expression.fault());
  return {};
}

bool LinuxcncFlow::execute_statement(std::string& flat) {
  std::size_t at = head_.behind;
  const auto label = label_at(at);
  if (!label) return false;
  const std::size_t begin = behind_blanks(line_, at);
  const Statement statement = statement_at(line_, at);
  if (statement == Statement::none && is_over(line_, begin)) {
    write_as_it_is(flat);
    return true;
  }
  if (statement == Statement::none)
    return refuse(Code::expression_invalid, begin, std::string(line_.substr(begin)));
  return follow(statement, *label, at, flat);
}

bool LinuxcncFlow::follow(Statement statement, const std::string& label, std::size_t at,
                          std::string& flat) {
  using enum Statement;
  bool holds = true;
  const bool has_condition = statement == if_true || statement == while_true;
  if (has_condition && !condition(at, holds)) return false;
  switch (statement) {
    case sub:
      if (!skip_behind(next_of(label, {endsub}), "sub")) return false;
      pass_over(frame().next);
      break;
    case endsub:
    case give_back:
      return return_from_sub(at, flat);
    case call:
      return call_sub(label, at, flat);
    case if_true:
      if (!holds) return choose(label);
      break;
    case elseif:  // after a branch that was taken
    case otherwise:
      return skip_behind(next_of(label, {endif}), "if");
    case while_true:
      if (!loop_while(label, holds)) return false;
      break;
    case endwhile: {
      const auto head = last_of(label, {while_true});
      if (!head) return skip_behind({}, "endwhile");
      frame().next = head->line;
      break;
    }
    case repeat: {
      ExpressionReader expression = expression_at(behind_blanks(line_, at));
      const std::int64_t count = expression.whole_operand();
      if (expression.failed()) return refuse(expression.fault());
      at = expression.at();
      repetitions_of(frame().current) = count;
      if (count == 0 && !skip_behind(next_of(label, {endrepeat}), "repeat")) return false;
      break;
    }
    case endrepeat: {
      const auto head = last_of(label, {repeat});
      if (!head) return skip_behind({}, "endrepeat");
      if (--repetitions_of(head->line) > 0) frame().next = head->line + 1;
      break;
    }
    case leave:
    case go_on:
      if (!leave_or_go_on(statement, label)) return false;
      break;
    case do_once:
    case endif:
    case none:
      break;
  }
  return finish_statement(flat, at);
}

bool LinuxcncFlow::condition(std::size_t& at, bool& holds) {
  const std::size_t begin = behind_blanks(line_, at);
  if (begin >= line_.size() || line_[begin] != '[')
    return refuse(Code::expression_invalid, begin, "a condition without [ ]");
  ExpressionReader expression = expression_at(begin);
  holds = expression.operand().number != 0;
  at = expression.at();
  return !expression.failed() || refuse(expression.fault());
}

std::span<const std::size_t> LinuxcncFlow::lines_of(std::size_t text, std::size_t scope,
                                                    const std::string& label,
                                                    Statement statement) const {
  const auto found = o_words_[text].find({scope, label, statement});
  return found == o_words_[text].end() ? std::span<const std::size_t>() : found->second;
}

std::optional<LinuxcncFlow::OWord> LinuxcncFlow::next_of(
    const std::string& label, std::initializer_list<Statement> statements) const {
  const Frame& at = frames_.back();
  std::optional<OWord> next;
  for (const Statement statement : statements) {
    const std::span<const std::size_t> lines = lines_of(at.text, at.begin, label, statement);
    const auto line = std::ranges::upper_bound(lines, at.current);
    if (line != lines.end() && (!next || *line < next->line)) next = {*line, statement};
  }
  return next;
}

std::optional<LinuxcncFlow::OWord> LinuxcncFlow::last_of(
    const std::string& label, std::initializer_list<Statement> statements) const {
  const Frame& at = frames_.back();
  std::optional<OWord> last;
  for (const Statement statement : statements) {
    const std::span<const std::size_t> lines = lines_of(at.text, at.begin, label, statement);
    const auto behind = std::ranges::lower_bound(lines, at.current);
    if (behind == lines.begin()) continue;
    const std::size_t line = *std::prev(behind);
    if (!last || line > last->line) last = {line, statement};
  }
  return last;
}

bool LinuxcncFlow::skip_behind(const std::optional<OWord>& word, std::string_view statement) {
  if (!word) {
    const bool of_loop = statement == "break" || statement == "continue";
    const std::string other = of_loop                        ? "a loop"
                              : statement.starts_with("end") ? std::string(statement.substr(3))
                                                             : "end" + std::string(statement);
    return refuse(Code::block_structure, head_.behind,
                  std::string(statement).append(" without ").append(other));
  }
  frame().next = word->line + 1;
  return true;
}

// After a condition that does not hold: goes to the first branch whose condition holds.
bool LinuxcncFlow::choose(const std::string& label) {
  using enum Statement;
  const std::size_t begin = frame().current;
  for (;;) {
    checkpoint_.pass();
    const auto word = next_of(label, {elseif, otherwise, endif});
    if (!word || word->statement != elseif) {
      frame().current = begin;
      return skip_behind(word, "if");
    }
    frame().current = word->line;
    line_ = text_of(frame()).line(word->line);
    head_ = head_of(line_);
    std::size_t at = head_.behind;
    bool holds = false;
    if (!label_at(at)) return false;
    static_cast<void>(statement_at(line_, at));
    if (!condition(at, holds)) return false;
    if (holds) {
      frame().next = word->line + 1;
      return true;
    }
  }
}

// A `while` ends a loop that begins with `do`, or begins a loop that ends with `endwhile`.
bool LinuxcncFlow::loop_while(const std::string& label, bool holds) {
  using enum Statement;
  const auto before = last_of(label, {do_once, while_true, endwhile});
  if (before && before->statement == do_once) {
    if (holds) frame().next = before->line + 1;
    return true;
  }
  const auto end = next_of(label, {endwhile});
  if (!end || !holds) return skip_behind(end, "while");
  return true;
}

bool LinuxcncFlow::leave_or_go_on(Statement statement, const std::string& label) {
  using enum Statement;
  const auto head = last_of(label, {while_true, do_once, repeat});
  if (!head) return skip_behind({}, statement == leave ? "break" : "continue");
  const bool is_do = head->statement == do_once;
  const auto end = next_of(label, {is_do                       ? while_true
                                   : head->statement == repeat ? endrepeat
                                                               : endwhile});
  if (!end || statement == leave) return skip_behind(end, "break");
  frame().next = head->statement == while_true ? head->line : end->line;
  return true;
}

}  // namespace trc::program
