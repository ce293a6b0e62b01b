#pragma once

#include <cstddef>
#include <string_view>

#include "core/nc/dialect/reading.h"

namespace trc {

// Subprograms stand after the end of the program: a called label there still counts.
bool enter_label_behind_end(Reading& reading, const ProgramLine& line);

// LBL 1 … LBL 0.
bool read_label(Reading& reading, ProgramLine& line, std::size_t begin, std::string_view statement);

// FN 9 … FN 12, IF: the statement may jump, so that no contour may stand before the jump or after
// it (D-114).
bool copy_jump(Reading& reading, ProgramLine& line, std::size_t begin, std::string_view statement);

// CYCL DEF 14.1 CONTOUR LABEL 1/2, CONTOUR DEF P1 = LBL 1: cycles mill these contours, which
// contain RL and RR, so the contours stay as they are.
bool take_labels_of_cycle(Reading& reading, const ProgramLine& line, std::size_t begin,
                          std::string_view statement);

}  // namespace trc
