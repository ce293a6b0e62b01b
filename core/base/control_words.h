#pragma once

#include <cstdint>

namespace trc {

// The vocabulary of a program. Messages about it use no word that its control lacks: FANUC knows
// neither G141 nor #TRC, and Klartext has R0, RL and RR for G40, G41 and G42.
enum class ControlWords : std::uint8_t {
  isg,          // all words of the tables
  g_functions,  // G40, G41 and G42; what else ISG has as a word is a setting
  klartext,     // R0, RL and RR, and settings
};

}  // namespace trc
