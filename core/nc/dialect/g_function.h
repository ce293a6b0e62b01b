#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace trc {

// Functions of one group exclude each other in one block; the group also says
// what the reader does with them.
enum class GGroup : std::uint8_t {
  motion,           // G00 … G03
  dwell,            // G04: the axis letter beside it is a time
  tangential,       // G05
  feed_adaptation,  // G10, G11
  plane,            // G17 … G19
  transition,       // G25, G26
  side,             // G40 … G42
  unit,             // G70, G71
  dimension,        // G90, G91
  selection,        // G138, G139, G236 … G239
  masking,          // G140, G141
  circle_center,    // G161, G162
  circle_check,     // G164, G165
  zero_shift,       // passes while TRC is off; the position is unknown afterwards
  feed_mode,        // passes; under G93 TRC cannot be active
  technology,       // passes, does not change the path
  axis_technology,  // as technology, but axis letters beside it are no positions
  spatial_circle,   // G303
  // Of other dialects than ISG, where a line may be copied while TRC is off although it is not
  // followed:
  cycle,           // modal: until `cycle_end` or a motion function each position is one of a cycle
  cycle_end,       // G80
  single_move,     // the axes of this line go where only the control knows: G28, G53, a cycle once
  frame,           // what coordinates mean changes; axis letters beside it are no positions
  soft_lead,       // G147 … G348 of Sinumerik: smooth approach and retraction, for its block
  soft_direction,  // G140 … G143: from which side
  soft_steps,      // G340, G341: how the third axis comes down
  tool_data,       // G10 of Fanuc: zero points or tool data, as its L says
  unfollowed,      // until `unfollowed_end` coordinates mean something else: polar, scaling
  unfollowed_end,
  turning,  // of lathes only
  call,     // subprograms and macros
  refused,  // changes the path in a way that is not followed here
};
inline constexpr std::size_t g_group_count = static_cast<std::size_t>(GGroup::refused) + 1;

// How functions with a number after the point are compared: 541 of G54.1.
[[nodiscard]] constexpr int tenths_of(int number, int tenth = 0) { return number * 10 + tenth; }

struct GFunction {
  std::int16_t number = 0;
  GGroup group = GGroup::refused;
  std::string_view meaning{};
  bool initial = false;    // holds before the first line
  std::int16_t tenth = 0;  // of G54.1: 1

  [[nodiscard]] constexpr int tenths() const { return tenths_of(number, tenth); }
};

// All functions known, in ascending order, those that are refused included.
[[nodiscard]] std::span<const GFunction> g_function_table();

// The name of a group in messages; for refused functions: what they do.
[[nodiscard]] std::string_view name_of(GGroup group);

// Null when there is no such function.
[[nodiscard]] const GFunction* find_g_function(double number);

}  // namespace trc
