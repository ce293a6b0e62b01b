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

// The German of an English sentence: of those that match, the most specific one. The text in a gap
// may again be a sentence. A text that matches none stays as it is.
[[nodiscard]] std::string translated(std::string_view english,
                                     std::initializer_list<std::span<const Sentence>> tables);

}  // namespace trc
