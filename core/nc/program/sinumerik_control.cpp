#include <algorithm>
#include <array>
#include <cmath>

#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"

// Branches, loops and jumps of Sinumerik.

namespace trc::program {
namespace {

// Compares as the control does: equal within 1e-12 of the size.
bool is_at_most(double value, double end) {
  constexpr double digits = 1e-12;
  return value <= end + digits * std::max(std::abs(value), std::abs(end));
}

bool is_count_of_repetitions(std::string_view name) {
  return !name.empty() && upper(name.front()) == 'P' &&
         name.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

}  // namespace

bool SinumerikFlow::follow_structure(std::string& flat, Structure structure) {
  using enum Structure;
  const std::size_t behind = head_.behind + name_at(line_, head_.behind).size();
  ExpressionReader expression = expression_at(behind);
  const Outline& outline = outline_of(frame());
  const auto go_behind = [&](const std::optional<std::size_t>& line) {
    if (line) frame().next = *line + 1;
    return line.has_value();
  };
  switch (structure) {
    case branch:
      return this->branch(flat, expression);
    case otherwise:  // after a branch that was taken
      if (!go_behind(partner(outline.behind, "ENDIF"))) return false;
      break;
    case counting:
    case end_counting:
      return count(flat, structure);
    case condition: {
      const bool holds = expression.holds(expression.expression());
      if (expression.failed()) return refuse(expression.fault());
      const auto end = partner(outline.feet, "ENDWHILE");
      if (!end) return false;
      if (!holds) frame().next = *end + 1;
      break;
    }
    case end_condition: {
      const auto head = partner(outline.heads, "WHILE");
      if (!head) return false;
      frame().next = *head;
      break;
    }
    case endless:
      if (!partner(outline.feet, "ENDLOOP")) return false;
      break;
    case end_endless:
      if (!go_behind(partner(outline.heads, "LOOP"))) return false;
      break;
    case repetition:
      if (!partner(outline.feet, "UNTIL")) return false;
      break;
    case Structure::until:
      return this->until(flat, expression);
    case end_branch:
      if (!outline.heads.contains(frame().current))
        return refuse(Code::block_structure, head_.behind, "ENDIF without IF");
      break;
    case none:
      break;
  }
  return finish_statement(flat, expression.at());
}

std::optional<std::size_t> SinumerikFlow::partner(
    const std::map<std::size_t, std::size_t>& partners, std::string_view missing) {
  const auto found = partners.find(frame().current);
  const bool is_there =
      found != partners.end() && found->second >= frame().begin && found->second < frame().end;
  if (is_there) return found->second;
  refuse(Code::block_structure, head_.behind,
         name_at(line_, head_.behind).append(" without ").append(missing));
  return {};
}

// IF with a jump in its line, or with lines up to ELSE or ENDIF.
bool SinumerikFlow::branch(std::string& flat, ExpressionReader& expression) {
  const bool holds = expression.holds(expression.expression());
  if (expression.failed()) return refuse(expression.fault());
  expression.pass_blanks();
  if (direction_of(in_upper_case(expression.name())))
    return (holds ? jump(expression) : pass_jump(expression)) &&
           finish_statement(flat, expression.at());
  const Outline& outline = outline_of(frame());
  const auto end = partner(outline.feet, "ENDIF");
  if (!end) return false;
  if (!holds) frame().next = *end + 1;
  return finish_statement(flat, expression.at());
}

// FOR name = first TO last. If the round changes `last`, the behaviour of the control is unknown.
bool SinumerikFlow::count(std::string& flat, Structure structure) {
  const bool begins = structure == Structure::counting;
  const Outline& outline = outline_of(frame());
  const auto other = begins ? partner(outline.feet, "ENDFOR") : partner(outline.heads, "FOR");
  if (!other) return false;
  const std::pair<std::size_t, std::size_t> key{frames_.size(), begins ? frame().current : *other};
  const auto known = counts_.find(key);
  if (!begins && known == counts_.end())
    return refuse(Code::block_structure, head_.behind, "ENDFOR of a loop that was not begun");
  const std::string_view line = text_of(frame()).line(key.second);
  constexpr std::size_t length = 3;  // of FOR
  ExpressionReader expression(sinumerik_grammar(), line, named_head_of(line).behind + length,
                              *this);
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const auto place = place_at(expression);
  expression.pass_blanks();
  if (!expression.failed() && expression.peek() != '=')
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "FOR without ="));
  if (!expression.failed()) expression.go_to(expression.at() + 1);
  Value value = expression.expression();
  if (!expression.failed() && in_upper_case(expression.name()) != "TO")
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "FOR without TO"));
  if (!expression.failed()) expression.go_to(expression.at() + 2);
  if (!begins && !expression.failed()) value = content_of(*place, expression, begin);
  if (!begins) value.number += 1;
  if (!expression.failed() && !store(*place, value, begin)) return false;
  const double last = expression.expression().number;
  if (expression.failed()) return refuse(expression.fault());
  if (begins) counts_[key] = last;
  if (!begins && known->second != last)
    return refuse(Code::value_invalid, head_.behind, "FOR to an end that its loop changes");
  const double now = content_of(*place, expression, begin).number;
  // Continues after the end of the loop, or after its head.
  if (is_at_most(now, last) != begins) frame().next = *other + 1;
  constexpr std::size_t length_of_end = 6;  // of ENDFOR
  return finish_statement(flat, begins ? expression.at() : head_.behind + length_of_end);
}

