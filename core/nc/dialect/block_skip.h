#pragma once

#include <cstddef>
#include <string_view>

#include "core/nc/state/program_setup.h"

namespace trc {

// The `/` of a line that a switch of the machine leaves out, with its number (`/2`) and the blanks
// after it: bytes [begin, end). Nothing stands before it but blanks and the number of the block.
struct SkipSign {
  std::size_t begin = 0;
  std::size_t end = 0;  // 0: the line has none

  [[nodiscard]] bool is_there() const { return end > 0; }
};

// Only stops, spindle and coolant follow it, so the switch does not matter.
[[nodiscard]] bool is_beside_the_path(std::string_view line, const SkipSign& sign,
                                      DialectName dialect);
// `X40 /M8` of Fanuc: what stands after the sign is left out, not the words before it.
[[nodiscard]] SkipSign skip_sign_within(std::string_view line, DialectName dialect);
[[nodiscard]] SkipSign skip_sign_of(std::string_view line, DialectName dialect);

// What the setup decides about the line, as a BlockSkip. `refuse`: nothing is decided, the line has
// no sign, or the sign stays because what follows does not affect the path (D-59).
[[nodiscard]] BlockSkip decided_about(std::string_view line, const ProgramSetup& setup,
                                      SkipSign& sign);

}  // namespace trc
