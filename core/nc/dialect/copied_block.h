#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Checks what a copied line does after a deselection without motion.
bool leave_contour_by_copy(Reading& reading, const ProgramLine& line, const BlockWords& block);

// The pitch of a helix is not followed: while TRC is off the line is left to the control (D-87).
void copy_helix_with_pitch(const Reading& reading, ProgramLine& line, BlockWords& block);

// Decides whether the line is copied, and which axes are unknown after it.
bool copy_gcode_block(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
