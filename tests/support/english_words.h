#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"
#include "core/messages/diagnostic_text.h"

namespace trc::support {

// The first word of a diagnostic's German text that only English has; empty: none. Words of
// programs are written in capitals, names and settings with underscores.
[[nodiscard]] inline std::string english_word_in_german(const Diagnostic& diagnostic) {
  constexpr auto english = std::to_array<std::string_view>(
      {"the",     "or",    "of",      "with",    "without", "not",    "has",  "have",    "perhaps",
       "unknown", "after", "before",  "that",    "which",   "and",    "to",   "line",    "while",
       "from",    "only",  "beside",  "between", "is",      "are",    "be",   "for",     "block",
       "blocks",  "tool",  "contour", "plane",   "word",    "motion", "than", "distance"});
  const std::string text = message_of(diagnostic, Language::german);
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c & 0x80) != 0;
  };
  for (std::size_t at = 0; at < text.size();) {
    if (!is_letter(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && is_letter(text[end])) ++end;
    const std::string word = text.substr(at, end - at);
    if (std::ranges::find(english, word) != english.end()) return word + " in: " + text;
    at = end;
  }
  return {};
}

}  // namespace trc::support
