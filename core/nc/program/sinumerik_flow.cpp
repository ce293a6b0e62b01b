#include "core/nc/program/sinumerik_flow.h"

#include <algorithm>
#include <array>

#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

bool begins_header(std::string_view line) {
  const std::size_t at = behind_blanks(line, 0);
  return at < line.size() && line[at] == '%';
}

// The program name in a file name: KONTUR in KONTUR.SPF and in _N_KONTUR_SPF.
std::string name_of_file(std::string_view name) {
  const std::size_t folder = name.find_last_of("/\\");
  if (folder != std::string_view::npos) name.remove_prefix(folder + 1);
  std::string plain = in_upper_case(name.substr(0, name.find('.')));
  if (std::string named = program_of_header("%" + plain); !named.empty()) return named;
  return plain;
}

// Statements that the control executes beside the program, or before it runs.
constexpr auto beside_the_program = std::to_array<std::string_view>(
    {"DEFINE", "DO", "EVERY", "FROM", "ID", "IDS", "REDEF", "WHEN", "WHENEVER"});

}  // namespace

SinumerikFlow::SinumerikFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text,
                             std::size_t start)
    : Flow(setup, lent) {
  texts_.push_back(std::move(text));
  add_units(0);
  const Unit main =
      *std::ranges::find_if(units_, [&](const Unit& unit) { return start < unit.end; });
  for (const auto& [name, given_text] : setup.subprograms) {
    texts_.emplace_back(name, given_text);
    add_units(texts_.size() - 1);
  }
  find_what_calls_are_given(main);
  start_ = start;
  for (std::size_t line = main.begin; line < start; ++line) {
    checkpoint_.pass();
    note_named_by_cycles(texts_.front().line(line));
  }
  frames_.push_back({.begin = main.begin,
                     .end = main.end,
                     .next = start,
                     .current = start,
                     .own_variables = true});
}

// Divides a text at each header, and at each PROC that follows other lines.
void SinumerikFlow::add_units(std::size_t text) {
  const ProgramText& lines = texts_[text];
  const std::size_t known = units_.size();
  Unit unit{.text = text};
  bool begun = false;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    checkpoint_.pass();
    const std::string_view content = lines.line(line);
    const std::size_t at = named_head_of(content).behind;
    const std::string header = program_of_header(content);
    const bool is_head = name_at(content, at) == "PROC";
    if (begun && (is_head || !header.empty())) {
      unit.end = line;
      units_.push_back(unit);
      unit = {.text = text, .begin = line};
      begun = false;
    }
    if (!header.empty()) {
      unit.name = header;
      if (text > 0 || !units_.empty()) unit.begin = line + 1;
    } else if (is_head) {
      unit.name = name_at(content, behind_blanks(content, at + 4));
      unit.head = line;
      unit.has_head = true;
    }
    begun |= header.empty() && !is_named_line_over(content, 0);
  }
  unit.end = lines.size();
  units_.push_back(unit);
  // The control calls a given text by the name of its file.
  Unit file = units_[known];
  file.name = name_of_file(lines.name());
  if (text > 0 && file.name != units_[known].name) units_.push_back(file);
  for (std::size_t index = known; index < units_.size(); ++index)
    unit_of_name_.try_emplace(units_[index].name, index);
}

// A program in the text itself takes precedence over a given one.
const SinumerikFlow::Unit* SinumerikFlow::unit_named(std::string_view name) const {
  const auto found = unit_of_name_.find(name);
  return name.empty() || found == unit_of_name_.end() ? nullptr : &units_[found->second];
}

SinumerikFlow::Structure SinumerikFlow::structure_of(std::string_view line, std::size_t at) {
  using enum Structure;
  constexpr auto words = std::to_array<std::pair<std::string_view, Structure>>({
      {"IF", branch},
      {"ELSE", otherwise},
      {"ENDIF", end_branch},
      {"FOR", counting},
      {"ENDFOR", end_counting},
      {"WHILE", condition},
      {"ENDWHILE", end_condition},
      {"LOOP", endless},
      {"ENDLOOP", end_endless},
      {"REPEAT", repetition},
      {"UNTIL", Structure::until},
  });
  const std::string word = name_at(line, at);
  const auto found = std::ranges::find(words, word, &std::pair<std::string_view, Structure>::first);
  if (found == words.end()) return none;
  const std::size_t behind = at + word.size();
  if (found->second == branch &&
      place_of_word(line, behind, "GOTO", WordEnd::open) != std::string_view::npos)
    return none;
  if (found->second == repetition && !is_named_line_over(line, behind)) return none;
  return found->second;
}

