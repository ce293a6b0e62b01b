#include "core/nc/program/isg_line.h"

#include <algorithm>
#include <array>

#include "core/nc/program/expression.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

namespace trc::program {
namespace {

constexpr std::size_t npos = std::string_view::npos;

// `#`, `[` and `$` begin computed parts, P, V and L a variable or a call, `%` a subprogram.
constexpr std::string_view signs_of_computing = "$[#%PVLpvl";

constexpr std::array<bool, 256> make_signs() {
  std::array<bool, 256> signs{};
  for (const char sign : signs_of_computing) signs[static_cast<unsigned char>(sign)] = true;
  return signs;
}
constexpr std::array<bool, 256> computing_signs = make_signs();

bool is_function_at(std::string_view line, std::size_t at) {
  std::size_t end = at;
  while (is_letter(sign_at(line, end))) ++end;
  if (end - at < 2 || sign_at(line, behind_blanks(line, end)) != '[') return false;
  const std::string name = in_upper_case(line.substr(at, end - at));
  const auto& functions = isg_grammar().functions;
  return std::ranges::find(functions, name, &FunctionRow::spelling) != functions.end();
}

bool is_in_isg_comment(std::string_view line, std::size_t at, std::size_t place) {
  while (at < place) {
    if (line[at] == '(' || line[at] == ';') {
      const std::size_t behind = behind_isg_comment(line, at);
      if (behind == 0 || behind > place) return true;
      at = behind;
    } else {
      ++at;
    }
  }
  return false;
}

// V.G.WZ_AKT.R = 5 and V.G.WZ_AKT.R = V.G.WZ_AKT.R - 0.1 are words of the reader, V.P.A = 5 is a
// line that passes: none of them needs computing.
bool is_plain_assignment(std::string_view line, std::size_t at) {
  const auto end_of_name = [&](std::size_t begin) {
    while (goes_on_as_name(sign_at(line, begin)) || sign_at(line, begin) == '.') ++begin;
    return begin;
  };
  const std::size_t end = end_of_name(at);
  const std::string name = in_upper_case(line.substr(at, end - at));
  std::size_t value = behind_blanks(line, end);
  if (sign_at(line, value) != '=' || sign_at(line, value + 1) == '=') return false;
  value = behind_blanks(line, value + 1);
  if (in_upper_case(line.substr(value, name.size())) == name && name.starts_with("V.G."))
    value = behind_blanks(line, value + name.size());
  if (sign_at(line, value) == '"') {
    const std::size_t close = line.find('"', value + 1);
    return close != npos && is_isg_line_over(line, close + 1);
  }
  if (sign_at(line, value) == '-' || sign_at(line, value) == '+')
    value = behind_blanks(line, value + 1);
  double number = 0;
  bool whole = false;
  const std::size_t length = read_number(line.substr(std::min(value, line.size())), number, whole);
  const std::size_t behind = behind_blanks(line, value + length);
  return length > 0 && std::string_view("+-*/<>=&|^[").find(sign_at(line, behind)) == npos;
}

// The value after an address: P1, V.P.X, [P1+5], SIN[30], also after its `=` or a sign.
bool computes_behind(std::string_view line, std::size_t at) {
  at = behind_blanks(line, at);
  if (sign_at(line, at) == '=') at = behind_blanks(line, at + 1);
  return is_isg_expression_at(line, at);
}

bool computes_command(std::string_view line, std::size_t begin, std::size_t end) {
  const std::string word = word_behind_sign(line, begin);
  if (word == "VAR" || word == "ENDVAR" || word == "DELETE") return true;
  bool quoted = false;
  for (std::size_t at = begin; at < end; ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (quoted || (line[at] != '[' && line[at] != ',' && line[at] != '=')) continue;
    const std::size_t value = behind_blanks(line, at + 1);
    if (is_isg_parameter_at(line, value) || is_isg_variable_at(line, value)) return true;
  }
  return false;
}

}  // namespace

bool zero_offset_hangs_on_program(std::string_view text) {
  text = text.substr(0, text.find_first_of("(;"));
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (goes_on_as_name(text[at - 1]) || text[at - 1] == '.') continue;
    if (is_isg_parameter_at(text, at)) return true;
    if (!is_isg_variable_at(text, at)) continue;
    const std::string name = in_upper_case(text.substr(at, 6));
    if (name.starts_with("V.P.") || name.starts_with("V.L.") || name == "V.CYC." ||
        name == "V.G.WZ")
      return true;
  }
  return false;
}

bool is_plain_isg(std::string_view text) {
  return std::ranges::all_of(signs_of_computing,
                             [&](char sign) { return text.find(sign) == npos; });
}

bool bounds_isg_comment(std::string_view line) {
  const std::size_t sign = line.find('#');
  return sign != npos && word_behind_sign(line, sign) == "COMMENT";
}

bool begins_isg_comment(std::string_view line) {
  const std::string text = in_upper_case(line.substr(line.find('#')));
  return text.find("BEGIN") != std::string::npos;
}

