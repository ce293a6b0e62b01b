#pragma once

#include <array>
#include <cstddef>

#include "core/nc/dialect/klartext_effects.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_line.h"

namespace trc {

// The statement as it stands, with the place where it begins.
bool copy_klartext(Reading& reading, ProgramLine& line, std::size_t begin, WordRole role);

// These hold from here on, and count for the labels that are open.
void take_klartext_effects(Reading& reading, const KlartextEffects& effects);

// What the line calls, or what calls it, may count on the pole.
void hand_on_klartext_pole(const Reading& reading, ProgramLine& line);

// Behind the line these axes stand where only the control knows: pole and tangent go with them.
void forget_klartext_position(Reading& reading, ProgramLine& line,
                              const std::array<bool, 3>& axes = {true, true, true});

// Everything that is no contour.
bool read_klartext_statement(Reading& reading, ProgramLine& line, std::size_t begin);

}  // namespace trc
