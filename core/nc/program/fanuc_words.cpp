#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/reasons.h"
#include "core/nc/program/fanuc_flow.h"
#include "core/nc/text/characters.h"

// Writes lines of words with computed values, and calls.

namespace trc::program {
namespace {

// The variable of the argument with this letter; 0: the letter cannot be an argument.
constexpr std::array<std::uint8_t, 26> variable_of_argument{
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

}  // namespace

std::string FanucFlow::name_of(std::int64_t number) const {
  if (number >= first_named)
    return "O<" + names_[static_cast<std::size_t>(number - first_named)] + ">";
  std::string digits = std::to_string(number);
  constexpr std::size_t usual_digits = 4;
  if (digits.size() < usual_digits) digits.insert(0, usual_digits - digits.size(), '0');
  return "O" + digits;
}

bool FanucFlow::execute_words(std::string& flat) {
  if (const auto called = call_by_name(flat)) return *called;
  if (const auto printed = print(flat)) return *printed;
  if (!scan_words()) return false;
  if (is_read_by_the_reader_) {
    write_as_it_is(flat);
    return true;
  }
  ComputedWord* call_word = nullptr;
  bool ends = false;
  bool ends_modal_call = false;
  for (ComputedWord& word : words_) {
    ends |= word.is('M', 30) || word.is('M', 2);
    ends_modal_call |= word.is('G', 67);
    if (word.is('G', 67) && modal_call_ && !modal_call_->is_of_machine) word.left_out = true;
    if (word.is('G', 65) || word.is('G', 66) || word.is('M', 98) || word.is('M', 97) ||
        word.is('M', 99))
      call_word = &word;
  }
  const bool under_modal_call = modal_call_ && frames_.size() == modal_call_->depth;
  const bool calls = under_modal_call && !ends_modal_call && call_word == nullptr && moves();
  if (head_.to_skip && (has_computed_ || call_word != nullptr || calls))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (ends_modal_call) modal_call_.reset();
  // The control decides whether each motion of one macro calls the other, and what the return ends.
  const ComputedWord* const called = word_of('P');
  const bool passes = modal_call_ && modal_call_->is_of_machine && called != nullptr &&
                      is_of_the_machine(static_cast<std::int64_t>(called->value.number));
  if (call_word != nullptr && under_modal_call && !passes)
    return refuse(Code::nc_unsupported, call_word->begin,
                  std::string(line_.substr(call_word->begin, call_word->end - call_word->begin))
                      .append(" under G66"));
  if (call_word != nullptr) return call(flat, *call_word);
  if (calls && modal_call_->is_of_machine) write_values(flat, Called::macro);
  if (ends) write_lasting_values(flat);
  write_line(flat);
  if (calls) return call_modally(flat);
  return !ends || end_main_program(flat);
}

// Whether the line moves an axis: not with the axis words of a dwell, of data or of coordinates.
bool FanucFlow::moves() const {
  constexpr std::array no_motion{4.0, 10.0, 22.0, 50.0, 50.1, 51.0, 51.1, 52.0, 68.0, 68.2, 92.0};
  constexpr std::string_view axes = "XYZABCUVW";
  bool names_axis = false;
  for (const ComputedWord& word : words_) {
    if (word.kind != ComputedWord::Kind::address) continue;
    names_axis |= axes.find(word.letter) != std::string_view::npos;
    const bool says_no_motion =
        std::ranges::any_of(no_motion, [&](double function) { return word.is('G', function); });
    if (says_no_motion) return false;
  }
  return names_axis;
}

bool FanucFlow::call(std::string& flat, ComputedWord& word) {
  if (word.letter == 'G') return call_macro(flat, word);
  if (word.value.number == 99) return return_from(flat, word);
  const auto call = take_call(word, flat);
  if (!call) return false;
  if (word.value.number == 97) return call_own_lines(flat, *call);
  if (is_of_the_machine(call->number)) {
    write_values(flat, Called::subprogram);
    if (called_alone_ && !has_computed_) {
      write_as_it_is(flat);
    } else {
      std::string text = "M98 P" + std::to_string(call->number);
      if (call->says_times) text += " L" + std::to_string(call->times);
      called_alone_ ? write_behind_number(flat, text)
                    : static_cast<void>(flat.append(text).append(line_end()));
    }
    return pass_call(call->number, Called::subprogram);
  }
  // Older controls write repetitions before the four digits of the program.
  constexpr std::int64_t of_four_digits = 10'000;
  const bool holds_times = !units_of_number_.contains(call->number) && !call->says_times &&
                           call->number >= of_four_digits &&
                           units_of_number_.contains(call->number % of_four_digits);
  const auto unit =
      unit_of(holds_times ? call->number % of_four_digits : call->number, call->begin);
  const auto times =
      holds_times ? static_cast<std::uint64_t>(call->number / of_four_digits) : call->times;
  return unit && enter_unit(flat, *unit, times, nullptr);
}

std::optional<bool> FanucFlow::call_by_name(std::string& flat) {
  constexpr std::string_view function = "M98";
  if (!has_word_at(line_, head_.behind, function)) return {};
  const std::size_t open = behind_blanks(line_, head_.behind + function.size());
  const std::size_t close = line_.find('>', open);
  if (open >= line_.size() || line_[open] != '<' || close == std::string_view::npos) return {};
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  std::size_t at = behind_blanks(line_, close + 1);
  double times = 1;
  if (at < line_.size() && upper(line_[at]) == 'L') {
    bool whole = false;
    const std::size_t begin = behind_blanks(line_, at + 1);
    at = begin + read_number(line_.substr(begin), times, whole);
  }
  if (!is_whole(times) || !is_over(line_, at))
    return refuse(Code::value_invalid, behind_blanks(line_, at),
                  std::string(line_.substr(behind_blanks(line_, at))).append(reason::beside_m98));
  words_.clear();
  for (std::size_t comment = behind_blanks(line_, at); comment < line_.size();
       comment = behind_blanks(line_, at)) {
    at = behind_comment(line_, comment);
    words_.push_back({.kind = ComputedWord::Kind::comment, .begin = comment, .end = at});
  }
  called_alone_ = true;
  const auto unit = unit_of(number_of_named(line_.substr(open + 1, close - open - 1)), open);
  return unit && enter_unit(flat, *unit, static_cast<std::uint64_t>(times), nullptr);
}

// DPRNT[X#1[53]]: the value with 5 places before the point and 3 after it, as the written program
// has no variables. Values that only the machine has are printed by the machine.
std::optional<bool> FanucFlow::print(std::string& flat) {
  const bool prints =
      has_word_at(line_, head_.behind, "DPRNT") || has_word_at(line_, head_.behind, "BPRNT");
  if (!prints || line_.find('#', head_.behind) == std::string_view::npos) return {};
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  std::string text;
  std::size_t at = 0;
  while (at < line_.size()) {
    if (line_[at] != '#') {
      text += line_[at++];
      continue;
    }
    ExpressionReader number = expression_at(at);
    const std::int64_t variable = number_of_variable(number);
    const bool is_of_program =
        variable < 100 || (common_.contains(variable) && !counter("#" + std::to_string(variable)));
    const bool is_of_machine = !number.failed() && !is_of_program;
    ExpressionReader expression = expression_at(at);
    const double value = is_of_machine ? 0 : read(expression).number;
    if (number.failed()) return refuse(number.fault());
    if (expression.failed()) return refuse(expression.fault());
    const std::size_t begin = std::exchange(at, number.at());
    const std::size_t close =
        at < line_.size() && line_[at] == '[' ? line_.find(']', at) : std::string_view::npos;
    const char decimals = close == std::string_view::npos ? ' ' : line_[close - 1];
    if (!is_digit(decimals))
      return refuse(Code::expression_invalid, begin, "DPRNT without the places of its value");
    at = close + 1;
    if (is_of_machine)
      text.append(line_.substr(begin, at - begin));
    else
      append_exactly(text, value, decimals - '0');
  }
  flat.append(text).append(line_end());
  return true;
}

// M97 calls lines of the calling program.
bool FanucFlow::call_own_lines(std::string& flat, const ProgramCall& call) {
  const auto line = line_of(frame(), call.number);
  const std::string name = "N" + std::to_string(call.number);
  if (!line) return refuse(Code::jump_target_unknown, call.begin, name);
  if (call.times == 0) return true;
  write_call(flat, name);
  return enter({.text = frame().text,
                .begin = frame().begin,
                .end = frame().end,
                .next = *line,
                .current = *line,
                .restart = *line,
                .repetitions_left = call.times - 1,
                .name = name});
}

bool FanucFlow::call_macro(std::string& flat, const ComputedWord& word) {
  const ComputedWord* const number = word_of('P');
  const ComputedWord* const times = word_of('L');
  const auto program = whole_value(number, word);
  const auto repetitions = times == nullptr ? 1 : whole_value(times, word);
  Locals locals{};
  if (!program || !repetitions) return false;
  const bool is_modal = word.is('G', 66);
  if (is_of_the_machine(*program)) {
    write_values(flat, Called::macro);
    write_line(flat);
    if (is_modal)
      modal_call_ = {.number = *program, .depth = frames_.size(), .is_of_machine = true};
    return pass_call(*program, Called::macro);
  }
  if (!take_arguments(word, locals)) return false;
  if (is_modal) {
    if (!unit_of(*program, number->begin)) return false;
    modal_call_ = {.number = *program,
                   .times = static_cast<std::uint64_t>(*repetitions),
                   .locals = locals,
                   .depth = frames_.size()};
    return true;
  }
  const auto unit = unit_of(*program, number->begin);
  called_alone_ = true;
  return unit && enter_unit(flat, *unit, static_cast<std::uint64_t>(*repetitions), &locals);
}

// G66 calls after each line that moves (for macros of the machine: D-68).
bool FanucFlow::call_modally(std::string& flat) {
  if (modal_call_->is_of_machine) {
    forget_what_the_machine_may_set(modal_call_->number);
    return machine_follows_ = true;
  }
  const auto unit = unit_of(modal_call_->number, 0);
  Locals locals = modal_call_->locals;
  called_alone_ = false;
  return unit && enter_unit(flat, *unit, modal_call_->times, &locals);
}

// I, J and K may come in up to ten groups, each in this order. If two words name one variable the
// later one counts.
bool FanucFlow::take_arguments(const ComputedWord& word, Locals& locals) {
  constexpr std::size_t first_of_groups = 4;
  std::size_t group = 0;
  int last = -1;  // of I, J, K
  for (const ComputedWord& argument : words_) {
    if (argument.kind != ComputedWord::Kind::address || argument.begin == word.begin ||
        argument.letter == 'P' || argument.letter == 'L')
      continue;
    std::size_t variable = variable_of_argument.at(static_cast<std::size_t>(argument.letter - 'A'));
    const int place = argument.letter - 'I';
    if (place >= 0 && place < 3) {
      if (place <= last) ++group;
      last = place;
      variable = first_of_groups + 3 * group + static_cast<std::size_t>(place);
    }
    if (variable == 0 || variable >= locals.size() || argument.begin < word.begin)
      return refuse(Code::value_invalid, argument.begin,
                    std::string(line_.substr(argument.begin, argument.end - argument.begin))
                        .append(word.is('G', 66) ? reason::beside_g66 : reason::beside_g65));
    const std::string_view text = line_.substr(argument.begin, argument.end - argument.begin);
    const bool counts_increments = setup_.whole_numbers == WholeNumbers::increments &&
                                   !argument.computed && argument.value.number != 0 &&
                                   text.find('.') == std::string_view::npos;
    if (counts_increments)
      return refuse(Code::value_invalid, argument.begin,
                    std::string(text).append(reason::argument_without_point));
    if (!argument.left_out) locals.at(variable) = argument.value.number;
  }
  return true;
}

bool FanucFlow::is_of_the_machine(std::int64_t number) const {
  constexpr std::int64_t first_of_machine = 8000;
  constexpr std::int64_t last_of_machine = 9999;
  if (units_of_number_.contains(number) || number >= first_named) return false;
  return (number >= first_of_machine && number <= last_of_machine) ||
         setup_.pass_words.contains("O" + std::to_string(number));
}

void FanucFlow::forget_what_the_machine_may_set(std::int64_t number) {
  lost_to_ = name_of(number);
  common_.clear();
  counters_.clear();
}

// The line passes; the variables of the program are unknown after it.
bool FanucFlow::pass_call(std::int64_t number, Called called) {
  calls_the_machine_ = true;
  forget_what_the_machine_may_set(number);
  if (called == Called::macro) return true;
  locals_.back().fill({});
  locals_.back().are_lost = true;
  return true;
}

std::optional<FanucFlow::Unit> FanucFlow::unit_of(std::int64_t number, std::size_t begin) {
  const auto known = units_of_number_.find(number);
  if (known == units_of_number_.end()) {
    refuse(Code::subprogram_unknown, begin, name_of(number));
    return {};
  }
  // A program in the text itself takes precedence over a given one.
  const std::vector<std::size_t>& all = known->second;
  const Unit& found = units_[all.front()];
  if (all.size() == 1 || (found.text == 0 && units_[all[1]].text > 0)) return found;
  refuse(Code::subprogram_unknown, begin, name_of(number) + ", which is there twice");
  return {};
}

bool FanucFlow::enter_unit(std::string& flat, const Unit& unit, std::uint64_t times,
                           Locals* locals) {
  if (times == 0) return true;
  Frame callee{.text = unit.text,
               .begin = unit.begin,
               .end = unit.end,
               .next = unit.begin,
               .current = unit.begin,
               .restart = unit.begin,
               .repetitions_left = times - 1,
               .name = name_of(unit.number),
               .own_variables = locals != nullptr};
  write_call(flat, callee.name);
  if (!enter(std::move(callee))) return false;
  if (looks_ahead()) return true;
  const auto index = std::ranges::find_if(
      units_, [&](const Unit& each) { return each.text == unit.text && each.begin == unit.begin; });
  entered_[static_cast<std::size_t>(index - units_.begin())] = true;
  if (locals != nullptr) locals_.push_back(*locals);
  return true;
}

// A return to an earlier line makes this a production line: it makes the part again and again. For
// the path this is the end of the program.
bool FanucFlow::return_within_main(std::string& flat, std::int64_t number, std::size_t begin) {
  const auto target = line_of(frame(), number);
  const std::size_t current = frame().current;
  if (!target || *target > current || !never_leaves(*target, current)) {
    write_line(flat);
    return go_to(number, begin);
  }
  if (!repeats_from(*target, number))
    return refuse(Code::nc_unsupported, begin,
                  "M99 P" + std::to_string(number) + ", an endless loop whose rounds differ");
  write_lasting_values(flat);
  write_as_it_is(flat);
  return end_main_program(flat);
}

// Whether nothing in these lines of the main program leads out of them.
bool FanucFlow::never_leaves(std::size_t first, std::size_t last) const {
  const ProgramText& text = texts_.front();
  for (std::size_t line = first; line <= last; ++line) {
    checkpoint_.pass();
    const std::string_view content = text.line(line);
    const std::size_t begin = head_of(content).behind;
    const bool jumps =
        has_word_at(content, begin, "IF") || length_of_word_at(content, begin, "GOTO") > 0;
    const bool ends = has_function(content, 'M', 2, 30);
    const bool returns = line < last && has_function(content, 'M', 99, 99);
    if (jumps || ends || returns) return false;
  }
  // A subprogram may return to another line than the one after its call.
  for (const ProgramText& each : texts_)
    for (std::size_t line = 0; line < each.size(); ++line) {
      checkpoint_.pass();
      const bool is_it = &each == &text && line == last;
      if (!is_it && has_function(each.line(line), 'M', 99, 99) &&
          says_plainly(each.line(line), 'P'))
        return false;
    }
  return true;
}

// Whether each round equals the written one: it starts from the only line with that N and has the
// same values.
bool FanucFlow::repeats_from(std::size_t line, std::int64_t number) const {
  const auto known = at_line_.find(line);
  if (known == at_line_.end() && line >= start_) return false;
  const Variables& then = known == at_line_.end() ? at_start_ : known->second;
  const auto came_out = returns_to_.find(number);
  using Values = std::array<std::optional<double>, 34>;
  const Values& before = then.locals;
  const Values& now = locals_.front();
  // The written line contains the counters of the control.
  const auto settled = [this](std::map<std::int64_t, std::optional<double>> values) {
    std::erase_if(values, [this](const auto& each) {
      return counter("#" + std::to_string(each.first)) != nullptr;
    });
    return values;
  };
  return came_out != returns_to_.end() && came_out->second == 1 && !setup_.renumbers &&
         before == now && settled(then.common) == settled(common_);
}

bool FanucFlow::return_from(std::string& flat, ComputedWord& word) {
  ComputedWord* const target = word_of('P');
  const bool is_main = frames_.size() == 1;
  if (is_main && target == nullptr) {  // this ends the program for the reader as well
    write_lasting_values(flat);
    write_line(flat);
    return end_main_program(flat);
  }
  std::optional<std::int64_t> number;
  if (target != nullptr) {
    number = whole_value(target, word);
    if (!number) return false;
    target->left_out = true;
  }
  word.left_out = true;
  const std::size_t place = target == nullptr ? word.begin : target->begin;
  if (is_main && !looks_ahead()) return return_within_main(flat, *number, place);
  write_line(flat);
  if (looks_ahead()) return true;
  if (number) {
    const bool here = line_of(frame(), *number).has_value();
    const bool there = line_of(*(frames_.end() - 2), *number).has_value();
    const bool is_one_program =
        frame().text == (frames_.end() - 2)->text && frame().end == (frames_.end() - 2)->end;
    if (here && there && !is_one_program)
      return refuse(Code::jump_target_unknown, place,
                    "N" + std::to_string(*number) + ", which the subprogram and its caller have");
    if (here && !there) return go_to(*number, place);
  } else if (frame().repetitions_left > 0) {
    --frame().repetitions_left;
    frame().next = frame().restart;
    // The output marks each repetition.
    called_alone_ = false;
    write_call(flat, frame().name);
    return true;
  }
  if (frame().own_variables) locals_.pop_back();
  frames_.pop_back();
  return !number || go_to(*number, place);
}

}  // namespace trc::program
