#include "core/messages/sentences.h"

#include <optional>
#include <vector>

namespace trc {
namespace {

constexpr std::string_view gap = "{}";

// The texts in the gaps; nothing if the text does not match the pattern.
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

// The number of letters of a sentence without its gaps.
std::size_t size_of_words(const Sentence& row, std::size_t gaps) {
  return row.english.size() - gaps * gap.size();
}

}  // namespace

std::string translated(std::string_view english,
                       std::initializer_list<std::span<const Sentence>> tables) {
  // "{} programs" matches every sentence with this ending: the match with the most words counts.
  const Sentence* best = nullptr;
  std::vector<std::string_view> gaps;
  for (const std::span<const Sentence> table : tables)
    for (const Sentence& row : table) {
      auto found = filled(row.english, english);
      if (!found) continue;
      if (best != nullptr && size_of_words(row, found->size()) <= size_of_words(*best, gaps.size()))
        continue;
      best = &row;
      gaps = *std::move(found);
    }
  if (best == nullptr) return std::string(english);
  std::string text;
  std::string_view pattern = best->german;
  for (const std::string_view given : gaps) {
    const std::size_t at = pattern.find(gap);
    text.append(pattern.substr(0, at)).append(translated(given, tables));
    pattern.remove_prefix(at + gap.size());
  }
  return text.append(pattern);
}

}  // namespace trc
