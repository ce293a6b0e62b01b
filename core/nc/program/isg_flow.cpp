#include "core/nc/program/isg_flow.h"

#include <algorithm>
#include <array>

#include "core/nc/program/code_line.h"
#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

// Whether a comment block holds behind the line that held in front of it or not.
bool comments_behind(std::string_view line, bool holds) {
  if (!bounds_isg_comment(line)) return holds;
  const std::size_t word = line.find('#');
  const std::string text = in_upper_case(line.substr(word));
  return text.find("BEGIN") != std::string::npos;
}

}  // namespace

IsgFlow::IsgFlow(const ProgramSetup& setup, CallPlaces& calls, ProgramText text, bool has_begun)
    : Flow(setup, calls) {
  texts_.push_back(std::move(text));
  add_units(0, has_begun);
  const Unit main = units_.back();
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_units(texts_.size() - 1, false);
    units_.back().name = plain_file_name(name);
  }
  frames_.push_back({.begin = main.begin,
                     .end = main.end,
                     .next = main.begin,
                     .current = main.begin,
                     .own_variables = true});
  writes_variables_ = calls_the_unknown();
}

bool IsgFlow::calls_the_unknown() const {
  for (const ProgramText& text : texts_)
    for (std::size_t line = 0; line < text.size(); ++line) {
      const std::string_view content = text.line(line);
      const std::size_t begin = isg_head_of(content).behind;
      const IsgCall call = isg_call_at(content, begin);
      if (isg_call_behind_words(content, begin) != std::string_view::npos ||
          (call.is_call && (!call.is_local || call.is_joined) &&
           given_subprogram(setup_, call.name) == nullptr))
        return true;
    }
  return false;
}

// The subprograms of a text, then its program. It begins behind them with a % of its own, without
// subprograms with any block. `has_begun`: it did in front of the text.
void IsgFlow::add_units(std::size_t text, bool has_begun) {
  const ProgramText& lines = texts_[text];
  Unit unit{.text = text};
  bool in_comment = false;
  for (std::size_t line = 0; line < lines.size() && !has_begun; ++line) {
    const std::string_view content = lines.line(line);
    in_comment = comments_behind(content, in_comment);
    const std::string name = isg_subprogram_of(content);
    if (begins_isg_program(content) || !name.empty()) {
      unit.end = line;
      if (!unit.name.empty()) units_.push_back(unit);
      has_begun = name.empty();
      unit = {.name = name, .text = text, .begin = has_begun ? line : line + 1};
    } else if (unit.name.empty() && !in_comment && !bounds_isg_comment(content)) {
      has_begun = !is_isg_line_over(content, behind_blanks(content, 0));
    }
  }
  unit.end = lines.size();
  if (!unit.name.empty()) {  // no program behind its subprograms
    units_.push_back(unit);
    unit = {.text = text, .begin = unit.end};
  }
  unit.end = lines.size();
  units_.push_back(unit);
}

// A lone % with nothing behind it.
bool IsgFlow::ends_tape(const ProgramText& text, std::size_t line) {
  const std::string_view sign = text.line(line);
  std::size_t at = behind_blanks(sign, 0);
  if (at >= sign.size() || sign[at] != '%') return false;
  for (++at; line < text.size() && is_isg_line_over(text.line(line), at); at = 0) ++line;
  return line == text.size();
}

// Of a line with % that is not the first one of what is executed.
std::string IsgFlow::name_of_second(std::string_view line) {
  return isg_subprogram_of(line).empty() ? "%, a second program"
                                         : "%L, a subprogram behind the program";
}

void IsgFlow::know(std::string_view lines) {
  const ProgramText text({}, std::string(lines));
  for (std::size_t line = 0; line < text.size(); ++line) take_line_in_front(text.line(line));
}

void IsgFlow::take_line_in_front(std::string_view line) {
  line_ = line;
  head_ = isg_head_of(line_);
  in_comment_ = comments_behind(line_, in_comment_);
  if (in_comment_ || !is_isg_variable_at(line_, head_.behind)) return;
  ExpressionReader expression = expression_at(head_.behind);
  const std::string name = place_at(expression);
  expression.pass_blanks();
  if (expression.failed() || expression.peek() != '=' || name.starts_with("V.G.")) return;
  expression.go_to(expression.at() + 1);
  const Value value = expression.expression();
  if (!expression.failed()) values_of(name)[name] = value;
}

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

