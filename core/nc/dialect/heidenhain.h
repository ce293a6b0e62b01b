#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// `begin`: where in the line. Returns false.
bool refuse_klartext(Reading& reading, const ProgramLine& line, std::size_t begin,
                     std::string detail, Code code = Code::nc_unsupported);

// mm/min: programs in inch count F in tenths of an inch.
[[nodiscard]] inline double klartext_feed_unit(const Reading& reading) {
  return reading.unit == LengthUnit::inch ? mm_per_inch / 10 : 1;
}

// Whether the line is the rest of the numbered block above, in a list that breaks blocks where the
// screen of the control does.
[[nodiscard]] bool is_rest_of_klartext_block(std::string_view line);

// A block that is not plain (klartext_plain.h).
bool read_klartext(Reading& reading, ProgramLine& line);

// Whether the words of a block were read and may stand together.
enum class KlartextCheck : std::uint8_t { passed, failed };

// Applies the words of the block, unless the check failed.
bool take_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block, KlartextCheck check);

}  // namespace trc
