#include "core/nc/dialect/block_skip.h"

#include <algorithm>
#include <array>

#include "core/nc/text/characters.h"
#include "core/nc/text/words.h"

namespace trc {
namespace {

std::size_t behind_digits(std::string_view line, std::size_t at) {
  return std::min(line.find_first_not_of("0123456789", at), line.size());
}

// N10; in Klartext the number alone.
std::size_t behind_number(std::string_view line, std::size_t at, DialectName dialect) {
  const std::size_t digits = at < line.size() && upper(line[at]) == 'N' ? at + 1 : at;
  const std::size_t end = behind_digits(line, digits);
  return end > digits && (digits > at || dialect == DialectName::heidenhain)
             ? behind_blanks(line, end)
             : at;
}

// Stops, spindle and coolant.
constexpr std::array<double, 12> functions_beside_the_path{0, 1, 3, 4, 5, 7, 8, 9, 10, 11, 13, 14};

}  // namespace

SkipSign skip_sign_of(std::string_view line, DialectName dialect) {
  const bool klartext = dialect == DialectName::heidenhain;
  const std::size_t begin = behind_number(line, behind_blanks(line, 0), dialect);
  if (begin >= line.size() || line[begin] != '/') return {};
  // In Klartext the digits are the block number.
  const std::size_t number = klartext ? begin + 1 : behind_digits(line, begin + 1);
  return {.begin = begin, .end = behind_blanks(line, number)};
}

SkipSign skip_sign_within(std::string_view line, DialectName dialect) {
  if (dialect != DialectName::fanuc || skip_sign_of(line, dialect).is_there()) return {};
  for (std::size_t at = 0; at < line.size() && line[at] != ';'; ++at) {
    if (line[at] == '(') at = std::min(line.find(')', at), line.size() - 1);
    if (line[at] == '/')
      return {.begin = at, .end = behind_blanks(line, behind_digits(line, at + 1))};
  }
  return {};
}

bool is_beside_the_path(std::string_view line, const SkipSign& sign, DialectName dialect) {
  const bool klartext = dialect == DialectName::heidenhain;
  std::size_t at = behind_number(line, sign.end, dialect);
  if (klartext && at < line.size() && upper(line[at]) == 'L' && blank_at_start(line.substr(at + 1)))
    at = behind_blanks(line, at + 1);
  while (at < line.size() && line[at] != '(' && line[at] != ';') {
    const char letter = upper(line[at]);
    double value = 0;
    bool whole = false;
    const std::size_t digits = read_number(line.substr(at + 1), value, whole);
    const bool passes =
        letter == 'S' || (letter == 'M' && std::ranges::find(functions_beside_the_path, value) !=
                                               functions_beside_the_path.end());
    if (digits == 0 || !passes) return false;
    at = behind_blanks(line, at + 1 + digits);
  }
  // More words may follow a comment in parentheses.
  const std::size_t close = at < line.size() && line[at] == '(' ? line.find(')', at) : line.size();
  return close == std::string_view::npos || close >= line.size() ||
         behind_blanks(line, close + 1) == line.size();
}

BlockSkip decided_about(std::string_view line, const ProgramSetup& setup, SkipSign& sign) {
  if (setup.block_skip == BlockSkip::refuse) return BlockSkip::refuse;
  sign = skip_sign_of(line, setup.dialect);
  if (!sign.is_there() || is_beside_the_path(line, sign, setup.dialect)) return BlockSkip::refuse;
  return setup.block_skip;
}

}  // namespace trc
