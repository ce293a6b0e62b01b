#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/g_function.h"
#include "core/nc/text/gcode_words.h"
#include "core/nc/text/named_words.h"

// What the files of Sinumerik's words share.

namespace trc {

// The functions that names and calls stand for.
inline constexpr GFunction frame_name{.number = 1000, .group = GGroup::frame, .meaning = "a frame"};
inline constexpr GFunction call_name{
    .number = 1007, .group = GGroup::single_move, .meaning = "a call"};

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
