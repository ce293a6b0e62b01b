#include "client/cli/table_text.h"

#include <charconv>
#include <cmath>

#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

// A finite number at the start of the text; `length` becomes its bytes.
std::optional<double> number_at(std::string_view text, std::size_t& length) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  double number = 0;
  const char* const begin = text.data() + sign;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) return {};
  length = static_cast<std::size_t>(end - text.data());
  return number;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> number_from(std::string_view text) {
  std::size_t length = 0;
  const auto number = number_at(text, length);
  return number && length == text.size() ? number : std::nullopt;
}

std::optional<std::uint32_t> tool_number(std::optional<double> number) {
  if (!number || *number < 0 || *number > 2147483647 || *number != std::floor(*number)) return {};
  return static_cast<std::uint32_t>(*number);
}

std::multimap<char, double> words_of(std::string_view line) {
  std::multimap<char, double> words;
  for (std::size_t at = 0; at < line.size();) {
    const char letter = in_upper_case(line.substr(at, 1))[0];
    if (letter == ';' || letter == '(') break;
    ++at;
    if (letter < 'A' || letter > 'Z') continue;
    std::size_t length = 0;
    const auto number = number_at(line.substr(at), length);
    if (!number) continue;
    words.emplace(letter, *number);
    at += length;
  }
  return words;
}

}  // namespace trc::cli
