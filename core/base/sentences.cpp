#include "core/base/sentences.h"

#include <optional>
#include <vector>

namespace trc {
namespace {

constexpr std::string_view gap = "{}";

// What stands in the gaps; nothing: the text is no such sentence.
std::optional<std::vector<std::string_view>> filled(std::string_view pattern,
                                                    std::string_view text) {
  std::vector<std::string_view> found;
  std::size_t at = pattern.find(gap);
  if (!text.starts_with(pattern.substr(0, at))) return std::nullopt;
  if (at == pattern.npos) return text == pattern ? std::optional(found) : std::nullopt;
  text.remove_prefix(at);
  while (at != pattern.npos) {
    pattern.remove_prefix(at + gap.size());
    at = pattern.find(gap);
    const std::string_view behind = pattern.substr(0, at);
    std::size_t end = text.size();
    if (at == pattern.npos) {
      if (!text.ends_with(behind)) return std::nullopt;
      end -= behind.size();
    } else {
      end = text.find(behind, 1);
    }
    if (end == text.npos || end == 0) return std::nullopt;
    found.push_back(text.substr(0, end));
    text.remove_prefix(end + behind.size());
  }
  return found;
}

// With the sentence that fits; nothing: none does.
std::optional<std::string> translated_by(const Sentence& row, std::string_view english,
                                         std::initializer_list<std::span<const Sentence>> tables) {
  const auto gaps = filled(row.english, english);
  if (!gaps) return std::nullopt;
  std::string text;
  std::string_view pattern = row.german;
  for (const std::string_view given : *gaps) {
    const std::size_t at = pattern.find(gap);
    text.append(pattern.substr(0, at)).append(translated(given, tables));
    pattern.remove_prefix(at + gap.size());
  }
  return text.append(pattern);
}

}  // namespace

std::string translated(std::string_view english,
                       std::initializer_list<std::span<const Sentence>> tables) {
  for (const std::span<const Sentence> table : tables)
    for (const Sentence& row : table)
      if (auto german = translated_by(row, english, tables)) return *std::move(german);
  return std::string(english);
}

}  // namespace trc
