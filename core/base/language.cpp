#include "core/base/language.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "core/base/ascii.h"

namespace trc {
namespace {

// 1 if no weight is given; 0 if it is not a valid number, so that the language is never chosen.
double weight_of(std::string_view parameters) {
  const std::size_t at = parameters.find("q=");
  if (at == std::string_view::npos) return 1;
  const std::string_view digits = trimmed(parameters.substr(at + 2));
  double weight = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), weight);
  return fault == std::errc{} && weight >= 0 && weight <= 1 ? weight : 0;
}

}  // namespace

std::optional<Language> language_of_tag(std::string_view tag) {
  const std::string first = in_lower_case(tag.substr(0, tag.find_first_of("-_.@")));
  if (first == "de") return Language::german;
  if (first == "en" || first == "c" || first == "posix") return Language::english;
  return std::nullopt;
}

Language accepted_language(std::string_view header) {
  Language best = Language::english;
  double best_weight = 0;
  while (!header.empty()) {
    const std::size_t end = std::min(header.find(','), header.size());
    const std::string_view one = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    const std::size_t tag_end = std::min(one.find(';'), one.size());
    const auto language = language_of_tag(trimmed(one.substr(0, tag_end)));
    const double weight = weight_of(one.substr(tag_end));
    if (!language || weight <= best_weight) continue;
    best = *language;
    best_weight = weight;
  }
  return best;
}

}  // namespace trc
