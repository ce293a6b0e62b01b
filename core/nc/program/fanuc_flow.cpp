#include "core/nc/program/fanuc_flow.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

bool is_statement_at(std::string_view line, std::size_t at) {
  return has_word_at(line, at, "IF") || length_of_word_at(line, at, "WHILE") > 0 ||
         length_of_word_at(line, at, "GOTO") > 0 || has_word_at(line, at, "DO") ||
         has_word_at(line, at, "END") || has_word_at(line, at, "ELSE");
}

// The name of a file without its folder and extension.
std::string_view stem_of(std::string_view name) {
  const std::size_t folder = name.find_last_of("/\\");
  if (folder != std::string_view::npos) name.remove_prefix(folder + 1);
  return name.substr(0, name.find('.'));
}

// The number in the name of a file: O1001, O1001.nc, 1001.
std::int64_t number_of_name(std::string_view name) {
  std::string line(stem_of(name));
  if (line.empty() || upper(line.front()) != 'O') line.insert(0, "O");
  return program_head_of(line).number;
}

std::optional<std::int64_t> number_behind(std::string_view line, char letter) {
  for (std::size_t at = 0; at < line.size() && line[at] != ';';) {
    const std::size_t behind = line[at] == '(' ? behind_comment(line, at) : at + 1;
    if (behind == 0) break;
    const bool is_it = upper(line[at]) == letter;
    at = behind_blanks(line, behind);
    double number = 0;
    bool whole = false;
    if (is_it && at < line.size() && read_number(line.substr(at), number, whole) > 0 &&
        is_whole(number))
      return static_cast<std::int64_t>(number);
  }
  return {};
}

}  // namespace

bool fanuc_computes(std::string_view line) {
  if (may_begin_program(line)) line.remove_prefix(program_head_of(line).behind);
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

FanucFlow::FanucFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text,
                     std::size_t start)
    : GcodeFlow(setup, lent, fanuc_grammar()) {
  texts_.push_back(std::move(text));
  add_units(0);
  // The line of the O itself belongs to the program that it names.
  const auto found =
      std::ranges::find_if(units_, [&](const Unit& unit) { return start < unit.end; });
  // A main program that comes first includes all lines before it.
  if (found == units_.begin()) found->begin = 0;
  const Unit main = *found;
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_units(texts_.size() - 1);
  }
  entered_.resize(units_.size());
  frames_.push_back({.begin = main.begin, .end = main.end, .next = start, .current = start});
  // The text before the first program belongs to the tape.
  const bool begins_behind = main.begin > 0 && program_head_of(texts_[0].line(start)).is_there();
  for (std::size_t line = 0; begins_behind && line < start; ++line) {
    checkpoint_.pass();
    if (program_head_of(texts_[0].line(line)).is_there()) break;
    copied_.push_back(line);
  }
  head_came_out_ = start > 0 && !begins_behind;
  if (texts_[0].is_cut()) said_.forget();
  note_returns(main);
  start_ = start;
  for (std::size_t line = 0; !begins_behind && line < start; ++line) {
    checkpoint_.pass();
    if (!is_left_out(texts_[0].line(line))) note_line(texts_[0].line(line));
  }
  for (std::size_t number = 1; number < locals_.front().size(); ++number)
    if (const double* value = given(std::to_string(number))) locals_.front()[number] = *value;
  at_start_ = {.locals = locals_.front()};
}

std::int64_t FanucFlow::number_of_program(const ProgramHead& head) {
  if (!head.is_there() || head.number >= 0) return head.number;
  return number_of_named(std::string_view(head.name).substr(1, head.name.size() - 2));
}

std::int64_t FanucFlow::number_of_named(std::string_view name) {
  const auto [known, is_new] =
      numbers_of_names_.try_emplace(in_upper_case(name), first_named + std::ssize(names_));
  if (is_new) names_.push_back(known->first);
  return known->second;
}

