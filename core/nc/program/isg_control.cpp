#include <algorithm>
#include <cmath>

#include "core/base/reasons.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/text/characters.h"

// Control statements of ISG: branches, loops and jumps.

namespace trc::program {
namespace {

// The end of a loop must not depend on the last digit of a sum (D-54).
bool is_nearly(double value, double other) {
  constexpr double least = 1e-9;
  return value != other && std::abs(value - other) <= least * (1 + std::abs(other));
}

}  // namespace

bool IsgFlow::follow(std::string& flat) {
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  const std::string word = word_behind_sign(line_, head_.behind);
  if (word == "GOTO") return execute_words(flat);
  ExpressionReader expression = expression_at(head_.behind + 1 + word.size());
  if (word == "BREAK" || word == "CONTINUE")
    return leave(flat, word == "BREAK" ? Exit::of_loop : Exit::of_round);
  using enum Structure;
  const Outline& outline = outline_of(frame());
  if (const auto barred = outline.misplaced.find(frame().current);
      barred != outline.misplaced.end())
    return refuse_misplaced(barred->second);
  switch (const Structure structure = structure_of(line_)) {
    case branch:
      return this->branch(flat, expression);
    case other_branch:
    case otherwise: {  // after a branch that was taken
      const auto end = partner(outline.feet, "$ENDIF");
      if (!end) return false;
      frame().next = *end + 1;
      return true;
    }
    case choice:
      return choose(flat, expression);
    case chosen:  // reached from the previous $CASE
      static_cast<void>(expression.expression());
      if (expression.failed()) return refuse(expression.fault());
      return refuse_words_behind(line_, expression.at());
    case by_default:
    case end_branch:
    case end_choice:
      return true;
    case counting:
    case end_counting:
      return count(flat, structure);
    case none:
      if (word != "IF")
        return refuse(Code::nc_unsupported, head_.behind, "$" + word + ", a control statement");
      return jump_if(expression) && finish_statement(flat, expression.at());
    default:
      return loop(structure, outline, expression) && finish_statement(flat, expression.at());
  }
}

// $WHILE, $DO and $REPEAT, and their ends.
bool IsgFlow::loop(Structure structure, const Outline& outline, ExpressionReader& expression) {
  using enum Structure;
  if (structure == endless) return partner(outline.feet, "$ENDDO").has_value();
  if (structure == repetition) return partner(outline.feet, "$UNTIL").has_value();
  if (structure == end_condition) {
    const auto head = partner(outline.heads, "$WHILE");
    if (head) frame().next = *head;
    return head.has_value();
  }
  const bool begins = structure == condition;
  const bool repeats = structure == end_endless;
  const bool has_condition = begins || !is_isg_line_over(line_, expression.at());
  const bool holds = has_condition ? expression.holds(expression.expression()) : repeats;
  if (expression.failed()) return refuse(expression.fault());
  if (begins) {
    const auto end = partner(outline.feet, "$ENDWHILE");
    if (end && !holds) frame().next = *end + 1;
    return end.has_value();
  }
  const auto head = partner(outline.heads, repeats ? "$DO" : "$REPEAT");
  if (head && holds == repeats) frame().next = *head + 1;
  return head.has_value();
}

// $IF P1 > 3 $GOTO N100
bool IsgFlow::jump_if(ExpressionReader& expression) {
  const bool holds = expression.holds(expression.expression());
  if (expression.failed()) return refuse(expression.fault());
  expression.pass_blanks();
  constexpr std::size_t length = 5;  // of $GOTO
  if (in_upper_case(line_.substr(expression.at(), length)) != "$GOTO")
    return refuse(Code::expression_invalid, expression.at(), "$IF without $GOTO");
  expression.go_to(expression.at() + length);
  const auto target = target_of(expression);
  if (target && holds) frame().next = *target;
  return target.has_value();
}

bool IsgFlow::refuse_misplaced(const Misplaced& misplaced) {
  frame().current = misplaced.line;
  const std::string_view line = text_of(frame()).line(misplaced.line);
  std::string detail = misplaced.detail;
  if (!misplaced.whole) detail.insert(0, "$" + word_behind_sign(line, isg_head_of(line).behind));
  return refuse(misplaced.code, misplaced.begin, std::move(detail));
}

// True if only comments follow.
bool IsgFlow::refuse_words_behind(std::string_view line, std::size_t at) {
  const std::size_t behind = behind_blanks(line, at);
  return is_isg_line_over(line, behind) ||
         refuse(Code::expression_invalid, behind, name_of_character(line.substr(behind)));
}

std::optional<std::size_t> IsgFlow::partner(const std::map<std::size_t, std::size_t>& partners,
                                            std::string_view missing) {
  const auto found = partners.find(frame().current);
  if (found != partners.end()) return found->second;
  refuse(Code::block_structure, head_.behind,
         ("$" + word_behind_sign(line_, head_.behind)).append(" without ").append(missing));
  return {};
}

// $IF, then each $ELSEIF until one holds, then $ELSE.
bool IsgFlow::branch(std::string& flat, ExpressionReader& expression) {
  const Outline& outline = outline_of(frame());
  const auto end = partner(outline.feet, "$ENDIF");
  if (!end) return false;
  bool holds = expression.holds(expression.expression());
  if (expression.failed()) return refuse(expression.fault());
  if (!finish_statement(flat, expression.at())) return false;
  std::size_t at = frame().current;
  while (!holds) {
    checkpoint_.pass();
    at = outline.next.at(at);
    const Structure structure = outline.structures.at(at);
    holds = structure != Structure::other_branch;
    if (holds) break;
    frame().current = at;
    line_ = text_of(frame()).line(at);
    head_ = isg_head_of(line_);
    constexpr std::size_t length = 7;  // of $ELSEIF
    ExpressionReader other = expression_at(head_.behind + length);
    holds = other.holds(other.expression());
    if (other.failed()) return refuse(other.fault());
    if (!is_isg_line_over(line_, other.at()))
      return refuse(Code::expression_invalid, other.at(), "words after $ELSEIF");
  }
  frame().next = at + 1;
  return true;
}

// By the manual, a $CASE value equals the chosen value if they differ by less than 0.001.
bool IsgFlow::choose(std::string& flat, ExpressionReader& expression) {
  constexpr double difference = 0.001;
  const Outline& outline = outline_of(frame());
  const auto end = partner(outline.feet, "$ENDSWITCH");
  if (!end) return false;
  assigns_in_choice_ = true;  // $SWITCH P1 = INT[…]
  const Value chosen = expression.expression();
  assigns_in_choice_ = false;
  if (expression.failed()) return refuse(expression.fault());
  if (!finish_statement(flat, expression.at())) return false;
  std::size_t target = *end;
  bool is_found = false;
  const auto choices = outline.choices.find(frame().current);
  for (std::size_t index = 0;
       choices != outline.choices.end() && !is_found && index < choices->second.size(); ++index) {
    checkpoint_.pass();
    const std::size_t line = choices->second[index];
    if (outline.structures.at(line) == Structure::by_default) {
      target = line;
      continue;
    }
    const std::string_view text = text_of(frame()).line(line);
    constexpr std::size_t length = 5;  // of $CASE
    ExpressionReader value(isg_grammar(), text, isg_head_of(text).behind + length, *this);
    const Value named = value.expression();
    if (value.failed() || !is_isg_line_over(text, value.at())) frame().current = line;
    if (value.failed()) return refuse(value.fault());
    if (!refuse_words_behind(text, value.at())) return false;
    is_found = named.is_text == chosen.is_text && named.text == chosen.text &&
               std::abs(named.number - chosen.number) < difference;
    if (is_found) target = line;
  }
  frame().next = target + 1;
  return true;
}

// $FOR P1 = first, last, step
bool IsgFlow::count(std::string& flat, Structure structure) {
  const bool begins = structure == Structure::counting;
  const Outline& outline = outline_of(frame());
  const auto other = begins ? partner(outline.feet, "$ENDFOR") : partner(outline.heads, "$FOR");
  if (!other) return false;
  const std::size_t head = begins ? frame().current : *other;
  const std::pair<std::size_t, std::size_t> key{frames_.size(), head};
  if (!begins && !counts_.contains(key))
    return refuse(Code::block_structure, head_.behind, "$ENDFOR of a loop that was not begun");
  const std::string_view line = text_of(frame()).line(head);
  constexpr std::size_t length = 4;  // of $FOR
  ExpressionReader expression(isg_grammar(), line, isg_head_of(line).behind + length, *this);
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string name = place_at(expression);
  expression.pass_blanks();
  if (!expression.failed() && expression.peek() != '=')
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "$FOR without ="));
  if (begins && !expression.failed()) {
    expression.go_to(expression.at() + 1);
    const Value first = expression.expression();
    std::pair<double, double>& limits = counts_[key];
    for (double* const limit : {&limits.first, &limits.second}) {
      expression.pass_blanks();
      if (!expression.failed() && expression.peek() != ',')
        static_cast<void>(expression.fail(Code::expression_invalid, begin,
                                          "$FOR wants a beginning, an end and a step"));
      if (!expression.failed()) expression.go_to(expression.at() + 1);
      *limit = expression.expression().number;
    }
    if (expression.failed()) return refuse(expression.fault());
    if (limits.second == 0) return refuse(Code::value_invalid, begin, "a step of 0");
    if (!assign(name, first, begin) || !finish_statement(flat, expression.at())) return false;
  }
  if (expression.failed()) return refuse(expression.fault());
  const auto [last, step] = counts_[key];
  const Value* const held_value = held(name);
  if (held_value == nullptr) return looks_ahead() || refuse(Code::variable_unset, begin, name);
  double now = held_value->number;
  if (!begins) now += step;
  if (is_nearly(now, last))
    return refuse(Code::value_invalid, head_.behind, "$FOR whose end hangs on the last digits");
  if (!begins && !assign(name, {.number = now}, begin)) return false;
  const bool goes_on = step > 0 ? now <= last : now >= last;
  if (goes_on != begins) frame().next = *other + 1;
  return true;
}

