#pragma once

#include <array>
#include <cstddef>

#include "core/nc/dialect/klartext_effects.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_line.h"

namespace trc {

// Copies the statement as it stands. `begin`: where it begins.
bool copy_klartext(Reading& reading, ProgramLine& line, std::size_t begin, WordRole role);

// Puts the effects in force and adds them to the labels that are open.
void take_klartext_effects(Reading& reading, const KlartextEffects& effects);

// The text that the line calls, or that calls it, may rely on the pole.
void hand_on_klartext_pole(const Reading& reading, ProgramLine& line);

// After the line the position on these axes is unknown; so are then the pole and the tangent.
void forget_klartext_position(Reading& reading, ProgramLine& line,
                              const std::array<bool, 3>& axes = {true, true, true});

// After the line only the control knows the pole.
void lose_klartext_pole(Reading& reading, const ProgramLine& line);

// Reads all statements that are not part of a contour.
bool read_klartext_statement(Reading& reading, ProgramLine& line, std::size_t begin);

}  // namespace trc