bool isg_tells_state(std::string_view line) {
  return bounds_isg_comment(line) || is_isg_variable_at(line, head_of(line).behind);
}

IsgHead isg_head_of(std::string_view line) {
  IsgHead head;
  const LineHead plain = head_of(line);
  head.to_skip = plain.to_skip;
  head.number = plain.number;
  head.number_begin = plain.number_begin;
  head.number_end = plain.number_end;
  std::size_t at = plain.behind;
  if (head.number >= 0 && sign_at(line, at) == ':') {
    head.is_target = true;
    at = behind_blanks(line, at + 1);
  }
  if (sign_at(line, at) == '[') {
    const std::size_t close = line.find(']', at);
    const std::string_view name =
        close == npos ? std::string_view() : line.substr(at + 1, close - at - 1);
    if (!name.empty() && std::ranges::all_of(name, goes_on_as_name)) {
      head.label = in_upper_case(name);
      at = behind_blanks(line, close + 1);
    }
  }
  head.behind = at;
  return head;
}

std::size_t behind_isg_comment(std::string_view line, std::size_t at) {
  if (sign_at(line, at) == ';') return line.size();
  std::size_t depth = 0;
  for (; at < line.size(); ++at) {
    if (line[at] == '(') ++depth;
    if (line[at] == ')' && --depth == 0) {
      while (sign_at(line, at + 1) == ')') ++at;
      return at + 1;
    }
  }
  return 0;
}

std::size_t end_of_isg_command(std::string_view line, std::size_t at) {
  if (const std::size_t length = behind_suppressed_offsets(line.substr(at))) return at + length;
  const std::size_t begin = at;
  std::size_t depth = 0;
  bool quoted = false;
  for (++at; at < line.size(); ++at) {
    const char sign = line[at];
    if (sign == '"') quoted = !quoted;
    if (quoted) continue;
    if (sign == '[') ++depth;
    if (sign == ']' && depth > 0) --depth;
    if (depth == 0 && (sign == '(' || sign == ';')) break;
  }
  return begin + without_blanks_behind(line.substr(begin, at - begin)).size();
}

bool is_isg_line_over(std::string_view line, std::size_t at) {
  for (at = behind_blanks(line, at); at < line.size(); at = behind_blanks(line, at)) {
    if (line[at] != '(' && line[at] != ';') return false;
    at = behind_isg_comment(line, at);
    if (at == 0) return false;
  }
  return true;
}

std::string word_behind_sign(std::string_view line, std::size_t at) {
  std::size_t end = ++at;
  while (is_letter(sign_at(line, end))) ++end;
  return in_upper_case(line.substr(std::min(at, line.size()), end - at));
}

bool is_isg_parameter_at(std::string_view line, std::size_t at) {
  if (upper(sign_at(line, at)) != 'P') return false;
  while (upper(sign_at(line, at)) == 'P') ++at;
  return is_digit(sign_at(line, at)) || sign_at(line, at) == '[';
}

bool is_isg_variable_at(std::string_view line, std::size_t at) {
  return upper(sign_at(line, at)) == 'V' && sign_at(line, at + 1) == '.' &&
         is_letter(sign_at(line, at + 2));
}

bool computes_spindle(std::string_view words) {
  for (std::size_t at = 0; at < words.size(); ++at) {
    if (is_isg_parameter_at(words, at) || is_isg_variable_at(words, at)) return true;
    while (upper(words[at]) == 'P' && upper(sign_at(words, at + 1)) == 'P') ++at;
  }
  return false;
}

bool is_isg_expression_at(std::string_view line, std::size_t at) {
  while (sign_at(line, at) == '-' || sign_at(line, at) == '+') at = behind_blanks(line, at + 1);
  return sign_at(line, at) == '[' || is_isg_parameter_at(line, at) ||
         is_isg_variable_at(line, at) || is_function_at(line, at);
}

std::string isg_subprogram_of(std::string_view line) {
  std::size_t at = behind_blanks(line, 0);
  if (sign_at(line, at) != '%' || upper(sign_at(line, at + 1)) != 'L') return {};
  const std::size_t name = behind_blanks(line, at + 2);
  if (name == at + 2) return {};
  at = name;
  while (at < line.size() && std::string_view(" \t(;").find(line[at]) == npos) ++at;
  return in_upper_case(line.substr(name, at - name));
}

bool begins_isg_program(std::string_view line) {
  return sign_at(line, behind_blanks(line, 0)) == '%' && isg_subprogram_of(line).empty();
}

