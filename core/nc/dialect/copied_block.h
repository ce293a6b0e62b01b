#pragma once

#include <array>
#include <cstdint>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// What a copied line does behind a deselection without motion. In its output the axes it does not
// name stand beside the contour, by the tool radius away from where the program has them (D-74).
bool leave_contour_by_copy(Reading& reading, ProgramLine& line, const BlockWords& block);

// Before the tool cuts, each axis has to stand where the program has it, or be led there.
bool check_left_contour(Reading& reading, const ProgramLine& line, std::uint32_t begin,
                        const std::array<bool, 3>& named);

// The pitch of a helix is not followed: while TRC is off the control has it (D-87).
void copy_helix_with_pitch(const Reading& reading, ProgramLine& line, BlockWords& block);

// Decides whether the line is copied, and what is not known of the position behind it.
bool copy_gcode_block(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
