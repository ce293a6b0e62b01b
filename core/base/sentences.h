#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace trc {

// A sentence in two languages. A gap, {}, takes any text that is not empty. The order of gaps is
// the same in both.
struct Sentence {
  std::string_view english;
  std::string_view german;
};

// The German of an English sentence: of those that fit the one that says most. What stands in its
// gaps may be a sentence in turn. A text that is none stays as it is.
[[nodiscard]] std::string translated(std::string_view english,
                                     std::initializer_list<std::span<const Sentence>> tables);

}  // namespace trc