bool SinumerikFlow::until(std::string& flat, ExpressionReader& expression) {
  const bool holds = expression.holds(expression.expression());
  if (expression.failed()) return refuse(expression.fault());
  const auto head = partner(outline_of(frame()).heads, "REPEAT");
  if (!head) return false;
  if (!holds) frame().next = *head + 1;
  return finish_statement(flat, expression.at());
}

// CASE (R1) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C
bool SinumerikFlow::choose_case(ExpressionReader& expression, std::string& flat) {
  const Value chosen = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  if (in_upper_case(expression.name()) != "OF")
    return refuse(Code::expression_invalid, head_.behind, "CASE without OF");
  expression.go_to(expression.at() + 2);
  bool has_jumped = false;
  for (expression.pass_blanks(); !is_named_line_over(line_, expression.at());
       expression.pass_blanks()) {
    const std::string_view word = expression.name();
    bool is_chosen = in_upper_case(word) == "DEFAULT";
    if (is_chosen) {
      expression.go_to(expression.at() + word.size());
    } else {
      const Value value = expression.operand();
      if (expression.failed()) return refuse(expression.fault());
      is_chosen = value.is_text == chosen.is_text && value.text == chosen.text &&
                  is_at_most(value.number, chosen.number) &&
                  is_at_most(chosen.number, value.number);
    }
    const bool jumps = is_chosen && !has_jumped;
    if (!(jumps ? jump(expression) : pass_jump(expression))) return false;
    has_jumped |= jumps;
  }
  return finish_statement(flat, expression.at());
}

std::optional<SinumerikFlow::Direction> SinumerikFlow::direction_of(std::string_view word) {
  if (word == "GOTOF") return Direction::forward;
  if (word == "GOTOB") return Direction::backward;
  if (word == "GOTO" || word == "GOTOC") return Direction::both;
  if (word == "GOTOS") return Direction::to_the_beginning;
  return {};
}

// A label, N100 or :100, or a text that contains one of these.
std::string SinumerikFlow::target_at(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  if (expression.peek() == ':') {
    std::size_t end = begin + 1;
    while (end < line_.size() && is_digit(line_[end])) ++end;
    expression.go_to(end);
    return std::string("N").append(line_.substr(begin + 1, end - begin - 1));
  }
  std::string name = in_upper_case(expression.name());
  const Variable* const variable = declared(name);
  const bool is_text = variable != nullptr && variable->type == Type::text;
  if (is_text || expression.peek() == '"') {
    const Value value = expression.operand();
    return in_upper_case(value.text);
  }
  expression.go_to(begin + name.size());
  if (name.empty())
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "a jump without target"));
  return name;
}

std::optional<std::size_t> SinumerikFlow::line_of(const std::string& target, Direction direction) {
  const Outline& outline = outline_of(frame());
  const std::vector<std::size_t>* lines = nullptr;
  constexpr std::size_t most_digits = 15;
  const bool is_number = target.size() > 1 && target.size() <= most_digits &&
                         target.front() == 'N' &&
                         target.find_first_not_of("0123456789", 1) == std::string::npos;
  if (is_number) {
    const auto found = outline.numbers.find(std::stoll(target.substr(1)));
    if (found != outline.numbers.end()) lines = &found->second;
  } else if (const auto found = outline.labels.find(target); found != outline.labels.end()) {
    lines = &found->second;
  }
  if (lines == nullptr) return {};
  // A label in the line itself counts as backward.
  const auto behind = std::ranges::upper_bound(*lines, frame().current);
  if (direction != Direction::backward && behind != lines->end()) return *behind;
  if (direction != Direction::forward && behind != lines->begin()) return *std::prev(behind);
  return {};
}

