#pragma once

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_state.h"

namespace trc {

// C, CP and CR.
bool move_on_klartext_arc(Reading& reading, ProgramLine& line, KlartextBlock& block,
                          MoveRequest& request);

// CT, CTP: the arc goes on where the motion before it has led.
bool move_on_tangent_arc(Reading& reading, ProgramLine& line, KlartextBlock& block,
                         MoveRequest& request);

}  // namespace trc
