#include "core/nc/program/fanuc_flow.h"

#include <algorithm>
#include <cmath>

#include "core/nc/dialect/pass_words.h"
#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

bool is_statement_at(std::string_view line, std::size_t at) {
  return has_word_at(line, at, "IF") || has_word_at(line, at, "WHILE") ||
         has_word_at(line, at, "GOTO") || has_word_at(line, at, "DO") ||
         has_word_at(line, at, "END") || has_word_at(line, at, "ELSE");
}

// IF [ ] THEN with nothing behind it: the lines up to ELSE or ENDIF.
bool begins_branch(std::string_view line, std::size_t at) {
  if (!has_word_at(line, at, "IF")) return false;
  constexpr std::string_view then = "THEN";
  for (std::size_t end = at; end < line.size() && line[end] != '(' && line[end] != ';'; ++end)
    if (has_word_at(line, end, then)) return is_over(line, end + then.size());
  return false;
}

// O1001, :1001 at the beginning of a line; -1: none.
std::int64_t number_of_unit(std::string_view line) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
  std::size_t at = behind_blanks(line, 0);
  if (at >= line.size() || (upper(line[at]) != 'O' && line[at] != ':')) return -1;
  at = behind_blanks(line, at + 1);
  double number = 0;
  bool whole = false;
  if (at >= line.size() || !is_digit(line[at]) ||
      read_number(line.substr(at), number, whole) == 0 || !whole || !is_whole(number))
    return -1;
  return static_cast<std::int64_t>(number);
}

// Of a file, without its folder and what its kind is.
std::string_view stem_of(std::string_view name) {
  const std::size_t folder = name.find_last_of("/\\");
  if (folder != std::string_view::npos) name.remove_prefix(folder + 1);
  return name.substr(0, name.find('.'));
}

// The number in the name of a file: O1001, O1001.nc, 1001.
std::int64_t number_of_name(std::string_view name) {
  std::string line(stem_of(name));
  if (line.empty() || upper(line.front()) != 'O') line.insert(0, "O");
  return number_of_unit(line);
}

// O<PART1>, <PART1>; empty: the line is something else.
std::string_view name_in(std::string_view line) {
  std::size_t at = behind_blanks(line, 0);
  if (at < line.size() && upper(line[at]) == 'O') at = behind_blanks(line, at + 1);
  const std::size_t close = line.find('>', at);
  if (at >= line.size() || line[at] != '<' || close == std::string_view::npos ||
      !is_over(line, close + 1))
    return {};
  return line.substr(at + 1, close - at - 1);
}

}  // namespace

bool fanuc_computes(std::string_view line) {
  const std::size_t begin = head_of(line).behind;
  if (is_statement_at(line, begin)) return true;
  bool returns = false;
  for (std::size_t at = begin; at < line.size();) {
    const char sign = line[at];
    if (sign == '#' || sign == '[') return true;
    if (sign == ';') return false;
    if (sign == '(') {
      at = behind_comment(line, at);
      if (at == 0) return false;
      continue;
    }
    if (!is_letter(sign)) {
      ++at;
      continue;
    }
    if (at + 1 < line.size() && is_letter(line[at + 1])) return false;
    const char letter = upper(sign);
    at = behind_blanks(line, at + 1);
    if (letter == 'P' && returns) return true;
    if (letter != 'M' && letter != 'G') continue;
    double number = 0;
    bool whole = false;
    at += read_number(line.substr(at), number, whole);
    if (letter == 'M' ? number == 97 || number == 98 : number == 65 || number == 66) return true;
    returns |= letter == 'M' && number == 99;
  }
  return false;
}

FanucFlow::FanucFlow(const ProgramSetup& setup, CallPlaces& calls, ProgramText text,
                     std::size_t start)
    : CodeFlow(setup, calls, fanuc_grammar()) {
  texts_.push_back(std::move(text));
  add_units(0);
  // The line of the O itself belongs to what it names.
  const Unit main =
      *std::ranges::find_if(units_, [&](const Unit& unit) { return start < unit.end; });
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_units(texts_.size() - 1);
  }
  entered_.resize(units_.size());
  frames_.push_back({.begin = main.begin, .end = main.end, .next = start, .current = start});
  for (std::size_t number = 1; number < locals_.front().size(); ++number)
    if (const double* value = given(std::to_string(number))) locals_.front()[number] = *value;
}

std::int64_t FanucFlow::number_of_program(std::string_view line) {
  if (const std::string_view name = name_in(line); !name.empty()) return number_of_named(name);
  return number_of_unit(line);
}

