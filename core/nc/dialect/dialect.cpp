#include "core/nc/dialect/dialect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/nc/text/characters.h"

namespace trc {
namespace {

// The other dialects reach the contour as under G138: straight to the point beside its start.
const std::array<Dialect, 5>& dialects() {
  static const std::array<Dialect, 5> table{{
      {.name = DialectName::isg,
       .spelling = "isg",
       .words = ControlWords::isg,
       .functions = g_function_table(),
       .motion = MotionKind::rapid,
       .limits = {.characters = 4000}},
      {.name = DialectName::fanuc,
       .spelling = "fanuc",
       .functions = fanuc_functions(),
       .inch_function = 20,
       .selection = Selection::direct,
       .writes_points = true,
       .zero_is_a_radius = true,
       .limits = {.digits = 8}},
      {.name = DialectName::linuxcnc,
       .spelling = "linuxcnc",
       .functions = linuxcnc_functions(),
       .inch_function = 20,
       .selection = Selection::direct,
       .transition = Transition::circular,
       .tool_of_spindle = true,
       .zero_is_a_radius = true,
       .arcs_to_the_contour = true,
       .limits = {.characters = 255}},
      {.name = DialectName::sinumerik,
       .spelling = "sinumerik",
       .functions = sinumerik_functions(),
       .selection = Selection::direct,
       .transition = Transition::circular,
       .feed_adaptation = FeedAdaptation::on,
       .motion = MotionKind::linear,
       .limits = {.characters = 512}},
      {.name = DialectName::heidenhain,
       .spelling = "heidenhain",
       .words = ControlWords::klartext,
       .selection = Selection::direct,
       .transition = Transition::circular,
       .limits = {.decimals = 5}},
  }};
  return table;
}

// The text in capitals, without comments and leading blanks.
std::string words_of(std::string_view line) {
  std::string words;
  for (const char sign : line) {
    if (sign == '(' || sign == ';') break;
    if (words.empty() && (sign == ' ' || sign == '\t')) continue;
    words += upper(sign);
  }
  return words;
}

// The words of a line that begin with one letter, such as G or M functions.
class Functions {
 public:
  Functions(std::string_view words, char letter) {
    for (std::size_t at = 0; at < words.size(); ++at) {
      if (words[at] != letter || (at > 0 && is_letter(words[at - 1]))) continue;
      std::size_t begin = at + 1;
      while (begin + 1 < words.size() && words[begin] == '0' && is_digit(words[begin + 1])) ++begin;
      numbers_.push_back(words.substr(begin));
    }
  }

  // Whether one of the functions has this number.
  [[nodiscard]] bool have(std::string_view number) const {
    return std::ranges::any_of(numbers_, [&](std::string_view found) {
      if (!found.starts_with(number)) return false;
      found.remove_prefix(number.size());
      return found.empty() || (!is_digit(found[0]) && found[0] != '.');
    });
  }

