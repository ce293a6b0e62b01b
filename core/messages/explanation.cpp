#include "core/messages/explanation.h"

#include <algorithm>
#include <vector>

#include "core/messages/explanation_tables.h"
#include "core/messages/german.h"

namespace trc {
namespace {

std::vector<Explanation> all_parts() {
  std::vector<Explanation> all;
  for (const std::span<const Explanation> part :
       {explanations_of_words(), explanations_of_geometry(), explanations_of_programs(),
        explanations_of_contour(), explanations_of_tool(), explanations_of_computing()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::span<const Explanation> explanations() {
  // Joined at the first call; each part is a constant of its own file.
  static const std::vector<Explanation> all = all_parts();
  return all;
}

const Explanation* explanation_of(Code code) {
  const std::span<const Explanation> all = explanations();
  const auto found = std::ranges::lower_bound(all, code, {}, &Explanation::code);
  return found != all.end() && found->code == code ? &*found : nullptr;
}

std::string example_of(const Explanation& explanation) {
  const std::size_t at =
      explanation.repeated.empty() ? 0 : explanation.example.find(explanation.repeated);
  std::string program(explanation.example.substr(0, at));
  program.reserve(explanation.example.size() + explanation.repeated.size() * explanation.times);
  for (std::uint32_t i = 1; i < explanation.times; ++i) program += explanation.repeated;
  return program.append(explanation.example.substr(at));
}

std::string_view help_on_command_line(Code code, Language language) {
  const Explanation* explanation = explanation_of(code);
  if (explanation == nullptr) return {};
  return language == Language::german ? german_row_of(code).on_command_line
                                      : explanation->on_command_line;
}

}  // namespace trc
