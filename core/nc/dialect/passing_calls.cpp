#include <algorithm>
#include <string>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/text/characters.h"

// Lines that pass while TRC is off. Of ISG (D-47): calls of subprograms, which are not looked into,
// and assignments to variables, which nothing that is read here depends on. Of the other dialects
// calls of what only the machine has (D-64).

namespace trc {
namespace {

constexpr std::string_view digits = "0123456789";

// A line of another dialect that moves: L X+10, L Z100.
bool is_axis_word(std::string_view name) {
  const std::size_t number = name.find_first_of("+-0123456789", 1);
  return number == 1 && name.find_first_not_of("+-.0123456789", 1) == std::string_view::npos;
}

// L NAME and LL NAME, of a file or in the program; L CYCLE [NAME=...]. Nothing stands behind it but
// a comment.
bool calls_subprogram(std::string_view text) {
  std::size_t letters = 0;
  while (letters < text.size() && letters < 2 && upper(text[letters]) == 'L') ++letters;
  if (letters == 0 || blank_at_start(text.substr(letters)) == 0) return false;
  const std::string_view rest = without_blanks_in_front(text.substr(letters));
  const bool quoted = rest.starts_with('"');
  const std::size_t close = quoted ? rest.find('"', 1) : 0;
  if (close == std::string_view::npos) return false;
  const std::size_t end = std::min(rest.find_first_of(" \t[(;", close), rest.size());
  const std::string_view name = rest.substr(0, end);
  const std::string_view behind = without_blanks_in_front(rest.substr(end));
  return !name.empty() && !is_axis_word(name) &&
         (behind.empty() || std::string_view("[(;").find(behind.front()) != std::string_view::npos);
}

// Whether words of a block stand in or behind the value of an assignment, as in V.P.A=5 G01 X9:
// they would pass as text and be lost. P1 is a variable, 1E5 a number, V.L.X1 a name.
bool holds_words(std::string_view value) {
  int brackets = 0;
  for (std::size_t at = 0; at < value.size() && value[at] != '(' && value[at] != ';'; ++at) {
    const char sign = upper(value[at]);
    const char next = at + 1 < value.size() ? upper(value[at + 1]) : ' ';
    if (sign == '[') ++brackets;
    if (sign == ']') --brackets;
    if (sign == '"') at = std::min(value.find('"', at + 1), value.size() - 1);
    const bool begins_name = is_letter(sign) && (is_letter(next) || next == '.' || next == '_');
    if (begins_name) {
      while (at + 1 < value.size() && (is_letter(value[at + 1]) || is_digit(value[at + 1]) ||
                                       value[at + 1] == '.' || value[at + 1] == '_'))
        ++at;
      continue;
    }
    const bool exponent = sign == 'E' && at > 0 && is_digit(value[at - 1]);
    const bool is_word = is_letter(sign) && sign != 'P' && !exponent && next != '[';
    if (brackets == 0 && (is_word || sign == '#' || sign == '$')) return true;
  }
  return false;
}

// V.P.DEPTH = 3, P10 = 5, also declared between #VAR and #ENDVAR: V.P.DEPTH : REAL64. Not of the
// tool in force, V.G., which says the radius.
bool assigns_variable(std::string_view text) {
  const bool is_variable = text.size() >= 5 && upper(text[0]) == 'V' && text[1] == '.' &&
                           text[3] == '.' &&
                           std::string_view("PLSE").find(upper(text[2])) != std::string_view::npos;
  const bool is_parameter = text.size() > 2 && upper(text[0]) == 'P' && is_digit(text[1]);
  if (!is_variable && !is_parameter) return false;
  const std::size_t behind = std::min(text.find_first_of("= \t(;:", 1), text.size());
  const bool is_number =
      text.substr(1, text.find('[') - 1).substr(0, behind - 1).find_first_not_of(digits) ==
      std::string_view::npos;
  if (is_parameter && !is_number) return false;  // P1.5
  const std::string_view value = without_blanks_in_front(text.substr(behind));
  if (value.empty() || value.front() == ':') return is_variable || value.starts_with(':');
  return value.front() == '=' && !holds_words(value.substr(1));
}

}  // namespace

bool Interpreter::read_passing_line(ProgramLine& line, BlockWords& block) {
  const std::string_view text = line.text;
  std::size_t begin = 0;
  const auto skip_blanks = [&] {
    while (const std::size_t blank = blank_at_start(text.substr(begin))) begin += blank;
  };
  skip_blanks();
  if (begin < text.size() && upper(text[begin]) == 'N') {
    const std::size_t number = begin + 1;
    const std::size_t behind = std::min(text.find_first_not_of(digits, number), text.size());
    constexpr std::size_t most_digits = 9;
    if (behind == number || behind - number > most_digits) return false;
    line.source.number = std::stoll(std::string(text.substr(number, behind - number)));
    begin = behind;
    skip_blanks();
  }
  const std::string_view words = text.substr(begin);
  const bool calls = calls_subprogram(words);
  const bool passes = (calls || assigns_variable(words)) &&
                      first_byte_that_is_no_text(text) == std::string_view::npos;
  if (!passes) {
    line.source.number = Source::no_number;
    return false;
  }
  isg_word_seen_ = true;
  line.words.push_back({.begin = static_cast<std::uint32_t>(begin),
                        .end = static_cast<std::uint32_t>(text.size()),
                        .role = WordRole::technology});
  if (calls) forget_what_a_call_may_change(line, block);
  return true;
}

// T5 LM06: a call behind words that do not move. `begin` is where it stands.
bool Interpreter::read_call_behind_words(std::uint32_t begin, ProgramLine& line,
                                         BlockWords& block) {
  const std::string_view text = line.text;
  if (begin + 2 >= text.size()) return false;
  std::size_t end = begin + 1;
  const auto is_part_of_name = [](char sign) {
    return is_letter(sign) || is_digit(sign) || sign == '_' || sign == '.';
  };
  while (end < text.size() && is_part_of_name(text[end])) ++end;
  const bool is_call = dialect_.name == DialectName::isg && upper(text[begin]) == 'L' &&
                       end > begin + 2 && is_letter(text[begin + 1]) &&
                       without_blanks_in_front(text.substr(end)).empty();
  if (!is_call || contour_open() || block.axis || block.center) return false;
  line.words.push_back(
      {.begin = begin, .end = static_cast<std::uint32_t>(end), .role = WordRole::technology});
  forget_what_a_call_may_change(line, block);
  return true;
}

bool Interpreter::read_call_of_machine(ProgramLine& line, BlockWords& block) {
  const std::string_view text = line.text;
  const auto behind_blanks = [&](std::size_t at) {
    return text.size() - without_blanks_in_front(text.substr(at)).size();
  };
  std::size_t begin = behind_blanks(0);
  const std::size_t number = begin;
  if (begin < text.size() && upper(text[begin]) == 'N') {
    begin = behind_blanks(std::min(text.find_first_not_of(digits, begin + 1), text.size()));
    line.words.push_back({.begin = static_cast<std::uint32_t>(number),
                          .end = static_cast<std::uint32_t>(begin),
                          .role = WordRole::number});
  }
  const char comment = dialect_.name == DialectName::sinumerik ? ';' : '(';
  const std::string_view call =
      without_blanks_behind(text.substr(begin, text.find(comment, begin) - begin));
  if (contour_open())
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = static_cast<std::uint32_t>(begin),
                                  .detail = std::string(call) +
                                            ", a call of what only the machine has while TRC is "
                                            "active"});
  line.words.push_back({.begin = static_cast<std::uint32_t>(begin),
                        .end = static_cast<std::uint32_t>(begin + call.size()),
                        .role = WordRole::technology});
  if (begin + call.size() < text.size())
    line.words.push_back({.begin = static_cast<std::uint32_t>(begin + call.size()),
                          .end = static_cast<std::uint32_t>(text.size()),
                          .role = WordRole::comment});
  forget_what_a_call_may_change(line, block);
  return true;
}

void Interpreter::forget_what_a_call_may_change(ProgramLine& line, BlockWords& block) {
  line.calls_the_machine = true;
  line.feed_it_takes = feed_mode_ == 94 ? feed_ : 0;
  block.forget = all_axes;
  called_motion_ = called_dimension_ = true;
  reads_plain_lines_ = false;
}

// Whether G00 or G01, G90 or G91 holds behind a call, the subprogram has decided: until the program
// says it anew a motion leads to where only the control knows.
void Interpreter::restate_modes(ProgramLine& line, BlockWords& block) {
  if (!called_motion_ && !called_dimension_) return;
  called_motion_ = called_motion_ && !block.has(GGroup::motion);
  called_dimension_ = called_dimension_ && !block.has(GGroup::dimension);
  if (!called_motion_ && !called_dimension_) {
    reads_plain_lines_ = faults_.empty();
    return;
  }
  if (contour_open() || !(block.axis || block.center)) return;
  if (block.has(GGroup::side) && !block.of(GGroup::side).is(40)) {
    block.forget = all_axes;
    return;
  }
  block.copied = true;
  block.forget = all_axes;
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate) word.role = WordRole::technology;
}

}  // namespace trc
