#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/language.h"

namespace trc {

enum class Code : std::int32_t;

// The vocabulary of a program. Messages about it use no word that its control lacks: FANUC knows
// neither G141 nor #TRC, and Klartext has R0, RL and RR for G40, G41 and G42.
enum class ControlWords : std::uint8_t {
  isg,          // all words of the tables
  g_functions,  // G40, G41 and G42; what else ISG has as a word is a setting
  klartext,     // R0, RL and RR, and settings
};

// The remedy for these words, in place of that in the row of the code; empty: the row applies.
[[nodiscard]] std::string_view help_in(ControlWords words, Code code, Language language);

// The text with G40, G41 and G42 replaced by the words of the control.
[[nodiscard]] std::string in_words_of(ControlWords words, std::string text);

}  // namespace trc