 private:
  std::vector<std::string_view> numbers_;  // each with the rest of the line
};

bool starts_with_any(std::string_view words, std::initializer_list<std::string_view> beginnings) {
  return std::ranges::any_of(
      beginnings, [&](std::string_view beginning) { return words.starts_with(beginning); });
}

bool contains_any(std::string_view words, std::initializer_list<std::string_view> parts) {
  return std::ranges::any_of(
      parts, [&](std::string_view part) { return words.find(part) != std::string_view::npos; });
}

// R1 = -5, Z=R1: what Sinumerik has and no other dialect.
bool sets_or_reads_r_parameter(std::string_view words) {
  const auto is_digit_at = [&](std::size_t at) { return at < words.size() && is_digit(words[at]); };
  for (std::size_t at = words.find('R'); at != std::string_view::npos;
       at = words.find('R', at + 1)) {
    const bool begins_word = at == 0 || words[at - 1] == ' ' || words[at - 1] == '\t';
    if (!begins_word || !is_digit_at(at + 1)) continue;
    const std::size_t behind = words.find_first_not_of("0123456789", at + 1);
    const std::size_t sign = words.find_first_not_of(" \t", std::min(behind, words.size()));
    if (sign != std::string_view::npos && words[sign] == '=') return true;
  }
  for (std::size_t at = words.find("=R"); at != std::string_view::npos;
       at = words.find("=R", at + 1))
    if (is_digit_at(at + 2)) return true;
  return false;
}

}  // namespace

const Dialect& dialect_of(DialectName name) { return dialects()[static_cast<std::size_t>(name)]; }

LineLimits limits_of(const Dialect& dialect, const ProgramSetup& setup) {
  return setup.decimals ? LineLimits{.characters = dialect.limits.characters} : dialect.limits;
}

std::span<const Dialect> all_dialects() { return dialects(); }

std::optional<DialectName> dialect_spelled(std::string_view spelling) {
  for (const Dialect& dialect : dialects())
    if (std::ranges::equal(dialect.spelling, spelling, {}, upper, upper)) return dialect.name;
  return {};
}

void Dialect::begin(TrcMode& mode) const {
  mode.selection = selection;
  mode.transition = transition;
  mode.feed_adaptation = feed_adaptation;
}

const GFunction* Dialect::function(double number) const {
  // Computed numbers are not exact; G40.9999999 is no function.
  constexpr double rounding = 1e-9;
  const double tenths = number * 10;
  if (!(tenths >= 0 && tenths < 100'000) || std::abs(tenths - std::round(tenths)) > rounding)
    return nullptr;
  const int key = static_cast<int>(std::lround(tenths));
  const auto found = std::ranges::lower_bound(functions, key, {}, &GFunction::tenths);
  return found != functions.end() && found->tenths() == key ? &*found : nullptr;
}

bool is_heidenhain_iso(std::string_view line) {
  line = without_blanks_behind(without_blanks_in_front(line.substr(0, line.find(';'))));
  const bool begins =
      line.size() > 2 &&
      (line[0] == '%' ||
       (std::string_view("NGng").find(line[0]) != std::string_view::npos && is_digit(line[1])));
  return begins && line.back() == '*';
}

bool is_of_okuma(std::string_view line) {
  const std::string words = words_of(without_blanks_in_front(line));
  const bool is_name = words.starts_with('$') && without_blanks_behind(words).ends_with('%');
  return is_name || starts_with_any(words, {"CALL O", "MODIN O"}) ||
         contains_any(words, {"G15 H", "G15H"});
}

std::optional<DialectName> looks_like(std::string_view line) {
  if (is_heidenhain_iso(line) || is_of_okuma(line)) return {};
  const std::string words = words_of(line);
  const Functions preparatory(words, 'G');
  if (starts_with_any(words, {"BEGIN PGM", "TOOL CALL", "TOOL DEF", "CYCL DEF", "L X+", "L X-",
                              "CC X", "BLK FORM"}) ||
      contains_any(words,
                   {" BEGIN PGM", " TOOL CALL", " TOOL DEF", " CYCL DEF", " L X", " BLK FORM"}))
    return DialectName::heidenhain;
  if (sets_or_reads_r_parameter(words) ||
      starts_with_any(words, {"TRANS ", "ATRANS ", "PROC ", "DEF REAL", "DEF INT", "CYCLE", "MCALL",
                              "ROT ", "AROT ", "WORKPIECE", "EXTERN ", "EXTCALL", "SUPA", "MSG",
                              "STOPRE", "FFWON", "SOFT ", "BRISK"}) ||
      contains_any(words, {"CR=", "AC(", "IC(", " CYCLE", " TRANS ", "T=\"", " MCALL",
                           "DISCL=", "DISR=", "RND=", "CHF=", "CHR=", " SUPA", " EXTCALL"}) ||
      preparatory.have("700") || preparatory.have("710") || preparatory.have("642") ||
      preparatory.have("450") || preparatory.have("451"))
    return DialectName::sinumerik;
  // O100 SUB, O100 CALL
  const std::size_t keyword =
      words.starts_with('O') ? words.find_first_not_of("0123456789 \t", 1) : std::string::npos;
  if (keyword != std::string::npos && keyword > 1 &&
      starts_with_any(std::string_view(words).substr(keyword),
                      {"SUB", "ENDSUB", "CALL", "IF", "ELSE", "WHILE", "DO", "REPEAT", "RETURN"}))
    return DialectName::linuxcnc;
  if (preparatory.have("41.1") || preparatory.have("42.1") || preparatory.have("90.1") ||
      preparatory.have("91.1") || starts_with_any(words, {"O<", "#<"}))
    return DialectName::linuxcnc;
  // Smoothing with a tolerance.
  if (preparatory.have("64") && contains_any(words, {" P"})) return DialectName::linuxcnc;
  const bool numbered = words.size() > 1 && is_digit(words[1]);
  if (numbered && (words[0] == 'O' || words[0] == '#')) return DialectName::fanuc;
  for (const std::string_view function :
       {"20", "21", "28", "30", "43", "49", "54.1", "65", "73",  "80",  "81",  "82", "83",
        "84", "85", "86", "87", "88", "89", "98",   "99", "110", "154", "187", "53"})
    if (preparatory.have(function)) return DialectName::fanuc;
  const Functions auxiliary(words, 'M');
  for (const std::string_view function : {"97", "98", "99"})
    if (auxiliary.have(function)) return DialectName::fanuc;
  const bool axes = contains_any(words, {"X", "Y", "Z"});
  const bool data = contains_any(words, {"L", "P"});
  if (preparatory.have("10") && data) return DialectName::fanuc;
  if (preparatory.have("52") && axes) return DialectName::fanuc;
  return {};
}

}  // namespace trc