std::int64_t FanucFlow::number_of_named(std::string_view name) {
  const std::string capitals = in_upper_case(name);
  const auto known = std::ranges::find(names_, capitals);
  const auto index = known - names_.begin();
  if (known == names_.end()) names_.push_back(capitals);
  return first_named + index;
}

// A text is divided where an O stands.
void FanucFlow::add_units(std::size_t text) {
  const ProgramText& lines = texts_[text];
  Unit unit{.text = text};
  const std::size_t known = units_.size();
  bool begun = false;  // something but names has been seen
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const std::int64_t number = number_of_program(lines.line(line));
    if (number >= 0 && begun) {
      unit.end = line;
      units_.push_back(unit);
      unit = {.text = text, .begin = line};
    }
    if (number >= 0) {
      unit.number = number;
      unit.begin = line + 1;
      // The main program goes back to its very beginning.
      if (text == 0 && units_.empty()) unit.begin = 0;
    }
    const std::string_view content = lines.line(line);
    begun |= number >= 0 || (!is_over(content, 0) && !is_percent(content));
  }
  unit.end = lines.size();
  units_.push_back(unit);
  const bool is_named = std::any_of(units_.begin() + static_cast<std::ptrdiff_t>(known),
                                    units_.end(), [](const Unit& u) { return u.number >= 0; });
  if (!is_named && text > 0) {
    const std::int64_t number = number_of_name(lines.name());
    units_[known].number = number < 0 ? number_of_named(stem_of(lines.name())) : number;
  }
  for (std::size_t unit_index = known; unit_index < units_.size(); ++unit_index)
    units_of_number_[units_[unit_index].number].push_back(unit_index);
}