IsgCall isg_call_at(std::string_view line, std::size_t at) {
  IsgCall call;
  if (upper(sign_at(line, at)) != 'L') return call;
  std::size_t name = at + 1;
  call.is_local = upper(sign_at(line, name)) == 'L';
  if (call.is_local) ++name;
  call.begin = behind_blanks(line, name);
  // L4712, LPART2.NC
  call.is_joined = call.begin == name;
  if (call.begin >= line.size() || (call.is_joined && !goes_on_as_name(line[name]))) return call;
  const bool quoted = line[call.begin] == '"';
  if (quoted) ++call.begin;
  call.end = call.begin;
  const std::string_view ends = quoted ? "\"" : " \t[(;";
  while (call.end < line.size() && ends.find(line[call.end]) == npos) ++call.end;
  std::string_view path = line.substr(call.begin, call.end - call.begin);
  if (const std::size_t folder = path.find_last_of("/\\"); folder != npos)
    path.remove_prefix(folder + 1);
  call.name = in_upper_case(path);
  if (quoted && call.end < line.size()) ++call.end;
  // L X+10 is a line of another language.
  const bool is_axis_word = !call.is_joined && call.name.size() > 1 &&
                            is_letter(call.name.front()) &&
                            call.name.find_first_of("+-0123456789", 1) == 1 &&
                            call.name.find_first_not_of("+-.0123456789", 1) == std::string::npos;
  const bool is_other_word = call.is_joined && call.name.find('=') != std::string::npos;
  call.is_call = !call.name.empty() && !is_axis_word && !is_other_word;
  return call;
}

std::size_t isg_call_behind_words(std::string_view line, std::size_t at) {
  const std::string_view words = without_blanks_behind(line);
  std::size_t begin = words.size();
  while (begin > at && (goes_on_as_name(words[begin - 1]) || words[begin - 1] == '.')) --begin;
  const bool is_last_word = begin > at && behind_blanks(line, begin - 1) == begin;
  if (!is_last_word || upper(sign_at(words, begin)) != 'L' ||
      !is_letter(sign_at(words, begin + 1)) || is_in_isg_comment(line, at, begin))
    return npos;
  return begin;
}

std::string plain_file_name(std::string_view name) {
  if (const std::size_t folder = name.find_last_of("/\\"); folder != npos)
    name.remove_prefix(folder + 1);
  return in_capitals_as_utf8(name.substr(0, name.rfind('.')));
}

const std::string* given_subprogram(const ProgramSetup& setup, std::string_view name) {
  const std::string plain = plain_file_name(name);
  for (const auto& [file, text] : setup.subprograms)
    if (plain_file_name(file) == plain) return &text;
  return nullptr;
}

bool isg_computes(const ProgramSetup& setup, std::string_view line) {
  if (std::ranges::none_of(
          line, [](char sign) { return computing_signs[static_cast<unsigned char>(sign)]; }))
    return false;
  if (!isg_subprogram_of(line).empty()) return true;
  if (begins_isg_program(line)) return false;
  const IsgHead head = isg_head_of(line);
  if (head.is_target || !head.label.empty()) return true;
  if (const IsgCall call = isg_call_at(line, head.behind); call.is_call)
    return (call.is_local && !call.is_joined) ||
           (call.name != "CYCLE" && given_subprogram(setup, call.name) != nullptr) ||
           is_isg_variable_at(call.name, 0);
  for (std::size_t at = head.behind; at < line.size(); at = behind_blanks(line, at)) {
    const char sign = line[at];
    if (sign == '$') return is_letter(sign_at(line, at + 1));
    if (sign == '(' || sign == ';') {
      at = behind_isg_comment(line, at);
      if (at == 0) return false;
    } else if (sign == '#') {
      const std::size_t end = end_of_isg_command(line, at);
      if (computes_command(line, at, end)) return true;
      at = std::max(end, at + 1);
    } else if (is_isg_variable_at(line, at)) {
      const std::string_view words = line.substr(at);
      return begins_zero_offset(words) ? zero_offset_hangs_on_program(words)
                                       : !is_plain_assignment(line, at);
    } else if (is_isg_parameter_at(line, at)) {
      // P500 alone is a word of another language.
      std::size_t behind = at;
      while (goes_on_as_name(sign_at(line, behind))) ++behind;
      if (sign_at(line, behind) == '[')
        behind = std::min(line.find(']', behind), line.size() - 1) + 1;
      behind = behind_blanks(line, behind);
      return sign_at(line, behind) == '=' ||
             (sign_at(line, behind + 1) == '=' &&
              std::string_view("+-*/").find(sign_at(line, behind)) != npos);
    } else if (const std::size_t length = behind_spindle_words(line.substr(at))) {
      if (computes_spindle(line.substr(at, length))) return true;
      at += length;
    } else if (is_letter(sign)) {
      if (computes_behind(line, at + 1)) return true;
      ++at;
      if (is_letter(sign_at(line, at))) return false;  // a name of another language
      while (is_digit(sign_at(line, at)) || sign_at(line, at) == '.') ++at;
      // S2=P1
      const std::size_t equals = behind_blanks(line, at);
      if (sign_at(line, equals) == '=' && computes_behind(line, equals)) return true;
    } else {
      ++at;
    }
  }
  return false;
}

}  // namespace trc::program
