#pragma once

#include <array>
#include <string>

#include "client/plot/picture.h"
#include "core/base/language.h"
#include "core/trc/result/compensated_block.h"

namespace trc::plot {

// The words of a picture in a language.
struct Words {
  std::array<const char*, layer_count> layers;    // in the order of Layer
  std::array<const char*, origin_count> origins;  // in the order of Origin
  const char* rapid;
  const char* tool;
  const char* tool_radius;
  const char* plane;
  const char* more_warnings;
  const char* more_notes;
  const char* error;
  const char* warning;
  const char* note;
  const char* in_line;
  const char* line;
  const char* block;
  const char* contour;
  const char* lead;
  const char* as_programmed;
  const char* changed;
  const char* not_travelled;
  const char* proposed_entry;
  const char* proposed_exit;
  const char* as_line;
  const char* as_quarter;
  const char* as_corner;
};
[[nodiscard]] const Words& words_in(Language language);

// "N40", or its line, or its number in the order of the program.
[[nodiscard]] std::string number_of(const Source& source, const Words& words);

}  // namespace trc::plot
