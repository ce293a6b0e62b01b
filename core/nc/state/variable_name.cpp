#include "core/nc/state/variable_name.h"

#include <algorithm>
#include <cstddef>

#include "core/nc/text/characters.h"

namespace trc {

std::string plain_variable_name(std::string_view spelling, DialectName dialect) {
  constexpr std::string_view left_out = "#<> \t";
  std::string plain;
  for (const char sign : spelling)
    if (left_out.find(sign) == std::string_view::npos) plain += upper(sign);
  std::string letter;
  if (dialect == DialectName::sinumerik && plain.starts_with('R')) letter = "R";
  std::string_view number = std::string_view(plain).substr(letter.size());
  if (!letter.empty() && number.starts_with('[') && number.ends_with(']'))
    number = number.substr(1, number.size() - 2);
  if (number.empty() || !std::ranges::all_of(number, is_digit)) return plain;
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size() - 1));
  return letter.append(number);
}

}  // namespace trc
