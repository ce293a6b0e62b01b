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

IsgFlow::IsgFlow(const ProgramSetup& setup, CallPlaces& calls, ProgramText text, std::size_t start)
    : Flow(setup, calls) {
  texts_.push_back(std::move(text));
  add_units(0);
  const Unit main = units_.back();
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_units(texts_.size() - 1);
    units_.back().name = plain_file_name(name);
  }
  frames_.push_back({.begin = main.begin,
                     .end = main.end,
                     .next = std::max(start, main.begin),
                     .current = std::max(start, main.begin),
                     .own_variables = true});
  writes_variables_ = calls_the_unknown();
}

bool IsgFlow::calls_the_unknown() const {
  for (const ProgramText& text : texts_)
    for (std::size_t line = 0; line < text.size(); ++line) {
      const std::string_view content = text.line(line);
      const IsgCall call = isg_call_at(content, isg_head_of(content).behind);
      if (call.is_call && !call.is_local && given_subprogram(setup_, call.name) == nullptr)
        return true;
    }
  return false;
}

// The subprograms of a text, then its program.
void IsgFlow::add_units(std::size_t text) {
  const ProgramText& lines = texts_[text];
  Unit unit{.text = text};
  bool is_main = false;
  for (std::size_t line = 0; line < lines.size() && !is_main; ++line) {
    const std::string name = isg_subprogram_of(lines.line(line));
    is_main = begins_isg_program(lines.line(line));
    if (name.empty() && !is_main) continue;
    unit.end = line;
    if (!unit.name.empty()) units_.push_back(unit);
    // What stands in front of the first one is the beginning of the program.
    unit = {.name = name, .text = text, .begin = is_main ? line : line + 1};
  }
  unit.end = lines.size();
  if (!unit.name.empty()) {  // no program behind its subprograms
    units_.push_back(unit);
    unit = {.text = text, .begin = unit.end};
  }
  unit.end = lines.size();
  units_.push_back(unit);
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
  using enum Structure;
  constexpr auto pairs =
      std::to_array<std::pair<Structure, Structure>>({{end_choice, choice},
                                                      {end_counting, counting},
                                                      {end_condition, condition},
                                                      {end_endless, endless},
                                                      {Structure::until, repetition}});
  const ProgramText& text = texts_[frame.text];
  struct Open {
    Structure structure = none;
    std::size_t head = 0;
    std::vector<std::size_t> branches{};
  };
  std::vector<Open> open;
  bool in_comment = false;
  for (std::size_t line = frame.begin; line < frame.end; ++line) {
    in_comment = comments_behind(text.line(line), in_comment);
    if (in_comment) continue;
    const IsgHead head = isg_head_of(text.line(line));
    if (head.is_target) outline.numbers[head.number].push_back(line);
    if (!head.label.empty()) outline.labels[head.label].push_back(line);
    const Structure structure = structure_of(text.line(line));
    const auto around = std::ranges::find_if(
        open.rbegin(), open.rend(), [](const Open& each) { return each.structure != branch; });
    if (around != open.rend()) outline.around[line] = around->head;
    if (structure == none) continue;
    outline.structures[line] = structure;
    const bool begins = structure == branch || structure == choice || structure == counting ||
                        structure == condition || structure == endless || structure == repetition;
    if (begins) {
      open.push_back({.structure = structure, .head = line, .branches = {line}});
      continue;
    }
    if (open.empty()) continue;
    Open& innermost = open.back();
    if (structure == chosen || structure == by_default) {
      if (innermost.structure == choice) outline.choices[innermost.head].push_back(line);
      continue;
    }
    if (structure == other_branch || structure == otherwise || structure == end_branch) {
      if (innermost.structure != branch) continue;
      outline.next[innermost.branches.back()] = line;
      innermost.branches.push_back(line);
      if (structure != end_branch) continue;
      for (const std::size_t each : innermost.branches) outline.feet[each] = line;
      open.pop_back();
      continue;
    }
    const auto pair = std::ranges::find(pairs, structure, &std::pair<Structure, Structure>::first);
    if (pair->second != innermost.structure) continue;
    outline.feet[innermost.head] = line;
    outline.heads[line] = innermost.head;
    open.pop_back();
  }
  return outline;
}

void IsgFlow::take_line() {
  Frame& at = frame();
  at.current = at.next++;
  const ProgramText& text = text_of(at);
  line_ = text.line(at.current);
  if (is_continued(line_)) {
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
  const bool goes_on = frame().next >= frame().end ? end_of_frame(flat) : execute_line(flat);
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

bool IsgFlow::execute_line(std::string& flat) {
  take_line();
  if (!count_line()) return false;
  const bool was_comment = in_comment_;
  in_comment_ = comments_behind(line_, in_comment_);
  if (was_comment || in_comment_ || is_isg_line_over(line_, head_.behind)) return pass_line(flat);
  if (is_left_out(line_)) return true;
  if (in_declaration_) return declare(flat);
  const bool is_header = line_[behind_blanks(line_, 0)] == '%';
  if (is_header) return pass_line(flat);
  if (line_[head_.behind] == '$') return follow(flat);
  const IsgCall called = isg_call_at(line_, head_.behind);
  return called.is_call ? call(flat, called) : execute_words(flat);
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
bool IsgFlow::end_of_frame(std::string& /*flat*/) {
  return frames_.size() == 1 ? end_of_program() : return_from();
}

bool IsgFlow::end_of_program() {
  ended_ = true;
  if (looks_ahead()) return true;
  const Frame& main = frames_.front();
  const ProgramText& text = texts_.front();
  const auto is_target = [&](std::size_t line) {
    const IsgHead head = isg_head_of(text.line(line));
    return head.is_target || !head.label.empty();
  };
  std::size_t behind = main.current + 1;
  while (behind < main.end && !is_target(behind)) ++behind;
  const std::size_t lost = first_with('G', 41, 42, main.current + 1, behind);
  return lost >= behind || refuse_contour_behind_end(lost);
}

bool IsgFlow::return_from() {
  if (looks_ahead()) return true;
  if (frames_.size() == 1) return end_of_program();
  locals_.pop_back();
  frames_.pop_back();
  return true;
}

bool IsgFlow::call(std::string& flat, const IsgCall& call) {
  const Unit* const unit = call.name == "CYCLE" ? nullptr : unit_called(call);
  if (head_.to_skip && unit != nullptr)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (unit == nullptr && call.is_local)
    return refuse(Code::subprogram_unknown, call.begin, "%L " + call.name);
  if (unit == nullptr) {
    // It is the machine's (D-47): what it may ask for stands in front of it.
    write_values(flat);
    pieces_.clear();
    has_computed_ = false;
    jump_.reset();
    std::size_t values = behind_blanks(line_, call.end);
    if (values < line_.size() && line_[values] == '[' && !scan_command(values)) return false;
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