IsgFlow::Structure IsgFlow::structure_of(std::string_view line) {
  using enum Structure;
  constexpr auto words = std::to_array<std::pair<std::string_view, Structure>>({
      {"IF", branch},
      {"ELSEIF", other_branch},
      {"ELSE", otherwise},
      {"ENDIF", end_branch},
      {"SWITCH", choice},
      {"CASE", chosen},
      {"DEFAULT", by_default},
      {"ENDSWITCH", end_choice},
      {"FOR", counting},
      {"ENDFOR", end_counting},
      {"WHILE", condition},
      {"ENDWHILE", end_condition},
      {"DO", endless},
      {"ENDDO", end_endless},
      {"REPEAT", repetition},
      {"UNTIL", Structure::until},
  });
  const std::size_t at = isg_head_of(line).behind;
  if (at >= line.size() || line[at] != '$') return none;
  const std::string word = word_behind_sign(line, at);
  const auto found = std::ranges::find(words, word, &std::pair<std::string_view, Structure>::first);
  if (found == words.end()) return none;
  const bool jumps = in_upper_case(line.substr(at)).find("$GOTO") != std::string::npos;
  return found->second == branch && jumps ? none : found->second;
}

const IsgFlow::Outline& IsgFlow::outline_of(const Frame& frame) {
  const auto [known, is_new] = outlines_.try_emplace({frame.text, frame.begin});
  Outline& outline = known->second;
  if (!is_new) return outline;
  const ProgramText& text = texts_[frame.text];
  std::vector<Open> open;
  bool in_comment = false;
  for (std::size_t line = frame.begin; line < frame.end; ++line) {
    in_comment = comments_behind(text.line(line), in_comment);
    if (in_comment) continue;
    const IsgHead head = isg_head_of(text.line(line));
    if (head.is_target) outline.numbers[head.number].push_back(line);
    if (!head.label.empty()) outline.labels[head.label].push_back(line);
    const Structure structure = structure_of(text.line(line));
    const auto around = std::ranges::find_if(open.rbegin(), open.rend(), [](const Open& each) {
      return each.structure != Structure::branch;
    });
    if (around != open.rend()) outline.around[line] = around->head;
    check_statement(outline, open, line, text.line(line));
    if (structure != Structure::none)
      add_structure(outline, open, structure, line);
    else
      check_choice(outline, open, line, text.line(line));
  }
  return outline;
}

void IsgFlow::add_structure(Outline& outline, std::vector<Open>& open, Structure structure,
                            std::size_t line) {
  using enum Structure;
  constexpr auto pairs =
      std::to_array<std::pair<Structure, Structure>>({{end_choice, choice},
                                                      {end_counting, counting},
                                                      {end_condition, condition},
                                                      {end_endless, endless},
                                                      {Structure::until, repetition}});
  outline.structures[line] = structure;
  const bool begins = structure == branch || structure == choice || structure == counting ||
                      structure == condition || structure == endless || structure == repetition;
  if (begins) {
    open.push_back({.structure = structure, .head = line, .branches = {line}});
    return;
  }
  const bool is_of_choice = structure == chosen || structure == by_default;
  const bool is_of_branch =
      structure == other_branch || structure == otherwise || structure == end_branch;
  const auto pair = std::ranges::find(pairs, structure, &std::pair<Structure, Structure>::first);
  const Structure wanted = is_of_choice ? choice : is_of_branch ? branch : pair->second;
  if (open.empty() || open.back().structure != wanted) {
    misplace(outline, open, line,
             {.line = line,
              .detail = std::string(is_of_choice   ? " without $SWITCH"
                                    : is_of_branch ? " without $IF"
                                                   : " without its beginning")});
    return;
  }
  Open& innermost = open.back();
  if (is_of_choice) {
    outline.choices[innermost.head].push_back(line);
    return;
  }
  if (!is_of_branch) {
    outline.feet[innermost.head] = line;
    outline.heads[line] = innermost.head;
    open.pop_back();
    return;
  }
  if (structure != end_branch && outline.structures.at(innermost.branches.back()) == otherwise)
    misplace(outline, open, line, {.line = line, .detail = " behind $ELSE"});
  outline.next[innermost.branches.back()] = line;
  innermost.branches.push_back(line);
  if (structure != end_branch) return;
  for (const std::size_t each : innermost.branches) outline.feet[each] = line;
  open.pop_back();
}

