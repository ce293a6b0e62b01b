#pragma once

#include <cstdint>

namespace trc {

// The language a program is written in. It is declared, never guessed: the same word means
// something else in each of them.
enum class DialectName : std::uint8_t {
  isg,         // ISG kernel, TwinCAT
  fanuc,       // Fanuc, Haas, Mach, grbl and what posts call generic ISO
  linuxcnc,    // LinuxCNC and other descendants of RS274NGC
  sinumerik,   // Siemens 840D, 828D, ONE
  heidenhain,  // Klartext
};

}  // namespace trc
