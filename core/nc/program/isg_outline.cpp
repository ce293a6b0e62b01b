#include <algorithm>
#include <array>

#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/text/characters.h"

// The branches and loops of an ISG program, and the statements that are misplaced in them.

namespace trc::program {

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
  std::deque<Open> open;
  bool in_comment = false;
  for (std::size_t line = frame.begin; line < frame.end; ++line) {
    checkpoint_.pass();
    if (bounds_isg_comment(text.line(line))) in_comment = begins_isg_comment(text.line(line));
    if (in_comment) continue;
    const IsgHead head = isg_head_of(text.line(line));
    if (head.is_target) outline.numbers[head.number].push_back(line);
    if (!head.label.empty()) outline.labels[head.label].push_back(line);
    const Structure structure = structure_of(text.line(line));
    if (!open.empty()) outline.around[line] = open.back().around;
    check_statement(outline, open, line, text.line(line));
    if (structure != Structure::none)
      add_structure(outline, open, structure, line);
    else
      check_choice(outline, open, line, text.line(line));
  }
  return outline;
}

void IsgFlow::add_structure(Outline& outline, std::deque<Open>& open, Structure structure,
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
    Around around = open.empty() ? Around() : open.back().around;
    if (structure != branch) around.left = line;
    if (structure != branch && structure != choice) around.repeated = line;
    open.push_back({.structure = structure, .head = line, .branches = {line}, .around = around});
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
    misplace(outline, open, line, {.line = line, .detail = " after $ELSE"});
  outline.next[innermost.branches.back()] = line;
  innermost.branches.push_back(line);
  if (structure != end_branch) return;
  for (const std::size_t each : innermost.branches) outline.feet[each] = line;
  open.pop_back();
}

// A barred statement bars all statements around it, because they decide which lines are executed.
// Whatever is around one that is barred already is barred too.
void IsgFlow::misplace(Outline& outline, const std::deque<Open>& open, std::size_t line,
                       const Misplaced& misplaced) {
  outline.misplaced.try_emplace(line, misplaced);
  for (auto each = open.rbegin(); each != open.rend(); ++each)
    if (!outline.misplaced.try_emplace(each->head, misplaced).second) return;
}

// No path leads to a line between $SWITCH and its first $CASE.
void IsgFlow::check_choice(Outline& outline, const std::deque<Open>& open, std::size_t line,
                           std::string_view text) {
  if (open.empty() || open.back().structure != Structure::choice ||
      outline.choices.contains(open.back().head) ||
      is_isg_line_over(text, isg_head_of(text).behind))
    return;
  misplace(outline, open, line,
           {.line = line, .detail = "a line between $SWITCH and its first $CASE", .whole = true});
}

// Nothing may follow the words that are complete by themselves: a jump past their line would lose
// the rest of it. These words may not be skipped either.
void IsgFlow::check_statement(Outline& outline, const std::deque<Open>& open, std::size_t line,
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

}  // namespace trc::program