const FanucFlow::Outline& FanucFlow::outline_of(const Frame& frame) {
  const auto [known, is_new] = outlines_.try_emplace({frame.text, frame.end});
  Outline& outline = known->second;
  if (!is_new) return outline;
  // A call by M97 begins within; what can be reached is its program as a whole.
  const auto unit = std::ranges::find_if(
      units_, [&](const Unit& each) { return each.text == frame.text && each.end == frame.end; });
  const ProgramText& text = text_of(frame);
  std::vector<std::pair<std::size_t, std::size_t>> open;  // number of the loop, line
  std::vector<std::size_t> branches;                      // their IF or ELSE
  for (std::size_t line = unit->begin; line < unit->end; ++line) {
    const std::string_view content = text.line(line);
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
    const bool begins =
        has_word_at(content, head.behind, "WHILE") || has_word_at(content, head.behind, "DO");
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

// Behind DO or END, wherever that is; `none`: nowhere.
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

Flow::Step FanucFlow::execute_next(std::string& flat) {
  Frame& at = frame();
  const bool goes_on = at.next >= at.end ? end_of_unit(flat) : execute_line(flat);
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

bool FanucFlow::execute_line(std::string& flat) {
  begin_line();
  return count_line() && (is_left_out(line_) || execute(flat));
}

bool FanucFlow::end_of_unit(std::string& flat) {
  if (looks_ahead()) return ended_ = true;
  Frame& at = frame();
  if (frames_.size() == 1 && at.end == texts_[at.text].size()) return end_main_program(flat);
  if (frames_.size() == 1) {
    // It runs into the next O.
    at.current = at.end;
    return refuse(Code::nc_unsupported, 0, "O, a second program in one text");
  }
  return refuse(Code::block_structure, 0, frame().name + ", a subprogram without M99");
}

// What stands behind an N word may be where a jump leads to for other values, and subprograms that
// nothing has called need not come out. A second main program, with an end of its
// own, does: its contour must not be lost.
bool FanucFlow::end_main_program(std::string& flat) {
  if (looks_ahead()) return ended_ = true;
  const Frame& main = frames_.front();
  std::size_t behind = main.current + 1;
  while (behind < main.end && head_of(texts_.front().line(behind)).number < 0) ++behind;
  const std::size_t lost = first_with('G', 41, 42, main.current + 1, behind);
  if (lost < behind) return refuse_contour_behind_end(lost);
  for (const Unit& unit : units_) {
    const auto index = static_cast<std::size_t>(&unit - units_.data());
    if (unit.text > 0 || entered_[index] || unit.begin == frames_.front().begin) continue;
    const std::size_t selects = first_with('G', 41, 42, unit.begin, unit.end);
    if (selects < unit.end && first_with('M', 2, 30, unit.begin, unit.end) < unit.end)
      return refuse_contour_behind_end(selects);
  }
  return end_program(flat);
}

bool FanucFlow::execute(std::string& flat) {
  if (is_percent(line_)) {
    if (frame().current > 0) return end_of_unit(flat);
    flat.append(line_).append(line_end());
    return true;
  }
  std::size_t at = head_.behind;
  // (B) #102=2: the comment comes out by itself.
  std::size_t behind = at;
  while (behind < line_.size() && line_[behind] == '(' && behind_comment(line_, behind) > 0)
    behind = behind_blanks(line_, behind_comment(line_, behind));
  if (behind > at && behind < line_.size() && line_[behind] == '#') {
    flat.append(without_blanks_behind(line_.substr(at, behind - at))).append(line_end());
    at = behind;
  }
  const bool assigns = at < line_.size() && line_[at] == '#';
  if (!assigns && !is_statement_at(line_, at)) return execute_words(flat);
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  return assigns ? assign(flat, at) : execute_statement(flat);
}

bool FanucFlow::execute_statement(std::string& flat) {
  ExpressionReader expression = expression_at(head_.behind);
  if (expression.pass("IF")) return branch(flat, expression);
  if (expression.pass("WHILE")) return loop(flat, expression, true);
  if (expression.pass("DO")) return loop(flat, expression, false);
  if (expression.pass("ENDIF")) return finish_statement(flat, expression.at());
  if (expression.pass("ELSE"))  // behind a branch that was taken
    return go_behind_foot("ELSE without ENDIF") && finish_statement(flat, expression.at());
  if (expression.pass("END")) return end_loop(flat, expression);
  expression.pass("GOTO");
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
  if (!expression.pass("GOTO"))
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

bool FanucFlow::loop(std::string& flat, ExpressionReader& expression, bool has_condition) {
  bool holds = true;
  if (has_condition) {
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

// The first one behind the line that is executed, else the first one from the beginning.
std::optional<std::size_t> FanucFlow::line_of(const Frame& frame, std::int64_t number) {
  const Outline& outline = outline_of(frame);
  const auto lines = outline.labels.find(number);
  if (lines == outline.labels.end()) return {};
  const auto behind = std::ranges::upper_bound(lines->second, frame.current);
  return behind == lines->second.end() ? lines->second.front() : *behind;
}

bool FanucFlow::assign(std::string& flat, std::size_t at) {
  ExpressionReader expression = expression_at(at);
  const std::int64_t number = number_of_variable(expression);
  expression.pass_blanks();
  if (!expression.failed() && expression.peek() != '=')
    return refuse(Code::expression_invalid, at, "# without =");
  expression.go_to(expression.at() + (expression.failed() ? 0 : 1));
  const Value value = expression.expression();
  if (expression.failed()) return refuse(expression.fault());
  const std::size_t behind = expression.at();
  if (!is_over(line_, behind)) {
    const std::size_t place = behind_blanks(line_, behind);
    return refuse(Code::expression_invalid, place,
                  line_[place] == '#' ? "#, a second assignment: one in a block"
                                      : name_of_character(line_.substr(place)));
  }
  if (!value.vacant && is_machine_switch(number)) {
    std::string text = "#" + std::to_string(number) + "=";
    append_value(text, value.number, PointStyle::as_whole);
    const std::string comments = comments_of(line_, behind);
    write_behind_number(flat, comments.empty() ? text : text + " " + comments);
    return true;
  }
  constexpr std::int64_t stop = 3006;
  if (number == stop) {
    const std::string comments = comments_of(line_, behind);
    write_behind_number(flat, comments.empty() ? "M00" : "M00 " + comments);
    return true;
  }
  constexpr std::int64_t first_of_wear = 12001;
  constexpr std::int64_t last_of_wear = 12999;
  if (number >= first_of_wear && number <= last_of_wear && value.number != 0)
    return refuse(Code::nc_unsupported, at,
                  "#" + std::to_string(number) + ", the wear of a tool radius");
  if (const std::string data = data_setting(number, value); !data.empty()) {
    common_[number] = value.number;
    const std::string comments = comments_of(line_, behind);
    write_behind_number(flat, comments.empty() ? data : data + " " + comments);
    return true;
  }
  return set(number, value, at) && finish_statement(flat, behind);
}

// What sets a zero point or the radius of a tool, as G10 does it, which the reader follows: under
// G91 that would add. Which register #2001 to #2800 and #10001 are hangs on the memory of the
// control. Empty: it is none.
std::string FanucFlow::data_setting(std::int64_t number, const Value& value) const {
  constexpr std::int64_t in_row = 20;  // axes of one zero point
  constexpr std::string_view axes = "XYZ";
  const auto index_in = [&](std::int64_t first, std::int64_t last) {
    return number >= first && number <= last ? number - first : -1;
  };
  const std::int64_t standard = index_in(5201, 5328);
  const std::int64_t further = index_in(7001, 7948);
  const std::int64_t wear = index_in(12001, 12999);
  const std::int64_t radius = index_in(13001, 13999);
  std::string text;
  if (value.vacant || modes_.incremental) return text;
  const std::int64_t zero_point = std::max(standard, further);
  if (zero_point >= 0) {
    const auto axis = static_cast<std::size_t>(zero_point % in_row);
    if (axis >= axes.size()) return text;
    text = standard >= 0 ? "G10 L2 P" + std::to_string(standard / in_row)
                         : "G10 L20 P" + std::to_string(further / in_row + 1);
    text.append(" ").append(1, axes[axis]);
  } else if (radius >= 0 || wear >= 0) {
    text = radius >= 0 ? "G10 L12 P" + std::to_string(radius + 1) + " R"
                       : "G10 L13 P" + std::to_string(wear + 1) + " R";
  }
  if (!text.empty()) append_value(text, value.number, PointStyle::with_point);
  return text;
}

bool FanucFlow::set(std::int64_t number, const Value& value, std::size_t begin) {
  const std::optional<double> content =
      value.vacant ? std::optional<double>() : std::optional<double>(value.number);
  constexpr std::int64_t alarm = 3000;
  const auto locals = static_cast<std::int64_t>(locals_.back().size());
  if (number > 0 && number < locals) {
    locals_.back()[static_cast<std::size_t>(number)] = content;
  } else if (number >= 100 && number < 1000) {
    common_[number] = content;
  } else if (number == alarm) {
    return refuse(Code::program_alarm, begin,
                  std::string(without_blanks_behind(line_.substr(begin))));
  } else {
    return refuse(number >= 1000 ? Code::machine_state : Code::value_invalid, begin,
                  std::string("#").append(std::to_string(number)));
  }
  return true;
}

std::int64_t FanucFlow::number_of_variable(ExpressionReader& expression) {
  expression.go_to(expression.at() + 1);
  return expression.whole_operand();
}

// #4001 … : the functions of their groups that hold.
std::optional<double> FanucFlow::modal_value(std::int64_t number) const {
  switch (number) {
    case 4001:
      return static_cast<double>(modes_.motion);
    case 4002:
      return modes_.plane == Plane::xy ? 17 : modes_.plane == Plane::zx ? 18 : 19;
    case 4003:
      return modes_.incremental ? 91 : 90;
    case 4006:
      return modes_.inch ? 20 : 21;
    default:
      return {};
  }
}

// Where lines are looked at, what is vacant might have been given a value.
Value FanucFlow::content_or_vacant(const std::optional<double>& content) const {
  if (looks_ahead() && !content) return {.number = 1};
  return {.number = content.value_or(0), .vacant = !content};
}

Value FanucFlow::lost(ExpressionReader& expression, std::int64_t number, std::size_t begin) {
  return without_value(expression, Code::variable_unset, begin,
                       "#" + std::to_string(number) + ", which may have been set by " + lost_to_);
}

Value FanucFlow::read(ExpressionReader& expression) {
  suppose();
  const std::size_t begin = expression.at();
  const std::int64_t number = number_of_variable(expression);
  if (expression.failed() || number == 0) return {.vacant = true};
  const auto locals = static_cast<std::int64_t>(locals_.back().size());
  if (number < locals) {
    const auto& content = locals_.back()[static_cast<std::size_t>(number)];
    if (locals_.back().are_lost && !content) return lost(expression, number, begin);
    return content_or_vacant(content);
  }
  if (const auto known = common_.find(number); known != common_.end())
    return content_or_vacant(known->second);
  const std::string name = std::to_string(number);
  if (const double* value = given(name)) return {.number = *value};
  if (const auto value = modal_value(number)) return {.number = *value};
  if (number < 1000 && !lost_to_.empty()) return lost(expression, number, begin);
  if (number >= 100 && number < 500) return content_or_vacant({});
  const Code code = number >= 1000  ? Code::machine_state
                    : number >= 500 ? Code::variable_unset
                                    : Code::value_invalid;
  return without_value(expression, code, begin, "#" + name);
}

bool FanucFlow::exists(ExpressionReader& /*expression*/) { return false; }

}  // namespace trc::program
