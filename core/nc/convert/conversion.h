#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/state/program_state.h"

namespace trc {

// A program in the words of another dialect.
struct ConvertedProgram {
  std::string text{};
  // A word that cannot be converted, with the first of its lines in the given text.
  struct Fault {
    std::string word{};
    std::uint32_t line = 0;
  };
  // At most 50, in the order of their lines; empty: the conversion has succeeded.
  std::vector<Fault> faults{};
};

// Writes a plain program anew in another dialect: motions with their feeds, absolute and in mm, M
// words up to M9 and M30, S, T with M6, comments. Functions that hold at the start anyway are left
// out. Everything else is a fault: it means something else there, or nothing.
//
// `setup` is what the program is read with; the program has no G41, G42 any more.
[[nodiscard]] ConvertedProgram convert_program(std::string_view program, const ProgramSetup& setup,
                                               DialectName to);

}  // namespace trc
