#include "core/nc/program/sinumerik_line.h"

#include <algorithm>
#include <array>

#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/named_words.h"

namespace trc::program {
namespace {

bool begins_name(char sign) { return is_letter(sign) || sign == '_'; }
// Passes a plain value after `=`, a number or a text. False: the value may have to be computed.
bool pass_plain_value(std::string_view line, std::size_t& at) {
  at = behind_blanks(line, at);
  if (sign_at(line, at) == '"') {
    at = line.find('"', at + 1);
    if (at == std::string_view::npos) return false;
    ++at;
    return true;
  }
  if (sign_at(line, at) == '-' || sign_at(line, at) == '+') ++at;
  const std::size_t digits = at;
  while (is_digit(sign_at(line, at)) || sign_at(line, at) == '.') ++at;
  const std::size_t behind = behind_blanks(line, at);
  return at > digits && std::string_view("+-*/<>=([E").find(upper(sign_at(line, behind))) ==
                            std::string_view::npos;
}

// A cheap test that rules out most lines: a line of plain letters and numbers computes nothing.
bool may_compute_something(std::string_view line) {
  for (std::size_t at = 0; at < line.size();) {
    const char sign = line[at];
    if (sign == ';') return false;
    if (sign == '$' || sign == '_') return true;
    if (sign == '=') {
      if (!pass_plain_value(line, ++at)) return true;
      continue;
    }
    ++at;
    if (!is_letter(sign)) continue;
    const char letter = upper(sign);
    if (letter == 'L' || letter == 'R' || begins_name(sign_at(line, at))) return true;
  }
  return false;
}

// X=-R1, X=+(…): the reader would take these for a number without digits.
bool is_signed_expression(std::string_view line, std::size_t word) {
  std::size_t at = line.find('=', word);
  if (at == std::string_view::npos) return false;
  at = behind_blanks(line, at + 1);
  if (sign_at(line, at) != '-' && sign_at(line, at) != '+') return false;
  const char sign = sign_at(line, behind_blanks(line, at + 1));
  return begins_name(sign) || sign == '$' || sign == '(';
}

// R[1]=5
bool is_indexed_parameter(std::string_view line, std::size_t word) {
  return upper(sign_at(line, word)) == 'R' && sign_at(line, behind_blanks(line, word + 1)) == '[';
}

// Whether $TC_DP6[R1,1]=R2 or $P_UIFR[1]=CTRANS(X,_SHIFT) asks for a value: otherwise they only
// contain axes and the words of frames.
bool names_variable(std::string_view setting) {
  constexpr auto words =
      std::to_array<std::string_view>({"CFINE", "CMIRROR", "CROT", "CROTS", "CRPL", "CSCALE",
                                       "CTRANS", "FI", "MI", "RT", "SC", "TR"});
  constexpr std::string_view axes = "ABCUVWXYZ";
  for (std::size_t at = name_at(setting, 1).size() + 1; at < setting.size(); ++at) {
    const std::string name = name_at(setting, at);
    if (name.empty()) continue;
    const bool is_axis = axes.find(name.front()) != std::string_view::npos &&
                         name.find_first_not_of("0123456789", 1) == std::string::npos;
    const bool is_exponent = name.starts_with("EX") && is_digit(setting[at - 1]);
    const bool is_frame = setting[at - 1] == '$' && is_sinumerik_frame("$" + name);
    if (!is_axis && !is_exponent && !is_frame && std::ranges::find(words, name) == words.end())
      return true;
    at += name.size() - 1;
  }
  return false;
}

bool computes_word(const ProgramSetup& setup, const NamedWord& word, std::string_view line) {
  const bool knows_programs = !setup.copies_unknown_words || !setup.subprograms.empty();
  switch (word.kind) {
    case NamedWord::Kind::address:
      return word.letter == 'L' || (word.is_variable && !setup.variables.empty());
    case NamedWord::Kind::assignment:
      if (setup.pass_words.contains(word.name)) return false;
      if (word.name.starts_with("$TC_") || is_sinumerik_frame(word.name))
        return names_variable(line.substr(word.begin, word.end - word.begin));
      return !word.is_text && !is_sinumerik_word(word.name);
    case NamedWord::Kind::name:
      if (word.name == "EXTCALL") return !setup.subprograms.empty();
      if (setup.pass_words.contains(word.name)) return false;
      if (is_sinumerik_name(word.name)) return is_sinumerik_statement(word.name);
      return knows_programs;
    case NamedWord::Kind::label:  // GOTOF :30 looks like one
      return is_sinumerik_statement(word.name);
    case NamedWord::Kind::call:
      if (is_sinumerik_call(word.name) || setup.pass_words.contains(word.name)) return false;
      return is_sinumerik_statement(word.name) || knows_programs;
    default:
      return false;
  }
}

}  // namespace

std::string name_at(std::string_view line, std::size_t at) {
  if (!begins_name(sign_at(line, at))) return {};
  std::size_t end = at;
  while (goes_on_as_name(sign_at(line, end))) ++end;
  return in_upper_case(line.substr(at, end - at));
}

NamedHead named_head_of(std::string_view line) {
  NamedHead head;
  std::size_t at = behind_blanks(line, 0);
  if (sign_at(line, at) == '/') {
    head.to_skip = true;
    ++at;
    if (is_digit(sign_at(line, at)) && !is_digit(sign_at(line, at + 1))) ++at;
    at = behind_blanks(line, at);
  }
  if (upper(sign_at(line, at)) == 'N' || sign_at(line, at) == ':') {
    constexpr std::size_t most_digits = 15;
    const std::size_t digits = at + 1;
    std::size_t end = digits;
    std::int64_t number = 0;
    for (; is_digit(sign_at(line, end)) && end - digits < most_digits; ++end)
      number = number * 10 + (line[end] - '0');
    if (end > digits) {
      head.number = number;
      head.number_begin = at;
      head.number_end = end;
      at = behind_blanks(line, end);
    }
  }
  if (const std::string name = name_at(line, at); name.size() > 1) {
    const std::size_t colon = at + name.size();
    if (sign_at(line, colon) == ':') {
      head.label = name;
      head.label_begin = at;
      at = behind_blanks(line, colon + 1);
    }
  }
  head.behind = at;
  return head;
}

bool is_named_line_over(std::string_view line, std::size_t at) {
  at = behind_blanks(line, at);
  return at >= line.size() || line[at] == ';';
}

std::size_t place_of_word(std::string_view line, std::size_t at, std::string_view word,
                          WordEnd end) {
  bool quoted = false;
  for (; at < line.size(); ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (quoted) continue;
    if (line[at] == ';') break;
    if (!begins_name(line[at])) continue;
    const std::string name = name_at(line, at);
    if (end == WordEnd::whole ? name == word : name.starts_with(word)) return at;
    at += name.size() - 1;
  }
  return std::string_view::npos;
}

std::size_t behind_bracket(std::string_view line, std::size_t at) {
  std::size_t depth = 0;
  bool quoted = false;
  for (; at < line.size(); ++at) {
    const char sign = line[at];
    if (sign == '"') quoted = !quoted;
    if (quoted) continue;
    if (sign == '(' || sign == '[') ++depth;
    if ((sign == ')' || sign == ']') && --depth == 0) return at + 1;
  }
  return 0;
}

bool sinumerik_computes(const ProgramSetup& setup, std::string_view line) {
  if (!may_compute_something(line)) return false;
  NamedWordReader reader(line);
  for (;;) {
    const NamedWord word = reader.next();
    if (word.kind == NamedWord::Kind::end) return false;
    if (word.kind == NamedWord::Kind::fault) {
      const TextFault& fault = reader.fault();
      return fault.code == Code::nc_unsupported ||
             (fault.code == Code::nc_number &&
              (is_signed_expression(line, fault.begin) || is_indexed_parameter(line, fault.begin)));
    }
    if (computes_word(setup, word, line)) return true;
  }
}

std::string file_of_header(std::string_view line) {
  constexpr std::string_view beginning = "%_N_";
  const std::size_t at = behind_blanks(line, 0);
  return has_word_at(line, at, beginning) ? name_at(line, at + beginning.size()) : std::string();
}

std::string program_of_header(std::string_view line) {
  std::string name = file_of_header(line);
  for (const std::string_view ending : {main_program_ending, subprogram_ending})
    if (name.ends_with(ending)) name.erase(name.size() - ending.size());
  return name;
}

}  // namespace trc::program