// Leaves $SWITCH or a loop; only a loop has rounds.
bool IsgFlow::leave(std::string& flat, Exit exit) {
  const bool leaves = exit == Exit::of_loop;
  const Outline& outline = outline_of(frame());
  const auto around = outline.around.find(frame().current);
  std::optional<std::size_t> head;
  if (around != outline.around.end()) head = leaves ? around->second.left : around->second.repeated;
  const auto foot = head ? outline.feet.find(*head) : outline.feet.end();
  if (foot == outline.feet.end())
    return refuse(Code::block_structure, head_.behind,
                  leaves ? "$BREAK outside of a loop" : "$CONTINUE outside of a loop");
  frame().next = foot->second + (leaves ? 1 : 0);
  constexpr std::size_t of_break = 6;
  constexpr std::size_t of_continue = 9;
  return finish_statement(flat, head_.behind + (leaves ? of_break : of_continue));
}

bool IsgFlow::has_block(std::int64_t number) const {
  const Frame& executed = frames_.back();
  const ProgramText& text = texts_[executed.text];
  for (std::size_t line = executed.begin; line < executed.end; ++line)
    if (isg_head_of(text.line(line)).number == number) return true;
  return false;
}

// N100, NP1, N[P1 + 10] or [NAME]: a unique line of the program that is executed.
std::optional<std::size_t> IsgFlow::target_of(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const Outline& outline = outline_of(frame());
  const std::vector<std::size_t>* lines = nullptr;
  bool has_no_colon = false;
  if (expression.peek() == '[') {
    const std::size_t close = std::min(line_.find(']', begin), line_.size());
    const std::string name = in_upper_case(line_.substr(begin + 1, close - begin - 1));
    if (const auto found = outline.labels.find(name); found != outline.labels.end())
      lines = &found->second;
    expression.go_to(std::min(close + 1, line_.size()));
  } else if (upper(expression.peek()) == 'N') {
    expression.go_to(begin + 1);
    const std::int64_t number = expression.whole_operand();
    if (const auto found = outline.numbers.find(number); found != outline.numbers.end())
      lines = &found->second;
    else
      has_no_colon = has_block(number);
  } else {
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "$GOTO without N or [ ]"));
  }
  if (expression.failed()) {
    refuse(expression.fault());
    return {};
  }
  if (lines != nullptr && lines->size() == 1) return lines->front();
  std::string target(line_.substr(begin, expression.at() - begin));
  if (lines != nullptr) target.append(", which is there twice");
  if (has_no_colon) target.append(reason::no_colon_after_number);
  refuse(Code::jump_target_unknown, begin, target);
  return {};
}

bool IsgFlow::finish_statement(std::string& flat, std::size_t at) {
  const std::size_t behind = behind_blanks(line_, at);
  if (behind >= line_.size()) return true;
  if (!is_isg_line_over(line_, behind))
    return refuse(Code::expression_invalid, behind, name_of_character(line_.substr(behind)));
  write_behind_number(flat, line_.substr(behind));
  return true;
}

}  // namespace trc::program