// What bars a statement bars all that stands around it: which lines are executed hangs on it.
void IsgFlow::misplace(Outline& outline, const std::vector<Open>& open, std::size_t line,
                       const Misplaced& misplaced) {
  outline.misplaced.try_emplace(line, misplaced);
  for (const Open& each : open) outline.misplaced.try_emplace(each.head, misplaced);
}

// Between $SWITCH and its first $CASE nothing leads to a line.
void IsgFlow::check_choice(Outline& outline, const std::vector<Open>& open, std::size_t line,
                           std::string_view text) {
  if (open.empty() || open.back().structure != Structure::choice ||
      outline.choices.contains(open.back().head) ||
      is_isg_line_over(text, isg_head_of(text).behind))
    return;
  misplace(outline, open, line,
           {.line = line, .detail = "a line between $SWITCH and its first $CASE", .whole = true});
}

// Behind the words that say all by themselves nothing may stand: where a jump leads behind their
// line, it would be lost. Nor may they be skipped.
void IsgFlow::check_statement(Outline& outline, const std::vector<Open>& open, std::size_t line,
                              std::string_view text) const {
  constexpr auto complete = std::to_array<std::string_view>(
      {"ELSE", "ENDIF", "DEFAULT", "ENDSWITCH", "ENDFOR", "ENDWHILE", "DO", "REPEAT"});
  const IsgHead head = isg_head_of(text);
  if (head.behind >= text.size() || text[head.behind] != '$') return;
  const std::string word = word_behind_sign(text, head.behind);
  if (may_be_skipped(head.to_skip))
    misplace(outline, open, line,
             {.line = line,
              .code = Code::block_skip_undecided,
              .detail = "/, a line to skip that computes",
              .whole = true});
  const std::size_t behind = head.behind + 1 + word.size();
  if (std::ranges::find(complete, word) == complete.end() || is_isg_line_over(text, behind)) return;
  const std::size_t at = behind_blanks(text, behind);
  misplace(outline, open, line,
           {.line = line,
            .code = Code::expression_invalid,
            .begin = at,
            .detail = name_of_character(text.substr(at)),
            .whole = true});
}

void IsgFlow::take_line() {
  Frame& at = frame();
  at.current = at.next++;
  const ProgramText& text = text_of(at);
  line_ = text.line(at.current);
  is_joined_ = is_continued(line_);
  if (is_joined_) {
    joined_ = line_;
    while (is_continued(joined_) && at.next < at.end) {
      joined_.resize(without_blanks_behind(joined_).size() - 1);
      joined_.append(" ").append(text.line(at.next++));
    }
    line_ = joined_;
  }
  head_ = isg_head_of(line_);
  head_.to_skip = may_be_skipped(head_.to_skip);
  is_as_written_ = false;
}