const SinumerikFlow::Outline& SinumerikFlow::outline_of(const Frame& frame) {
  // A frame of REPEAT lies within its unit.
  const auto unit = std::ranges::find_if(units_, [&](const Unit& each) {
    return each.text == frame.text && each.begin <= frame.begin && frame.end <= each.end;
  });
  const auto [known, is_new] = outlines_.try_emplace({unit->text, unit->end});
  Outline& outline = known->second;
  if (!is_new) return outline;
  OpenStructures open;
  for (std::size_t line = unit->begin; line < unit->end; ++line) {
    checkpoint_.pass();
    const std::string_view content = texts_[unit->text].line(line);
    const NamedHead head = named_head_of(content);
    if (!head.label.empty()) outline.labels[head.label].push_back(line);
    if (head.number >= 0) outline.numbers[head.number].push_back(line);
    outline.take(structure_of(content, head.behind), line, open);
  }
  return outline;
}

void SinumerikFlow::Outline::take(Structure structure, std::size_t line, OpenStructures& open) {
  using enum Structure;
  const auto close = [&](Structure begins) {
    if (open.empty() || open.back().first != begins) return;
    feet[open.back().second] = line;
    heads[line] = open.back().second;
    open.pop_back();
  };
  switch (structure) {
    case branch:
    case counting:
    case condition:
    case endless:
    case repetition:
      open.emplace_back(structure, line);
      break;
    case otherwise:
      close(branch);
      open.emplace_back(otherwise, line);
      break;
    case end_branch:
      if (!open.empty() && open.back().first == otherwise) {
        behind[open.back().second] = line;
        heads[line] = open.back().second;
        open.pop_back();
      } else {
        close(branch);
      }
      break;
    case end_counting:
      close(counting);
      break;
    case end_condition:
      close(condition);
      break;
    case end_endless:
      close(endless);
      break;
    case until:
      close(repetition);
      break;
    case none:
      break;
  }
}

void SinumerikFlow::take_line() {
  Frame& at = frame();
  at.current = at.next++;
  line_ = text_of(at).line(at.current);
  head_ = named_head_of(line_);
  head_.to_skip = may_be_skipped(head_.to_skip);
  is_as_written_ = false;
}

Flow::Step SinumerikFlow::execute_next(std::string& flat) {
  const bool goes_on = frame().next >= frame().end ? end_of_frame(flat) : execute_line(flat);
  if (!goes_on) return Step::refused;
  return ended_ ? Step::ended : Step::goes_on;
}

bool SinumerikFlow::execute_line(std::string& flat) {
  take_line();
  return count_line() && (is_left_out(line_) || execute(flat));
}

bool SinumerikFlow::end_of_frame(std::string& flat) {
  if (frames_.size() == 1) return end_of_program(flat);
  if (frame().own_variables)
    return refuse(Code::block_structure, 0, frame().name + ", a subprogram without its end");
  if (frame().repetitions_left == 0) {
    frames_.pop_back();
    return true;
  }
  // Each repetition counts, so that none goes on forever.
  if (!count_line()) return false;
  --frame().repetitions_left;
  frame().next = frame().restart;
  flat.append("; ").append(frame().name).append(line_end());
  return true;
}

// A name alone is text there: nothing calls it any more.
bool SinumerikFlow::computes_behind_end(std::string_view line) const {
  const std::size_t begin = named_head_of(line).behind;
  const std::string word = name_at(line, begin);
  const std::size_t behind = behind_blanks(line, begin + word.size());
  const bool is_alone = !word.empty() && (behind >= line.size() || line[behind] == ';');
  const bool is_name = is_alone && word != "RET" && structure_of(line, begin) == Structure::none;
  return !is_name && Flow::computes_behind_end(line);
}

