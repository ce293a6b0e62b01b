#pragma once

#include <span>

#include "core/messages/explanation.h"

namespace trc {

// The parts of explanations(), in the order of their codes.

// Words and functions that the program may not combine, or not while TRC is active: 20034 to 22158.
[[nodiscard]] std::span<const Explanation> explanations_of_words();
// Blocks whose geometry does not suit the tool, the selection or the control: 90008 to 90193.
[[nodiscard]] std::span<const Explanation> explanations_of_geometry();
// NC text and the rules of programs: 900001 to 900106.
[[nodiscard]] std::span<const Explanation> explanations_of_programs();
// Compensation: the contour from selection to deselection, and what of it is masked, 900201 to
// 900218.
[[nodiscard]] std::span<const Explanation> explanations_of_contour();
// Compensation: the tool, its radius and what else is taken as given, 900219 to 900236.
[[nodiscard]] std::span<const Explanation> explanations_of_tool();
// Programs that compute: from 900301.
[[nodiscard]] std::span<const Explanation> explanations_of_computing();

}  // namespace trc
