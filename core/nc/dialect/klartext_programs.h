#pragma once

#include <string>
#include <string_view>

#include "core/nc/state/program_setup.h"

namespace trc {

// The program that such a statement of Klartext names, in capitals, without its folder and its
// extension: CALL PGM, PGM CALL, SEL PGM, CYCL DEF 12.1 PGM. Empty: the statement names none.
[[nodiscard]] std::string program_called_by(std::string_view statement, std::string_view text);

// Whether the setup gives the text of that program and RL or RR stands in it.
[[nodiscard]] bool gives_contour_of(const ProgramSetup& setup, std::string_view program);

}  // namespace trc
