#include "core/nc/program/fanuc_flow.h"

#include <algorithm>

#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

bool is_statement_at(std::string_view line, std::size_t at) {
  return has_word_at(line, at, "IF") || has_word_at(line, at, "WHILE") ||
         has_word_at(line, at, "GOTO") || has_word_at(line, at, "DO") ||
         has_word_at(line, at, "END") || has_word_at(line, at, "ELSE");
}

// O1001, :1001 at the beginning of a line; -1: none.
std::int64_t number_of_unit(std::string_view line) {
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
    : GcodeFlow(setup, calls, fanuc_grammar()) {
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
  if (frames_.size() == 1 && at.end == texts_[at.text].size()) {
    write_lasting_values(flat);
    return end_main_program(flat);
  }
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

}  // namespace trc::program
