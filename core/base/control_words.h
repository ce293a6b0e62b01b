#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/language.h"

namespace trc {

enum class Code : std::int32_t;

// Whose words a program is written in. What is said of it names no word that its control does not
// have: FANUC knows neither G141 nor #TRC, Klartext has R0, RL and RR for G40, G41 and G42.
enum class ControlWords : std::uint8_t {
  isg,          // all words of the tables
  g_functions,  // G40, G41 and G42; what else ISG has as a word is a setting
  klartext,     // R0, RL and RR, and settings
};

// What the operator can do, in place of what the row of the code says; empty: that holds.
[[nodiscard]] std::string_view help_in(ControlWords words, Code code, Language language);

// The text with the words that the control has for those of G40, G41 and G42 that it names.
[[nodiscard]] std::string in_words_of(ControlWords words, std::string text);

}  // namespace trc
