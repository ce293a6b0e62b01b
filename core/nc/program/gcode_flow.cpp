#include "core/nc/program/gcode_flow.h"

#include <algorithm>
#include <cmath>

#include "core/base/reasons.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/number_format.h"

namespace trc::program {
namespace {

// Words that count something: Fanuc rounds their values to whole numbers.
bool counts(char letter) {
  return std::string_view("MSTDH").find(letter) != std::string_view::npos;
}

// O0002, :0002, o<name> sub
bool begins_program(std::string_view line, std::size_t at) {
  return at < line.size() && (upper(line[at]) == 'O' || line[at] == ':');
}

}  // namespace

bool is_percent(std::string_view line) {
  const std::size_t at = behind_blanks(line, 0);
  return at < line.size() && line[at] == '%';
}

void GcodeFlow::begin_line() {
  Frame& at = frame();
  at.current = at.next++;
  line_ = text_of(at).line(at.current);
  head_ = head_of(line_);
  head_.to_skip = may_be_skipped(head_.to_skip);
  is_as_written_ = false;
}

bool GcodeFlow::scan_words() {
  words_.clear();
  is_read_by_the_reader_ = false;
  has_computed_ = false;
  for (std::size_t at = head_.behind; at < line_.size(); at = behind_blanks(line_, at)) {
    ComputedWord word{.begin = at};
    char sign = line_[at];
    if (sign == '(' || sign == ';') {
      word.kind = ComputedWord::Kind::comment;
      at = behind_comment(line_, at);
      is_read_by_the_reader_ |= at == 0;
    } else if (sign == '/') {
      word.kind = ComputedWord::Kind::skip;
      while (++at < line_.size() && is_digit(line_[at])) continue;
    } else if (sign == '#') {
      word.left_out = true;
      has_computed_ = true;
      if (!scan_assignment(at)) return false;
    } else {
      if (sign == ',') sign = ++at < line_.size() ? line_[at] : '\0';
      const bool is_name = at + 1 < line_.size() && is_letter(line_[at + 1]);
      const bool is_polar =
          grammar_.dialect == DialectName::linuxcnc && (sign == '@' || sign == '^');
      is_read_by_the_reader_ |= (!is_letter(sign) && !is_polar) || is_name;
      word.letter = upper(sign);
      at = behind_blanks(line_, at + 1);
      if (!is_read_by_the_reader_ && !scan_value(word, at)) return false;
    }
    if (is_read_by_the_reader_) return true;
    word.end = at;
    words_.push_back(word);
  }
  if (grammar_.dialect == DialectName::fanuc && has_computed_) round_whole_words();
  return true;
}

// P of Fanuc has no decimal point: in dwells and cycles it counts milliseconds. P of G51 is a
// factor, and P of a call must be whole without rounding.
void GcodeFlow::round_whole_words() {
  const bool is_exact = std::ranges::any_of(words_, [](const ComputedWord& word) {
    return word.is('G', 51) || word.is('G', 65) || word.is('G', 66) || word.is('M', 97) ||
           word.is('M', 98) || word.is('M', 99);
  });
  if (is_exact) return;
  for (ComputedWord& word : words_)
    if (word.computed && word.letter == 'P') word.value.number = std::round(word.value.number);
}

bool GcodeFlow::scan_assignment(std::size_t& at) {
  return refuse(Code::expression_invalid, at, "#, a variable without an address");
}

bool GcodeFlow::scan_value(ComputedWord& word, std::size_t& at) {
  bool whole = false;
  if (const std::size_t length = read_number(line_.substr(at), word.value.number, whole)) {
    at += length;
    return true;
  }
  const std::size_t begin = at;
  const bool is_signed = at < line_.size() && (line_[at] == '-' || line_[at] == '+');
  const bool is_negative = is_signed && line_[at] == '-';
  if (is_signed) at = behind_blanks(line_, at + 1);
  const char sign = at < line_.size() ? line_[at] : '\0';
  if (sign != '#' && sign != '[') {  // the reader reports the missing value
    at = begin;
    return true;
  }
  const bool fanuc = grammar_.dialect == DialectName::fanuc;
  ExpressionReader expression = expression_at(at);
  if (fanuc && style_of(word.letter) == PointStyle::with_point)
    expression.round_to(modes_.unit == LengthUnit::inch ? 4 : 3);
  word.value = expression.operand();
  if (expression.failed()) return refuse(expression.fault());
  word.computed = has_computed_ = true;
  at = expression.at();
  // Programs write S[#1]. with the decimal point of a number.
  if (fanuc && sign == '[' && sign_at(line_, at) == '.' && !is_digit(sign_at(line_, at + 1))) ++at;
  const auto refuse_value = [&](Code code) {
    return refuse(code, begin, std::string(line_.substr(begin, at - begin)));
  };
  if (word.value.vacant && sign == '[') return refuse_value(Code::variable_unset);
  if (is_negative) word.value.number = -word.value.number;
  if (fanuc && counts(word.letter)) word.value.number = std::round(word.value.number);
  if (looks_ahead()) suppose_tool(word);
  word.left_out = word.value.vacant;
  constexpr double largest = 1e9;
  if (std::abs(word.value.number) > largest) return refuse_value(Code::value_invalid);
  // X#1+5 looks like arithmetic, but is none.
  const std::size_t behind = behind_blanks(line_, at);
  const bool is_arithmetic = behind < line_.size() && std::string_view("+-*[]").find(
                                                          line_[behind]) != std::string_view::npos;
  return !is_arithmetic || refuse(Code::expression_invalid, behind, std::string(1, line_[behind]));
}

// An unknown value must not lead to a report of a missing tool.
void GcodeFlow::suppose_tool(ComputedWord& word) const {
  const bool names_tool = word.letter == 'D' || word.letter == 'T';
  if (!names_tool || setup_.tools.empty()) return;
  if (!setup_.tools.contains(static_cast<std::int64_t>(word.value.number)))
    word.value.number = static_cast<double>(setup_.tools.begin()->first);
}

ComputedWord* GcodeFlow::word_of(char letter) {
  const auto found = std::ranges::find_if(words_, [&](const ComputedWord& word) {
    return word.kind == ComputedWord::Kind::address && word.letter == letter && !word.left_out;
  });
  return found == words_.end() ? nullptr : &*found;
}

std::optional<std::int64_t> GcodeFlow::whole_value(const ComputedWord* word,
                                                   const ComputedWord& of) {
  const double value = word == nullptr ? -1 : word->value.number;
  if (is_whole(value)) return static_cast<std::int64_t>(value);
  const ComputedWord& at_fault = word == nullptr ? of : *word;
  refuse(word == nullptr ? Code::subprogram_unknown : Code::value_invalid, at_fault.begin,
         std::string(line_.substr(at_fault.begin, at_fault.end - at_fault.begin))
             .append(word == nullptr ? " without P" : ""));
  return {};
}

bool GcodeFlow::has_words_left() const {
  return std::ranges::any_of(words_, [](const ComputedWord& word) {
    return word.kind == ComputedWord::Kind::address && !word.left_out;
  });
}

std::optional<GcodeFlow::ProgramCall> GcodeFlow::take_call(ComputedWord& word, std::string& flat) {
  ComputedWord* const number = word_of('P');
  ComputedWord* const times = word_of('L');
  const auto program = whole_value(number, word);
  const auto repetitions = times == nullptr ? 1 : whole_value(times, word);
  if (!program || !repetitions) return {};
  // These words start a subprogram elsewhere than at its beginning.
  for (const char letter : {'Q', 'H'}) {
    const ComputedWord* const other = word_of(letter);
    if (other == nullptr) continue;
    refuse(Code::value_invalid, other->begin,
           std::string(line_.substr(other->begin, other->end - other->begin))
               .append(reason::beside_m98));
    return {};
  }
  // K of an arc belongs to a motion.
  const bool moves = word_of('X') != nullptr || word_of('Y') != nullptr || word_of('Z') != nullptr;
  if (const ComputedWord* const other = word_of('K'); other != nullptr && !moves) {
    refuse(Code::value_invalid, other->begin,
           std::string(line_.substr(other->begin, other->end - other->begin))
               .append(reason::beside_m98_with_calls));
    return {};
  }
  word.left_out = number->left_out = true;
  if (times != nullptr) times->left_out = true;
  called_alone_ = !has_words_left();
  if (!called_alone_) write_line(flat);
  return ProgramCall{.number = *program,
                     .times = static_cast<std::uint64_t>(*repetitions),
                     .says_times = times != nullptr,
                     .begin = number->begin};
}

PointStyle GcodeFlow::style_of(char letter) const {
  if (grammar_.dialect != DialectName::fanuc) return PointStyle::as_whole;
  const bool alone = std::string_view("GMSTDHNLOP").find(letter) != std::string_view::npos;
  return alone ? PointStyle::as_whole : PointStyle::with_point;
}

// Rounding an end of a contour or of an arc would change values computed from it, and rounding
// errors of incremental positions would add up.
bool GcodeFlow::rounds_places() const {
  if (modes_.contour_open || modes_.incremental) return false;
  const auto says = [this](int first, int last) {
    return std::ranges::any_of(words_, [=](const ComputedWord& word) {
      return word.kind == ComputedWord::Kind::address && word.letter == 'G' &&
             word.value.number >= first && word.value.number < last + 1;
    });
  };
  const bool arc_in_force =
      modes_.motion == MotionKind::clockwise || modes_.motion == MotionKind::counter_clockwise;
  if (says(2, 3) || (arc_in_force && !says(0, 1))) return false;
  return !says(10, 10) && !says(20, 21) && !says(41, 42) && !says(70, 71) && !says(91, 91);
}

int GcodeFlow::decimals_of(const ComputedWord& word) const {
  int decimals = decimals_of(word.letter);
  const int digits = limits_of(dialect_of(grammar_.dialect), setup_).digits;
  if (digits > most_decimals) return decimals;
  while (decimals > 0 && std::abs(to_units(word.value.number, decimals)) >= units_per_one(digits))
    --decimals;
  return decimals;
}

int GcodeFlow::decimals_of(char letter) const {
  const bool is_place = std::string_view("XYZUVWABCQR").find(letter) != std::string_view::npos;
  // The digits of a feed that a control accepts: 1e-4 mm or 1e-6 inch a minute.
  if (letter == 'F' && grammar_.dialect == DialectName::fanuc)
    return modes_.unit == LengthUnit::inch ? 6 : 4;
  if (!is_place || !rounds_places()) return decimals_of_values;
  return std::clamp(
      setup_.decimals.value_or(default_decimals) + (modes_.unit == LengthUnit::inch ? 1 : 0), 0,
      decimals_of_values);
}

void GcodeFlow::write_as_it_is(std::string& flat) {
  is_as_written_ = true;
  flat.append(line_).append(line_end());
}

bool GcodeFlow::write_line(std::string& flat) {
  for (ComputedWord& word : words_) {
    const std::string_view text = line_.substr(word.begin, word.end - word.begin);
    if (word.kind != ComputedWord::Kind::comment || text.find('#') == std::string_view::npos)
      continue;
    word.instead = with_values(text);
    if (word.instead == text) word.instead.clear();
  }
  const bool changes = std::ranges::any_of(words_, [](const ComputedWord& word) {
    return word.computed || word.left_out || !word.instead.empty();
  });
  if (!changes) {
    write_as_it_is(flat);
    return true;
  }
  const bool is_left = std::ranges::any_of(words_, [](const ComputedWord& word) {
    return !word.left_out && word.kind != ComputedWord::Kind::skip;
  });
  if (!is_left) return true;
  const std::size_t begin = flat.size();
  flat.append(line_.substr(0, words_.front().begin));
  std::size_t behind = words_.front().begin;
  for (const ComputedWord& word : words_) {
    // A word left out takes the blanks before it along, the first word those after it.
    if (!word.left_out) {
      const bool is_first = flat.size() == begin + words_.front().begin;
      if (!is_first) flat.append(line_.substr(behind, word.begin - behind));
      if (word.computed) {
        flat.append(line_.substr(word.begin, line_[word.begin] == ',' ? 2 : 1));
        append_value(flat, word.value.number, style_of(word.letter), decimals_of(word));
      } else if (!word.instead.empty()) {
        flat.append(word.instead);
      } else {
        flat.append(line_.substr(word.begin, word.end - word.begin));
      }
    }
    behind = word.end;
  }
  flat.append(line_end());
  return true;
}

void GcodeFlow::write_call(std::string& flat, std::string_view name) {
  std::string text = "(";
  text.append(name).append(")");
  if (!called_alone_) {
    flat.append(text).append(line_end());
    return;
  }
  for (const ComputedWord& word : words_)
    if (word.kind == ComputedWord::Kind::comment)
      text.append(" ").append(with_values(line_.substr(word.begin, word.end - word.begin)));
  write_behind_number(flat, text);
}

void GcodeFlow::write_behind_number(std::string& flat, std::string_view text) {
  if (head_.number >= 0)
    flat.append(line_.substr(head_.number_begin, head_.number_end - head_.number_begin))
        .append(" ");
  flat.append(text).append(line_end());
}

bool GcodeFlow::finish_statement(std::string& flat, std::size_t at) {
  const std::size_t behind = behind_blanks(line_, at);
  if (!is_over(line_, behind))
    return refuse(Code::expression_invalid, behind,
                  name_of_character(line_.substr(behind)).append(reason::words_after_statement));
  if (const std::string comments = with_values(comments_of(line_, behind)); !comments.empty())
    write_behind_number(flat, comments);
  return true;
}

std::size_t GcodeFlow::without_end_of_tape(std::size_t begin, std::size_t end) const {
  std::size_t at = end;
  while (at > begin && is_over(texts_.front().line(at - 1), 0)) --at;
  return at > begin && is_percent(texts_.front().line(at - 1)) ? at - 1 : end;
}

std::size_t GcodeFlow::end_of_text_from(std::size_t percent) const {
  const ProgramText& text = texts_.front();
  std::size_t end = percent + 1;
  for (; end < text.size(); ++end) {
    const std::string_view line = text.line(end);
    const LineHead head = head_of(line);
    const bool is_label = head.number >= 0 && !is_over(line, head.behind);
    if (is_label || begins_program(line, head.behind)) break;
  }
  return end_of_plain_text(percent + 1, end);
}

void GcodeFlow::write_lines(std::string& flat, std::size_t begin, std::size_t end) {
  is_as_written_ = false;
  for (; begin < end; ++begin)
    flat.append(texts_.front().line(begin)).append(texts_.front().line_end(begin));
}

bool GcodeFlow::end_program(std::string& flat) {
  ended_ = true;
  const ProgramText& text = texts_.front();
  const std::size_t current = frames_.front().current;
  std::size_t from = std::max(written_behind_, current + 1);
  std::size_t last = text.size();
  for (std::size_t line = text.size(); last == text.size() && line-- > from;)
    if (is_percent(text.line(line))) last = line;
  // The program may have ended at its `%`.
  if (current < text.size() && is_percent(text.line(current))) {
    const std::size_t end = end_of_text_from(current);
    if (last == text.size() || without_end_of_tape(current, end) > current) {
      write_lines(flat, current, end);
      if (last < end) return true;
    }
  }
  if (last < text.size()) write_lines(flat, last, end_of_text_from(last));
  return true;
}

}  // namespace trc::program
