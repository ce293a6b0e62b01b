#include <algorithm>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/text/characters.h"

// Calls of ISG: subprograms of the text (LL) and of the setup (L), and calls that only the machine
// can execute.

namespace trc::program {

// LL: of the same text. L: a text of the setup.
const IsgFlow::Unit* IsgFlow::unit_called(const IsgCall& call) const {
  const std::size_t text = frames_.back().text;
  const auto found = std::ranges::find_if(units_, [&](const Unit& unit) {
    return call.is_local ? unit.text == text && unit.name == call.name
                         : unit.text > 0 && unit.name == plain_file_name(call.name) &&
                               unit.end == texts_[unit.text].size();
  });
  return found == units_.end() ? nullptr : &*found;
}

// Lines after the return of a subprogram are only executed if a jump or a branch leads there. Any
// other line belongs to the program, whose beginning is missing.
bool IsgFlow::check_behind_return() {
  if (frames_.size() == 1 || looks_ahead()) return true;
  const ProgramText& text = text_of(frame());
  for (std::size_t line = frame().next; line < frame().end; ++line) {
    checkpoint_.pass();
    const std::string_view content = text.line(line);
    const IsgHead head = isg_head_of(content);
    if (head.is_target || !head.label.empty() || bounds_isg_comment(content) ||
        ends_tape(text, line))
      return true;
    if (is_isg_line_over(content, head.behind)) continue;
    if (content[head.behind] == '$') return true;
    frame().current = line;
    return refuse(Code::block_structure, head.behind, "a line after the end of a subprogram");
  }
  return true;
}

bool IsgFlow::return_from(std::string& flat) {
  if (looks_ahead()) return true;
  if (frames_.size() == 1) return end_of_program(flat);
  locals_.pop_back();
  frames_.pop_back();
  return true;
}

// A call of the machine (D-47): the values that it may read are written before it.
bool IsgFlow::call_the_machine(std::string& flat, const IsgCall& call) {
  write_values(flat);
  pieces_.clear();
  has_computed_ = false;
  jump_.reset();
  std::size_t values = behind_blanks(line_, call.end);
  if (values < line_.size() && line_[values] == '[' && !scan_command(values)) return false;
  if (head_.to_skip && has_changed_words())
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (pieces_.empty()) {
    pass_line(flat);
  } else {
    pieces_.insert(pieces_.begin(), {.begin = head_.behind, .end = pieces_.front().begin});
    const std::size_t end = pieces_.back().end;
    if (end < line_.size()) pieces_.push_back({.begin = end, .end = line_.size()});
    write_words(flat);
  }
  lose_values(call.name);
  return true;
}

// Refuses a call that no subprogram can match.
bool IsgFlow::refuse_call(const IsgCall& call) {
  if (is_isg_variable_at(call.name, 0))
    return refuse(Code::nc_unsupported, call.begin,
                  call.name + ", the name of a call in a variable");
  if (call.is_local && call.name == "CYCLE")
    return refuse(Code::nc_unsupported, call.begin, "LL CYCLE, a cycle of the program");
  return refuse(Code::subprogram_unknown, call.begin, "%L " + call.name);
}

bool IsgFlow::call(std::string& flat, IsgCall call) {
  const Unit* unit = call.name == "CYCLE" ? nullptr : unit_called(call);
  if (call.is_local && call.is_joined) {  // LLNAME
    IsgCall other = call;
    other.is_local = false;
    other.name.insert(0, "L");
    const Unit* const global = unit_called(other);
    if (unit != nullptr && global != nullptr)
      return refuse(Code::nc_unsupported, head_.behind,
                    "L" + other.name + ", the call of either of two subprograms");
    if (unit == nullptr) call = other;
    if (unit == nullptr) unit = global;
  }
  if (head_.to_skip && (unit != nullptr || !unwritten_.empty()))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (unit == nullptr && (call.is_local || is_isg_variable_at(call.name, 0)))
    return refuse_call(call);
  if (unit == nullptr) return call_the_machine(flat, call);
  const auto is_alike = [&](const Unit& other) {
    return &other != unit && other.text == unit->text && other.name == unit->name;
  };
  if (call.is_local && std::ranges::any_of(units_, is_alike))
    return refuse(Code::jump_target_unknown, call.begin,
                  "%L " + call.name + ", which is there twice");
  if (!is_isg_line_over(line_, call.end))
    return refuse(Code::expression_invalid, call.end, "words after a call");
  std::string text = "(" + unit->name + ")";
  if (const std::size_t comment = behind_blanks(line_, call.end); comment < line_.size())
    text.append(" ").append(line_.substr(comment));
  write_behind_number(flat, text);
  if (!enter({.text = unit->text,
              .begin = unit->begin,
              .end = unit->end,
              .next = unit->begin,
              .current = unit->begin,
              .restart = unit->begin,
              .name = unit->name,
              .own_variables = true}))
    return false;
  if (!looks_ahead()) locals_.emplace_back();
  return true;
}

}  // namespace trc::program
