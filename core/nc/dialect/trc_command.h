#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/nc/state/trc_mode.h"
#include "core/nc/text/words.h"

namespace trc {

// One keyword of `#TRC [ … ]`, as a server documents it.
struct TrcKeyword {
  std::string_view name{};
  double smallest = 0;
  double largest = 0;
  double initial = 0;
  bool takes_value = true;
  std::string_view meaning{};
  std::string_view unit{};
  bool available = true;  // else known, but refused: 900102, INVERSE alone 22125
};

// All keywords, also those that are refused as not available (D-15).
[[nodiscard]] std::span<const TrcKeyword> trc_keywords();

// Reads `#TRC [KEY=value …]`, all of it from `#` to the end, into `options`; keys
// that are not named keep their value. The `=` may be missing (KEY<expr>), blanks
// and commas separate, groups may stand in brackets of their own, case does not
// matter.
//
// Returns what is wrong: 900003 (expression), 900004, 900005, 900008, 900009,
// 900010, 900102 (ONLINE, D-15). A STRETCH_FACTOR out of range is left to
// ProgramState (22007), a lone INVERSE too (22125).
[[nodiscard]] std::optional<TextFault> read_trc_command(std::string_view command,
                                                        TrcOptions& options);

// Reads `#TANGFEED [RMIN=value]` or `#SET TANGFEED RMIN [value]`, all of it from
// `#` to the end: the radius in the unit of the program; 0 when none is given.
[[nodiscard]] std::optional<TextFault> read_tangfeed_command(std::string_view command,
                                                             double& radius);

}  // namespace trc