Flow::Step IsgFlow::execute_next(std::string& flat) {
  const bool goes_on = frame().next >= frame().end ? end_of_frame() : execute_line(flat);
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

bool IsgFlow::execute_line(std::string& flat) {
  take_line();
  if (!count_line()) return false;
  const bool was_comment = in_comment_;
  in_comment_ = comments_behind(line_, in_comment_);
  if (was_comment || in_comment_) return pass_line(flat);
  if (is_left_out(line_)) return true;
  if (head_.to_skip && (head_.is_target || !head_.label.empty()))
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (is_isg_line_over(line_, head_.behind)) return pass_line(flat);
  if (in_declaration_) return declare(flat);
  if (line_[behind_blanks(line_, 0)] == '%') return pass_header(flat);
  if (line_[head_.behind] == '$') {
    // Where a statement goes on to is counted in lines as they are written.
    return !is_joined_
               ? follow(flat)
               : refuse(Code::nc_unsupported, head_.behind, "$, a statement on several lines");
  }
  const IsgCall called = isg_call_at(line_, head_.behind);
  return called.is_call ? call(flat, called) : execute_words(flat);
}

bool IsgFlow::pass_header(std::string& flat) {
  const Frame& at = frame();
  if (at.current == at.begin) return at.text > 0 || pass_line(flat);
  if (ends_tape(text_of(at), at.current)) return end_of_frame();
  return refuse(Code::nc_unsupported, behind_blanks(line_, 0), name_of_second(line_));
}

bool IsgFlow::pass_line(std::string& flat) {
  const bool is_target = head_.is_target || !head_.label.empty();
  if (is_target && !in_comment_) {
    if (head_.behind < line_.size() || head_.is_target)
      write_behind_number(flat, line_.substr(head_.behind));
    return true;
  }
  is_as_written_ = joined_.empty() || line_.data() != joined_.data();
  flat.append(line_).append(line_end());
  return true;
}

// The end of a subprogram needs no word.
bool IsgFlow::end_of_frame() { return frames_.size() == 1 ? end_of_program() : return_from(); }

bool IsgFlow::end_of_program() {
  ended_ = true;
  if (looks_ahead()) return true;
  const Frame& main = frames_.front();
  const ProgramText& text = texts_.front();
  if (main.begin == main.end && units_.front().text == 0 && !units_.front().name.empty())
    return refuse_behind_end(text.size() - 1, Code::block_structure,
                             "%, the beginning of the program behind its subprograms");
  for (std::size_t line = main.current + 1; line < main.end; ++line) {
    const std::string_view content = text.line(line);
    const bool is_header = !isg_subprogram_of(content).empty() || begins_isg_program(content);
    if (is_header && !ends_tape(text, line))
      return refuse_behind_end(line, Code::nc_unsupported, name_of_second(content));
  }
  const auto is_target = [&](std::size_t line) {
    const IsgHead head = isg_head_of(text.line(line));
    return head.is_target || !head.label.empty();
  };
  // $IF … M30 $ENDIF: other values lead to what stands behind it.
  std::ptrdiff_t branches = 0;
  for (const auto& [line, structure] : outline_of(main).structures) {
    if (line > main.current) break;
    branches += structure == Structure::branch ? 1 : 0;
    branches -= structure == Structure::end_branch ? 1 : 0;
  }
  if (branches > 0) return true;
  std::size_t behind = main.current + 1;
  while (behind < main.end && !is_target(behind)) ++behind;
  const std::size_t lost = first_with('G', 41, 42, main.current + 1, behind);
  return lost >= behind || refuse_contour_behind_end(lost);
}

// Nothing leads to that line of the program.
bool IsgFlow::refuse_behind_end(std::size_t line, Code code, std::string detail) {
  ended_ = false;
  frames_.erase(frames_.begin() + 1, frames_.end());
  locals_.resize(1);
  frames_.front().current = line;
  return refuse(code, 0, std::move(detail));
}

// Behind the return of a subprogram nothing is executed, unless a jump or a branch leads there: a
// line that stands there was meant for the program, whose beginning is missing.
bool IsgFlow::check_behind_return() {
  if (frames_.size() == 1 || looks_ahead()) return true;
  const ProgramText& text = text_of(frame());
  for (std::size_t line = frame().next; line < frame().end; ++line) {
    const std::string_view content = text.line(line);
    const IsgHead head = isg_head_of(content);
    if (head.is_target || !head.label.empty() || bounds_isg_comment(content) ||
        ends_tape(text, line))
      return true;
    if (is_isg_line_over(content, head.behind)) continue;
    if (content[head.behind] == '$') return true;
    frame().current = line;
    return refuse(Code::block_structure, head.behind, "a line behind the end of a subprogram");
  }
  return true;
}

bool IsgFlow::return_from() {
  if (looks_ahead()) return true;
  if (frames_.size() == 1) return end_of_program();
  locals_.pop_back();
  frames_.pop_back();
  return true;
}

// It is the machine's (D-47): what it may ask for stands in front of it.
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

// What no subprogram can be the target of.
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
    return refuse(Code::expression_invalid, call.end, "words behind a call");
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

void IsgFlow::write_behind_number(std::string& flat, std::string_view text) {
  if (head_.number >= 0) {
    flat.append(line_.substr(head_.number_begin, head_.number_end - head_.number_begin));
    if (!text.empty()) flat.append(" ");
  }
  flat.append(text).append(line_end());
}

}  // namespace trc::program
