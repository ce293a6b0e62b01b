#pragma once

#include <cstddef>
#include <string_view>

#include "core/nc/dialect/reading.h"

namespace trc {

// Behind the end subprograms stand: one that is called is no leftover.
bool enter_label_behind_end(Reading& reading, const ProgramLine& line);

// LBL 1 … LBL 0.
bool read_label(Reading& reading, ProgramLine& line, std::size_t begin, std::string_view statement);

// FN 9 … FN 12, IF: the program goes on elsewhere, so that neither what stands in front of the jump
// nor what stands behind it may be a contour (D-114).
bool copy_jump(Reading& reading, ProgramLine& line, std::size_t begin, std::string_view statement);

// CYCL DEF 14.1 CONTOUR LABEL 1/2, CONTOUR DEF P1 = LBL 1: cycles mill these contours, with RL and
// RR in them, so that they stay as they are.
bool take_labels_of_cycle(Reading& reading, const ProgramLine& line, std::size_t begin,
                          std::string_view statement);

}  // namespace trc
