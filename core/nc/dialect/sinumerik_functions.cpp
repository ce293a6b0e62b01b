#include "core/nc/dialect/sinumerik_functions.h"

#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/dialect/sinumerik_words.h"
#include "core/nc/text/named_words.h"

// Names that stand alone and calls of Sinumerik: which function each stands for.

namespace trc {
namespace {

using enum GGroup;

constexpr GFunction absolute_frame_name{
    .number = absolute_frame, .group = frame, .meaning = "a frame"};
constexpr GFunction unfollowed_name{
    .number = 1001, .group = unfollowed, .meaning = "a transformation"};
constexpr GFunction scale_name{.number = 1006, .group = unfollowed, .meaning = "scaling"};
constexpr GFunction spline_name{
    .number = spline_interpolation, .group = unfollowed, .meaning = "a spline or a polynomial"};
constexpr GFunction spatial_name{
    .number = compensation_in_space, .group = unfollowed, .meaning = "TRC in space (CUT3D…)"};
constexpr GFunction unfollowed_end_name{.number = 1002, .group = unfollowed_end};
constexpr GFunction spatial_end_name{.number = 1014, .group = unfollowed_end};
constexpr GFunction single_name{
    .number = 1003, .group = single_move, .meaning = "a cycle or motion of its own"};
// SUPA, of one block as G53 and G153 are.
constexpr GFunction suppression_name{
    .number = 153, .group = single_move, .meaning = "motion without any zero shift"};
constexpr GFunction cycle_name{.number = 1004, .group = cycle, .meaning = "a modal cycle"};
constexpr GFunction around_the_corner{.number = 139, .group = selection};
constexpr GFunction straight_to_the_contour{.number = 138, .group = selection};
constexpr GFunction feed_at_contour{.number = 11, .group = feed_adaptation};
constexpr GFunction feed_at_inside_arcs{.number = feed_at_inside, .group = feed_adaptation};
constexpr GFunction feed_at_center{.number = 10, .group = feed_adaptation};
constexpr GFunction unknown_name{
    .number = 1007, .group = single_move, .meaning = "an unknown name"};
constexpr GFunction cycle_end_name{.number = 1005, .group = cycle_end};

bool refuse_name(Reading& reading, const ProgramLine& line, const NamedWord& word,
                 std::string_view why) {
  return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                        .begin = word.begin,
                                        .detail = std::string(word.name).append(", ").append(why)});
}

bool read_known_name(Reading& reading, SinumerikMeaning meaning, const NamedWord& word,
                     ProgramLine& line, BlockWords& block) {
  const auto stands_for = [&](const GFunction& function) {
    return read_as(function, word, line, block);
  };
  switch (meaning) {
    case SinumerikMeaning::frame: {
      const bool absolute = word.name == "TRANS" || word.name == "ROT" || word.name == "ROTS" ||
                            word.name == "MIRROR";
      return stands_for(absolute ? absolute_frame_name : frame_name);
    }
    case SinumerikMeaning::unfollowed:
      block.adds_to_frame = word.name == "ASCALE";
      return stands_for(word.name.ends_with("SCALE") ? scale_name : unfollowed_name);
    case SinumerikMeaning::spline:
      return stands_for(spline_name);
    case SinumerikMeaning::spatial:
      return stands_for(spatial_name);
    case SinumerikMeaning::spatial_end:
      if (reading.gcode_modes.is_unfollowed(compensation_in_space * 10))
        return stands_for(spatial_end_name);
      break;
    case SinumerikMeaning::unfollowed_end:
      return stands_for(unfollowed_end_name);
    case SinumerikMeaning::single_move:
      return stands_for(suppression_name);
    case SinumerikMeaning::modal_cycle: {
      // Alone it ends the cycle.
      const bool ends = line.text.find('(', word.end) == std::string::npos;
      return stands_for(ends ? cycle_end_name : cycle_name);
    }
    case SinumerikMeaning::statement:
      return refuse_name(reading, line, word, "a statement");
    case SinumerikMeaning::turning:
      reading.gcode_modes.turning = true;
      return reading.refuse(
          line, TextFault{.code = Code::turning, .begin = word.begin, .detail = word.name});
    case SinumerikMeaning::technology:
      break;
  }
  add(line, word, WordRole::technology);
  return true;
}

}  // namespace

bool read_as(const GFunction& function, const NamedWord& word, ProgramLine& line,
             BlockWords& block) {
  block.set(function, word.begin);
  add(line, word, WordRole::technology);
  return true;
}

bool read_name(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block) {
  ++block.words;
  const std::string& name = word.name;
  if (name == "CIP") {
    block.set(*reading.dialect.function(2), word.begin);
    block.is_through = true;
    add(line, word, WordRole::motion);
    return true;
  }
  if (name == "CT") {
    block.begins_tangent_arcs = true;
    add(line, word, WordRole::motion);
    return true;
  }
  if (name == "CFC") return read_as(feed_at_contour, word, line, block);
  if (name == "CFTCP") return read_as(feed_at_center, word, line, block);
  if (name == "CFIN") return read_as(feed_at_inside_arcs, word, line, block);
  if (name == "KONTC" || name == "KONTT")
    return refuse_name(reading, line, word, "an approach that goes on smoothly: NORM or KONT");
  // D-51. Without G41 and G42 the word says nothing: it stays.
  if (name == "KONT") return read_as(around_the_corner, word, line, block);
  if (name == "NORM") return read_as(straight_to_the_contour, word, line, block);
  if (name == "CDON" || name == "CDOF" || name == "CDOF2") {
    block.masks = name == "CDON";
    add(line, word, WordRole::technology);
    return true;
  }
  if (const auto meaning = meaning_of_sinumerik_name(name))
    return read_known_name(reading, *meaning, word, line, block);
  if (reading.state.setup().pass_words.contains(name)) {
    add(line, word, WordRole::technology);
    return true;
  }
  if (reading.state.setup().copies_unknown_words) return read_as(unknown_name, word, line, block);
  return refuse_name(reading, line, word, "a name");
}

bool read_named_call(Reading& reading, const NamedWord& word, ProgramLine& line,
                     BlockWords& block) {
  ++block.words;
  const bool passes = is_passing_sinumerik_call(word.name);
  const bool is_cycle = is_sinumerik_cycle(word.name) && !passes;
  if (word.name == "TRAORI" || (is_cycle && word.name.starts_with("TRA")))
    return read_as(unfollowed_name, word, line, block);
  if (is_cycle && !block.has(cycle)) return read_as(single_name, word, line, block);
  if (!is_cycle && !passes && !reading.state.setup().pass_words.contains(word.name)) {
    block.calls_the_machine = true;
    return read_as(call_name, word, line, block);
  }
  add(line, word, WordRole::technology);
  return true;
}

}  // namespace trc