bool SinumerikFlow::jump(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::string word = in_upper_case(expression.name());
  const auto direction = direction_of(word);
  if (!direction)
    return refuse(Code::expression_invalid, expression.at(), "a condition without GOTO");
  expression.go_to(expression.at() + word.size());
  if (*direction == Direction::to_the_beginning) {
    frame().next = frame().begin;
    return frames_.size() == 1 ||
           refuse(Code::jump_target_unknown, head_.behind, "GOTOS in a subprogram");
  }
  expression.pass_blanks();
  const std::size_t begin = expression.at();
  const std::string target = target_at(expression);
  if (expression.failed()) return refuse(expression.fault());
  const auto line = line_of(target, *direction);
  const bool is_within = line && *line >= frame().begin && *line < frame().end;
  if (is_within) {
    frame().next = *line;
    return true;
  }
  if (word == "GOTOC" && !line) return true;
  return refuse(Code::jump_target_unknown, begin,
                line ? target + ", outside of what is repeated" : target);
}

bool SinumerikFlow::pass_jump(ExpressionReader& expression) {
  expression.pass_blanks();
  const std::string word = in_upper_case(expression.name());
  const auto direction = direction_of(word);
  if (!direction)
    return refuse(Code::expression_invalid, expression.at(), "a condition without GOTO");
  expression.go_to(expression.at() + word.size());
  if (*direction == Direction::to_the_beginning) return true;
  static_cast<void>(target_at(expression));
  return !expression.failed() || refuse(expression.fault());
}

// REPEATB label, REPEAT label (up to ENDLABEL, else up to here), REPEAT label label, P=times.
bool SinumerikFlow::repeat(std::string& flat, std::size_t at, Repeated repeated) {
  ExpressionReader expression = expression_at(at);
  std::vector<std::string> labels;
  expression.pass_blanks();
  for (std::string_view name = expression.name();
       !name.empty() && !is_count_of_repetitions(name) && labels.size() < 2;
       name = expression.name()) {
    labels.push_back(in_upper_case(name));
    expression.go_to(expression.at() + name.size());
    expression.pass_blanks();
  }
  std::int64_t times = 1;
  if (is_count_of_repetitions(expression.name())) {
    expression.go_to(expression.at() + 1);
    expression.pass_blanks();
    if (expression.peek() == '=') expression.go_to(expression.at() + 1);
    times = expression.whole_operand();
  }
  if (expression.failed()) return refuse(expression.fault());
  const std::size_t here = frame().current;
  const auto place_of = [&](const std::string& label) {
    const auto line = line_of(label, Direction::backward);
    return line ? line : line_of(label, Direction::forward);
  };
  const auto first = labels.empty() ? std::nullopt : place_of(labels.front());
  const auto last = labels.size() < 2 ? first : place_of(labels.back());
  if (!first || !last)
    return refuse(Code::jump_target_unknown, at,
                  labels.empty() ? "REPEAT without label"
                  : first        ? labels.back()
                                 : labels.front());
  std::size_t end = *last + 1;
  if (repeated == Repeated::section && labels.size() == 1) {
    const auto& all = outline_of(frame()).labels;
    const auto ends = all.find("ENDLABEL");
    const bool is_before = *first < here;
    end = is_before ? here : 0;
    if (ends != all.end()) {
      const auto line = std::ranges::lower_bound(ends->second, *first);
      if (line != ends->second.end() && (!is_before || *line < here)) end = *line + 1;
    }
  }
  if (end <= *first || (*first <= here && here < end))
    return refuse(Code::block_structure, at, "REPEAT of what has no end, or of itself");
  if (!finish_statement(flat, expression.at())) return false;
  if (times == 0) return true;
  flat.append("; ").append(labels.front()).append(line_end());
  return enter({.text = frame().text,
                .begin = *first,
                .end = end,
                .next = *first,
                .current = *first,
                .restart = *first,
                .repetitions_left = static_cast<std::uint64_t>(times) - 1,
                .name = labels.front()});
}

}  // namespace trc::program
