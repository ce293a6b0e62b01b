#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/nc/program/linuxcnc_flow.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/number_format.h"

// Lines of words and calls of LinuxCNC.

namespace trc::program {

bool LinuxcncFlow::execute_words(std::string& flat) {
  assignments_.clear();
  if (!scan_words()) return false;
  if (is_read_by_the_reader_) {
    write_as_it_is(flat);
    return true;
  }
  ComputedWord* call_word = nullptr;
  bool ends = false;
  for (ComputedWord& word : words_) {
    ends |= word.is('M', 30) || word.is('M', 2);
    if (word.is('M', 98) || word.is('M', 99)) call_word = &word;
  }
  if (head_.to_skip && (has_computed_ || call_word != nullptr))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  // The line prints after its assignments.
  bool assigned = true;
  for (const Assignment& assignment : assignments_) assigned = assigned && assign(assignment);
  write_kept_assignments();
  if (call_word == nullptr) write_line(flat);
  if (!assigned) return false;
  if (call_word != nullptr)
    return call_word->value.number == 98 ? call_program(*call_word, flat)
                                         : return_from_program(*call_word, flat);
  return !ends || end_main_program(flat);
}

bool LinuxcncFlow::call_sub(const std::string& label, std::size_t at, std::string& flat) {
  Locals locals;
  locals.numbered.fill(0);  // values that the call does not give
  ExpressionReader expression = expression_at(at);
  expression.pass_blanks();
  std::size_t arguments = 0;
  for (; expression.peek() == '['; ++arguments) {
    if (arguments + 1 >= locals.numbered.size())
      return refuse(Code::value_invalid, expression.at(), "more than 30 arguments");
    locals.numbered.at(arguments + 1) = expression.operand().number;
    expression.pass_blanks();
  }
  if (expression.failed()) return refuse(expression.fault());
  for (std::size_t text = 0; text < texts_.size(); ++text) {
    const std::span<const std::size_t> heads = lines_of(text, 0, label, Statement::sub);
    if (heads.empty()) continue;
    if (heads.size() > 1)
      return refuse(Code::subprogram_unknown, head_.behind,
                    "o" + label + " sub, which is there twice");
    const std::span<const std::size_t> feet = lines_of(text, 0, label, Statement::endsub);
    const auto foot = std::ranges::upper_bound(feet, heads.front());
    if (foot == feet.end())
      return refuse(Code::block_structure, head_.behind, "o" + label + " sub without endsub");
    return enter_sub({.text = text,
                      .begin = heads.front() + 1,
                      .end = *foot + 1,
                      .next = heads.front() + 1,
                      .current = heads.front(),
                      .name = "o" + label,
                      .own_variables = true},
                     expression.at(), std::move(locals), flat);
  }
  if (label.front() != '<' ||
      !setup_.pass_words.contains(in_upper_case(label.substr(1, label.size() - 2))))
    return refuse(Code::subprogram_unknown, head_.behind, "o" + label);
  call_sub_of_machine(label, {.begin = at, .end = expression.at()},
                      std::span(locals.numbered).subspan(1, arguments), flat);
  return true;
}

// `at`: after the arguments.
bool LinuxcncFlow::enter_sub(Frame sub, std::size_t at, Locals locals, std::string& flat) {
  const std::string comments = with_values(comments_of(line_, at));
  write_behind_number(flat, "(" + sub.name + ")" + (comments.empty() ? "" : " " + comments));
  if (!is_over(line_, at))
    return refuse(Code::expression_invalid, at, name_of_character(line_.substr(at)));
  globals_.erase("_value");
  globals_["_value_returned"] = 0;
  if (!enter(std::move(sub))) return false;
  if (!looks_ahead()) locals_.push_back(std::move(locals));
  return true;
}

// The call passes with its values, and may set global parameters (D-77).
void LinuxcncFlow::call_sub_of_machine(const std::string& label, const Arguments& arguments,
                                       std::span<const std::optional<double>> values,
                                       std::string& flat) {
  write_values();
  calls_the_machine_ = true;
  lost_to_ = "o" + label;
  common_.clear();
  globals_.clear();
  counters_.clear();
  const std::string_view written = line_.substr(arguments.begin, arguments.end - arguments.begin);
  if (written.find('#') == std::string_view::npos) return write_as_it_is(flat);
  std::string text(line_.substr(head_.behind, arguments.begin - head_.behind));
  for (const std::optional<double>& value : values) {
    text += " [";
    append_value(text, *value, PointStyle::as_whole);
    text += ']';
  }
  const std::string comments = with_values(comments_of(line_, arguments.end));
  write_behind_number(flat, comments.empty() ? text : text + " " + comments);
}

bool LinuxcncFlow::return_from_sub(std::size_t at, std::string& flat) {
  if (!frame().own_variables)
    return refuse(Code::block_structure, head_.behind, "return or endsub outside of a sub");
  ExpressionReader expression = expression_at(at);
  expression.pass_blanks();
  if (expression.peek() == '[') {
    const double value = expression.operand().number;
    if (expression.failed()) return refuse(expression.fault());
    globals_["_value"] = value;
    globals_["_value_returned"] = 1;
  }
  if (!finish_statement(flat, expression.at())) return false;
  if (looks_ahead()) return true;
  locals_.pop_back();
  frames_.pop_back();
  return true;
}

// M98: from the line of its number to M99, with the parameters of the caller.
bool LinuxcncFlow::call_program(ComputedWord& word, std::string& flat) {
  const auto call = take_call(word, flat);
  if (!call) return false;
  const std::string label = std::to_string(call->number);
  for (std::size_t text = 0; text < texts_.size(); ++text) {
    const std::span<const std::size_t> begins = lines_of(text, 0, label, Statement::none);
    if (begins.empty()) continue;
    const std::size_t begin = begins.front();
    if (call->times == 0) return true;
    write_call(flat, "o" + label);
    return enter({.text = text,
                  .end = texts_[text].size(),
                  .next = begin + 1,
                  .current = begin,
                  .restart = begin + 1,
                  .repetitions_left = call->times - 1,
                  .name = "o" + label});
  }
  return refuse(Code::subprogram_unknown, call->begin, "o" + label);
}

bool LinuxcncFlow::return_from_program(ComputedWord& word, std::string& flat) {
  if (frames_.size() == 1) {  // this ends the program for the reader as well
    write_line(flat);
    return end_main_program(flat);
  }
  if (frame().own_variables) return refuse(Code::block_structure, word.begin, "M99 within a sub");
  word.left_out = true;
  write_line(flat);
  if (looks_ahead()) return true;
  if (frame().repetitions_left > 0) {
    --frame().repetitions_left;
    frame().next = frame().restart;
    called_alone_ = false;
    write_call(flat, frame().name);
    return true;
  }
  frames_.pop_back();
  return true;
}

}  // namespace trc::program