// Divides a text at each O.
void FanucFlow::add_units(std::size_t text) {
  const ProgramText& lines = texts_[text];
  Unit unit{.text = text};
  const std::size_t known = units_.size();
  bool begun = false;  // a line other than a name has been seen
  for (std::size_t line = 0; line < lines.size(); ++line) {
    checkpoint_.pass();
    const ProgramHead head = program_head_of(lines.line(line));
    const std::int64_t number = number_of_program(head);
    if (number >= 0 && begun) {
      unit.end = line;
      units_.push_back(unit);
      unit = {.text = text, .begin = line};
    }
    if (number >= 0) {
      unit.number = number;
      unit.begin = is_over(lines.line(line), head.behind) ? line + 1 : line;
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
  if (next_copied_ < copied_.size()) return copy_next(flat);
  Frame& at = frame();
  const std::size_t begin = flat.size();
  const bool goes_on = at.next >= at.end ? end_of_unit(flat) : execute_line(flat);
  note_what_is_said(std::string_view(flat).substr(begin));
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

void FanucFlow::note_line(std::string_view line) {
  said_.take(line);
  note_registers(line);
  if (returns_to_.empty()) return;
  const auto found = returns_to_.find(head_of(line).number);
  if (found != returns_to_.end()) ++found->second;
}

// The program may read a tool register that it has written (D-169).
void FanucFlow::note_registers(std::string_view line) {
  const auto setting = register_set_by(line, modes_.incremental);
  if (setting && setting->value)
    common_[setting->variable] = setting->value;
  else if (setting)
    common_.erase(setting->variable);
  if (has_function(line, 'G', 20, 21) || has_function(line, 'G', 70, 71)) forget_registers();
}

// The registers now count in another unit, or the machine may have set them.
void FanucFlow::forget_registers() {
  constexpr std::int64_t first = 12'001;
  constexpr std::int64_t last = 13'999;
  common_.erase(common_.lower_bound(first), common_.upper_bound(last));
}

// The targets of M99 P in the main program.
void FanucFlow::note_returns(const Unit& main) {
  for (std::size_t line = main.begin; line < main.end; ++line) {
    checkpoint_.pass();
    const std::string_view text = texts_[0].line(line);
    if (!has_function(text, 'M', 99, 99)) continue;
    if (const auto number = number_behind(text, 'P')) returns_to_.try_emplace(*number, 0);
  }
}

void FanucFlow::note_what_is_said(std::string_view flat) {
  for (std::size_t begin = 0; begin < flat.size();) {
    checkpoint_.pass();
    const std::size_t end = std::min(flat.find_first_of("\r\n", begin), flat.size());
    note_line(flat.substr(begin, end - begin));
    begin = end + 1;
  }
  if (!calls_the_machine_ && !machine_follows_) return;
  said_.forget();
  forget_registers();
}

Flow::Step FanucFlow::copy_next(std::string& flat) {
  const std::size_t line = copied_[next_copied_++];
  frames_.erase(frames_.begin() + 1, frames_.end());
  frames_.front().current = line;
  is_as_written_ = true;
  flat.append(texts_[0].line(line)).append(line_end());
  if (!has_ended_ || next_copied_ < copied_.size()) return Step::goes_on;
  end_program(flat);
  return Step::ended;
}

bool FanucFlow::execute_line(std::string& flat) {
  begin_line();
  if (!count_line()) return false;
  if (is_left_out(line_)) return true;
  if (frames_.size() == 1 && returns_to_.contains(head_.number))
    at_line_[frame().current] = {.locals = locals_.front(), .common = common_};
  if (!may_begin_program(line_)) return execute(flat);
  const ProgramHead head = program_head_of(line_);
  return head.is_there() ? execute_behind_head(flat, head) : execute(flat);
}

// The O of a subprogram does not come out; the O of the main program comes out once.
bool FanucFlow::execute_behind_head(std::string& flat, const ProgramHead& head) {
  const bool is_over_there = is_over(line_, head.behind);
  const bool comes_out = frames_.size() == 1 && !std::exchange(head_came_out_, true);
  if (comes_out && (is_over_there || !fanuc_computes(line_))) return execute(flat);
  if (comes_out) flat.append(line_.substr(0, head.behind)).append(line_end());
  if (is_over_there) return true;
  behind_head_ = without_head(line_, head);
  line_ = behind_head_;
  head_ = head_of(line_);
  head_.to_skip = may_be_skipped(head_.to_skip);
  const std::size_t begin = flat.size();
  const bool goes_on = execute(flat);
  is_as_written_ = false;
  flat.erase(begin, std::min(flat.find_first_not_of(' ', begin), flat.size()) - begin);
  return goes_on;
}

bool FanucFlow::end_of_unit(std::string& flat) {
  if (looks_ahead()) return ended_ = true;
  Frame& at = frame();
  if (frames_.size() == 1 && at.end == texts_[at.text].size()) {
    write_lasting_values(flat);
    return end_main_program(flat);
  }
  if (frames_.size() == 1) {
    // The program runs into the next O.
    at.current = at.end;
    return refuse(Code::nc_unsupported, 0, "O, a second program in one text");
  }
  return refuse(Code::block_structure, 0, frame().name + ", a subprogram without M99");
}

// From the first N word on words may be meant for other values, and count as resolved; comments
// are text in any case.
std::size_t FanucFlow::end_of_text_behind(const Frame& main) const {
  bool numbered = false;
  for (std::size_t behind = main.current + 1; behind < main.end; ++behind) {
    checkpoint_.pass();
    const std::string_view line = texts_.front().line(behind);
    const LineHead head = head_of(line);
    numbered |= head.number >= 0;
    if (numbered && !is_percent(line) && !is_over(line, head.behind)) return behind;
  }
  return main.end;
}

// The other programs of the text must not be lost.
bool FanucFlow::end_main_program(std::string& flat) {
  if (looks_ahead()) return ended_ = true;
  const Frame& main = frames_.front();
  const std::size_t behind = end_of_text_behind(main);
  const std::size_t lost = first_with('G', 41, 42, main.current + 1, behind);
  if (lost < behind) return refuse_contour_behind_end(lost);
  keep_what_is_not_resolved();
  // The `%` before other programs comes out if one of them does.
  if (!is_percent(texts_.front().line(main.current)))
    written_behind_ = write_text_behind_end(
        flat, copied_.empty() ? without_end_of_tape(main.current + 1, behind) : behind);
  // The main program may be the last one, and its text without a line end.
  if (!copied_.empty() && flat.find_last_of("\r\n") + 1 != flat.size()) flat.append(line_end());
  has_ended_ = true;
  return next_copied_ < copied_.size() || end_program(flat);
}

// By program: true for the main program and each program that it calls, directly or not. Calls
// under a condition that did not hold count too.
std::vector<bool> FanucFlow::resolved(const std::vector<ProgramOfText>& programs) const {
  std::vector<bool> found(programs.size());
  ProgramCalls calls;
  for (std::size_t text = 1; text < texts_.size(); ++text)
    for (std::size_t line = 0; line < texts_[text].size(); ++line) {
      checkpoint_.pass();
      add_calls(texts_[text].line(line), calls);
    }
  const std::size_t line_of_main = frames_.front().end - 1;
  bool goes_on = true;
  while (std::exchange(goes_on, false)) {
    for (std::size_t index = 0; index < programs.size(); ++index) {
      const ProgramOfText& program = programs[index];
      const bool is_main = program.begin <= line_of_main && line_of_main < program.end;
      const bool is_called =
          calls.names.contains(program.head.name) || (calls.is_computed && !program.ends_all);
      if (found[index] || (!is_main && !is_called)) continue;
      found[index] = goes_on = true;
      calls.names.insert(program.calls.names.begin(), program.calls.names.end());
      calls.milled.insert(program.calls.milled.begin(), program.calls.milled.end());
      calls.is_computed |= program.calls.is_computed;
    }
  }
  for (std::size_t index = 0; index < programs.size(); ++index) {
    const ProgramOfText& program = programs[index];
    const bool is_main = program.begin <= line_of_main && line_of_main < program.end;
    if (!is_main && calls.milled.contains(program.head.name)) found[index] = false;
  }
  return found;
}

// Keeps the programs that are not resolved, with the programs that they call.
void FanucFlow::keep_what_is_not_resolved() {
  copied_.clear();
  next_copied_ = 0;
  const std::vector<ProgramOfText> programs = programs_of(texts_.front(), checkpoint_);
  std::vector<bool> leaves = resolved(programs);
  const std::size_t line_of_main = frames_.front().end - 1;
  bool goes_on = true;
  while (std::exchange(goes_on, false)) {
    ProgramCalls calls;
    for (std::size_t index = 0; index < programs.size(); ++index) {
      if (leaves[index]) continue;
      calls.names.insert(programs[index].calls.names.begin(), programs[index].calls.names.end());
      calls.names.insert(programs[index].calls.milled.begin(), programs[index].calls.milled.end());
    }
    for (std::size_t index = 0; index < programs.size(); ++index) {
      const ProgramOfText& program = programs[index];
      const bool is_main = program.begin <= line_of_main && line_of_main < program.end;
      if (!leaves[index] || is_main || !calls.names.contains(program.head.name)) continue;
      leaves[index] = false;
      goes_on = true;
    }
  }
  const Frame& main = frames_.front();
  // A `%` stays before a program of another tape.
  bool is_in_tape = without_end_of_tape(main.current + 1, main.end) == main.end;
  std::optional<std::size_t> percent;
  for (std::size_t index = 0; index < programs.size(); ++index)
    for (std::size_t line = programs[index].begin; line < programs[index].end; ++line) {
      checkpoint_.pass();
      if (is_percent(texts_.front().line(line))) {
        if (is_in_tape && line > line_of_main) percent = line;
      } else if (!leaves[index]) {
        if (percent) copied_.push_back(*std::exchange(percent, {}));
        copied_.push_back(line);
        is_in_tape = true;
      }
    }
}

bool FanucFlow::execute(std::string& flat) {
  if (is_percent(line_)) {
    if (frame().current > 0) return end_of_unit(flat);
    flat.append(line_).append(line_end());
    return true;
  }
  std::size_t at = head_.behind;
  // (B) #102=2: the comment comes out separately.
  std::size_t behind = at;
  while (behind < line_.size() && line_[behind] == '(' && behind_comment(line_, behind) > 0)
    behind = behind_blanks(line_, behind_comment(line_, behind));
  if (behind > at && behind < line_.size() && line_[behind] == '#') {
    flat.append(without_blanks_behind(line_.substr(at, behind - at))).append(line_end());
    at = behind;
  }
  // [#1 LT 3] M99 P10 of Haas
  if (at < line_.size() && line_[at] == '[')
    return refuse(Code::nc_unsupported, at, "[ ], a condition without IF");
  const bool assigns = at < line_.size() && line_[at] == '#';
  if (!assigns && !is_statement_at(line_, at)) return execute_words(flat);
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  return assigns ? assign(flat, at) : execute_statement(flat);
}

}  // namespace trc::program
