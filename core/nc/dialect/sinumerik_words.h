#pragma once

#include "core/nc/text/gcode_words.h"
#include "core/nc/text/named_words.h"

// What the files of Sinumerik's words share.

namespace trc {

// A word of one letter, as the dialects of plain letters and numbers have it.
[[nodiscard]] inline GcodeWord as_gcode(const NamedWord& word) {
  return {.kind = GcodeWord::Kind::address,
          .letter = word.letter,
          .has_number = true,
          .whole = word.whole,
          .value = word.value,
          .begin = word.begin,
          .end = word.end};
}

}  // namespace trc
