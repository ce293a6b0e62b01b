#include "core/nc/program/fanuc_programs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/nc/program/gcode_flow.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"

namespace trc::program {
namespace {

constexpr std::size_t usual_digits = 4;

bool has_letter_at(std::string_view line, std::size_t at, char letter) {
  return at < line.size() && upper(line[at]) == letter;
}

// The number after an address, and the position after the number.
struct SaidNumber {
  double number = -1;
  bool is_whole = false;
  bool is_computed = false;
  std::size_t behind = 0;
};

SaidNumber said_number(std::string_view line, std::size_t at) {
  SaidNumber said;
  bool whole = false;
  at = behind_blanks(line, at);
  said.is_computed = at < line.size() && (line[at] == '#' || line[at] == '[');
  double number = 0;
  said.behind = at + read_number(line.substr(at), number, whole);
  if (said.behind > at) said.number = number;
  said.is_whole = said.behind > at && is_whole(number);
  return said;
}

// The words of a line that give the target of its call.
struct CallWords {
  bool calls = false;
  bool mills = false;
  bool says_target = false;
  SaidNumber target{};
  std::string name{};  // M98 <NAME>
};

CallWords call_words_of(std::string_view line) {
  CallWords words;
  for (std::size_t at = 0; at < line.size() && line[at] != ';';) {
    if (line[at] == '(') {
      at = behind_comment(line, at);
      if (at == 0) break;
      continue;
    }
    const char letter = upper(line[at]);
    at = behind_blanks(line, at + 1);
    if (letter != 'M' && letter != 'G' && letter != 'P') continue;
    const SaidNumber said = said_number(line, at);
    if (letter == 'P' && !words.says_target) {
      words.target = said;
      words.says_target = true;
    }
    words.calls |= letter == 'M' && said.number == 98;
    words.calls |= letter == 'G' && (said.number == 65 || said.number == 66);
    words.mills |= letter == 'G' && said.number == 150;
    at = std::max(at, said.behind);
    const std::size_t open = behind_blanks(line, at);
    if (letter != 'M' || said.number != 98 || !has_letter_at(line, open, '<')) continue;
    const std::size_t close = std::min(line.find('>', open), line.size() - 1);
    words.name = in_upper_case(line.substr(open, close + 1 - open));
    at = close + 1;
  }
  return words;
}

}  // namespace

std::string ProgramHead::told() const {
  if (number < 0) return "O" + name;
  return "O" + std::string(name.size() < usual_digits ? usual_digits - name.size() : 0, '0') + name;
}

bool may_begin_program(std::string_view line) {
  const std::size_t at = behind_blanks(line, 0);
  return at < line.size() && std::string_view("Oo:<").find(line[at]) != std::string_view::npos;
}

std::string without_head(std::string_view line, const ProgramHead& head) {
  return std::string(head.behind, ' ').append(line.substr(head.behind));
}

ProgramHead program_head_of(std::string_view line) {
  ProgramHead head;
  if (!may_begin_program(line)) return head;
  head.begin = behind_blanks(line, 0);
  const bool says_o = has_letter_at(line, head.begin, 'O') || has_letter_at(line, head.begin, ':');
  const std::size_t at = says_o ? behind_blanks(line, head.begin + 1) : head.begin;
  if (has_letter_at(line, at, '<')) {
    const std::size_t close = line.find('>', at);
    if (close == std::string_view::npos || close == at + 1) return {};
    if (!says_o && !is_over(line, close + 1)) return {};
    head.name = in_upper_case(line.substr(at, close + 1 - at));
    head.behind = close + 1;
    return head;
  }
  if (!says_o || at >= line.size() || !is_digit(line[at])) return {};
  const SaidNumber said = said_number(line, at);
  if (!said.is_whole || line.substr(at, said.behind - at).find('.') != std::string_view::npos)
    return {};
  head.number = static_cast<std::int64_t>(said.number);
  head.name = std::to_string(head.number);
  head.behind = said.behind;
  return head;
}

void add_calls(std::string_view line, ProgramCalls& calls) {
  const CallWords words = call_words_of(line);
  if (!words.calls && !words.mills) return;
  if (!words.name.empty()) {
    calls.names.insert(words.name);
    return;
  }
  if (!words.says_target) return;
  calls.is_computed |= words.target.is_computed;
  if (!words.target.is_whole) return;
  constexpr std::int64_t of_four_digits = 10'000;
  const auto number = static_cast<std::int64_t>(words.target.number);
  (words.calls ? calls.names : calls.milled).insert(std::to_string(number));
  // Older controls write repetitions before the four digits of the program.
  if (number >= of_four_digits) calls.names.insert(std::to_string(number % of_four_digits));
}

std::vector<ProgramOfText> programs_of(const ProgramText& text, Checkpoint& checkpoint) {
  std::vector<ProgramOfText> programs;
  for (std::size_t at = 0; at < text.size(); ++at) {
    checkpoint.pass();
    const std::string_view line = text.line(at);
    ProgramHead head = program_head_of(line);
    if (head.is_there()) {
      if (!programs.empty()) programs.back().end = at;
      programs.push_back({.head = std::move(head), .begin = at, .end = text.size()});
    }
    const bool says_nothing = is_percent(line) || is_over(line, 0);
    if (says_nothing) continue;
    if (programs.empty()) programs.push_back({.begin = at, .end = text.size()});
    programs.back().ends_all |= has_function(line, 'M', 2, 30);
    programs.back().returns |= has_function(line, 'M', 99, 99);
    add_calls(line, programs.back().calls);
  }
  return programs;
}

MainProgram main_program_of(const ProgramText& text, const ProgramHead& begun,
                            Checkpoint& checkpoint) {
  std::vector<ProgramOfText> programs = programs_of(text, checkpoint);
  if (programs.empty()) return {};
  ProgramOfText& first = programs.front();
  if (!first.head.is_there()) first.head = begun;
  if (!first.head.is_there()) return {};
  const auto is_called = [&](const ProgramOfText& program, bool by_any) {
    return std::ranges::any_of(programs, [&](const ProgramOfText& other) {
      const bool calls =
          by_any ? other.calls.may_lead_to(program.head.name) : other.calls.say(program.head.name);
      return &other != &program && calls;
    });
  };
  if (first.ends_all || !first.returns || !is_called(first, true)) return {.line = first.begin};
  std::vector<const ProgramOfText*> mains;
  for (const ProgramOfText& program : programs)
    if (program.ends_all && !is_called(program, false)) mains.push_back(&program);
  if (mains.size() == 1)
    return {.line = mains.front()->begin, .is_first = false, .first = first.head.told()};
  std::string told;
  for (const ProgramOfText* main : mains) told += (told.empty() ? "" : ", ") + main->head.told();
  return {.line = first.begin,
          .is_first = false,
          .first = first.head.told(),
          .ambiguous = first.head.told() + ", a subprogram before " +
                       (mains.empty() ? "what calls it, where no program ends with M02 or M30"
                                      : "several main programs: " + told)};
}

bool tells_main_program(std::string_view line) {
  constexpr std::array of_mains{20.0, 21.0, 28.0, 30.0, 53.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0};
  for (std::size_t at = 0; at < line.size() && line[at] != ';';) {
    if (line[at] == '(') {
      at = behind_comment(line, at);
      if (at == 0) return false;
      continue;
    }
    const char letter = upper(line[at++]);
    if (letter != 'M' && letter != 'G' && letter != 'T') continue;
    const SaidNumber said = said_number(line, at);
    if (said.behind == at) continue;
    at = said.behind;
    const double number = said.number;
    if (letter == 'T' || (letter == 'M' && (number == 2 || number == 30 || number == 6)))
      return true;
    if (letter == 'G' && std::ranges::find(of_mains, number) != of_mains.end()) return true;
  }
  return false;
}

}  // namespace trc::program