// Lines after a label may be meant for other values, and so may a subprogram that nothing has
// called. A second main program with its own end is not.
bool SinumerikFlow::end_of_program(std::string& flat) {
  ended_ = true;
  if (looks_ahead()) return true;
  const Frame& main = frames_.front();
  std::size_t behind = main.current + 1;
  for (; behind < main.end; ++behind) {
    checkpoint_.pass();
    if (!named_head_of(texts_.front().line(behind)).label.empty()) break;
  }
  const std::size_t lost = first_with('G', 41, 42, main.current + 1, behind);
  if (lost < behind) return refuse_contour_behind_end(lost);
  const std::vector<bool> called = said_by_others();
  for (std::size_t index = 0; index < units_.size(); ++index) {
    const Unit& unit = units_[index];
    if (unit.text > 0 || unit.begin < main.end) continue;
    const std::size_t selects = first_with('G', 41, 42, unit.begin, unit.end);
    const bool is_main = first_with('M', 2, 30, unit.begin, unit.end) < unit.end;
    if (selects < unit.end && (is_main || !called[index]))
      return refuse_contour_behind_end(selects);
  }
  write_text_behind_end(flat, behind);
  return keep_parts_behind_end(called, flat);
}

bool SinumerikFlow::refuse_word(Code code, std::size_t begin, std::size_t end,
                                std::string_view why) {
  return refuse(code, begin, std::string(line_.substr(begin, end - begin)).append(why));
}

bool SinumerikFlow::execute(std::string& flat) {
  if (begins_header(line_)) {
    if (frame().current > 0 && frames_.size() == 1) return end_of_program(flat);
    is_as_written_ = true;
    flat.append(line_).append(line_end());
    return true;
  }
  const std::string word = name_at(line_, head_.behind);
  bool is_statement = false;
  const bool goes_on = execute_statement(flat, word, is_statement);
  return is_statement ? goes_on : execute_words(flat);
}

bool SinumerikFlow::execute_statement(std::string& flat, std::string_view word,
                                      bool& is_statement) {
  const std::size_t begin = head_.behind;
  const std::size_t behind = begin + word.size();
  const Structure structure = structure_of(line_, begin);
  const bool begins_value =
      behind_blanks(line_, behind) < line_.size() && line_[behind_blanks(line_, behind)] == '=';
  const bool is_beside = std::ranges::find(beside_the_program, word) != beside_the_program.end() &&
                         begins_value == word.starts_with("ID") && declared(word) == nullptr;
  is_statement = structure != Structure::none || direction_of(word) || is_beside;
  for (const std::string_view other :
       {"IF", "CASE", "DEF", "PROC", "EXTERN", "RET", "REPEAT", "REPEATB"})
    is_statement |= word == other;
  if (!is_statement) return true;
  const bool is_before = word == "DEFINE" || word == "REDEF";
  if (is_beside)
    return refuse_word(Code::nc_unsupported, begin, behind,
                       is_before ? ", not in the program" : ", a synchronized action");
  if (head_.to_skip)
    return refuse(Code::block_skip_undecided, 0, "/, a line to skip that computes");
  if (structure != Structure::none) return follow_structure(flat, structure);
  ExpressionReader expression = expression_at(behind);
  if (word == "IF") return branch(flat, expression);
  if (word == "CASE") return choose_case(expression, flat);
  if (word == "DEF") return define(flat);
  if (word == "PROC") return true;
  if (word == "EXTERN") return declare_external(flat, behind);
  if (word == "RET") {
    if (!is_named_line_over(line_, behind))
      return refuse(Code::nc_unsupported, begin, "RET with a target");
    return return_from(flat);
  }
  if (word.starts_with("REPEAT"))
    return repeat(flat, behind, word == "REPEATB" ? Repeated::block : Repeated::section);
  expression.go_to(begin);
  return jump(expression) && finish_statement(flat, expression.at());
}

// A subprogram that is present is executed, and needs no declaration in the flat program.
bool SinumerikFlow::declare_external(std::string& flat, std::size_t at) {
  if (unit_named(name_at(line_, behind_blanks(line_, at))) != nullptr) return true;
  is_as_written_ = true;
  flat.append(line_).append(line_end());
  return true;
}

bool SinumerikFlow::finish_statement(std::string& flat, std::size_t at) {
  const std::size_t behind = behind_blanks(line_, at);
  if (behind >= line_.size()) return true;
  if (line_[behind] != ';')
    return refuse(Code::expression_invalid, behind, name_of_character(line_.substr(behind)));
  write_behind_number(flat, line_.substr(behind));
  return true;
}

void SinumerikFlow::write_behind_number(std::string& flat, std::string_view text) {
  if (head_.number >= 0)
    flat.append(line_.substr(head_.number_begin, head_.number_end - head_.number_begin))
        .append(" ");
  flat.append(text).append(line_end());
}

}  // namespace trc::program
