#pragma once

#include <numbers>

namespace trc {

inline constexpr double full_turn = 2 * std::numbers::pi;  // rad

}  // namespace trc
