#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// With R beside them G36 to G39 are those of Fagor: a rounding, a tangential entry and exit, a
// chamfer. Elsewhere they measure, or have no R.
bool take_fagor_words(Reading& reading, ProgramLine& line, BlockWords& block);

// RNDM= rounds every corner. It must not stay modal in the output, or the control would round there
// again; so it has to begin and end within the contour.
bool take_modal_rounding(Reading& reading, ProgramLine& line, BlockWords& block);

// FRC= and FRCM=, the feed of a rounding or a chamfer, which becomes a block of its own. FRCM=
// holds for what comes after the contour as well: it stays.
bool take_corner_feed(Reading& reading, ProgramLine& line, BlockWords& block);

// While TRC is active the corner becomes blocks of its own, and its word is not written. Else the
// control makes it.
bool take_corner(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
