#include "core/nc/dialect/sinumerik_functions.h"

#include <algorithm>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/dialect/sinumerik_words.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/named_words.h"

// The functions that names alone and calls of Sinumerik stand for.

namespace trc {
namespace {

using enum GGroup;

// SUPA acts in one block, as G53 and G153 do.
constexpr GFunction suppression_name{
    .number = 153, .group = single_move, .meaning = "motion without any zero shift"};
constexpr GFunction around_the_corner{.number = 139, .group = selection};
constexpr GFunction straight_to_the_contour{.number = 138, .group = selection};
constexpr GFunction feed_at_contour{.number = 11, .group = feed_adaptation};
constexpr GFunction feed_at_center{.number = 10, .group = feed_adaptation};

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
      return stands_for(absolute ? by_name::absolute_frame : by_name::frame);
    }
    case SinumerikMeaning::unfollowed:
      block.coordinates.adds_to_frame = word.name == "ASCALE";
      return stands_for(word.name.ends_with("SCALE") ? by_name::scale : by_name::transformation);
    case SinumerikMeaning::spline:
      return stands_for(by_name::spline);
    case SinumerikMeaning::spatial:
      return stands_for(by_name::compensation_in_space);
    case SinumerikMeaning::spatial_end:
      if (reading.gcode.coordinates.is_unfollowed(by_name::compensation_in_space.tenths()))
        return stands_for(by_name::compensation_in_space_end);
      break;
    case SinumerikMeaning::suppression:
      return refuse_name(reading, line, word, "which suppresses TRC");
    case SinumerikMeaning::unfollowed_end:
      return stands_for(by_name::transformation_end);
    case SinumerikMeaning::single_move:
      return stands_for(suppression_name);
    case SinumerikMeaning::modal_cycle: {
      // Alone, MCALL ends the cycle.
      const bool ends = line.text.find('(', word.end) == std::string::npos;
      return stands_for(ends ? by_name::modal_cycle_end : by_name::modal_cycle);
    }
    case SinumerikMeaning::statement:
      return refuse_name(reading, line, word, "a statement");
    case SinumerikMeaning::turning:
      reading.gcode.seen.lathe = true;
      return reading.refuse(
          line, TextFault{.code = Code::turning, .begin = word.begin, .detail = word.name});
    case SinumerikMeaning::technology:
      break;
  }
  add(line, word, WordRole::technology);
  return true;
}

// The main axes among the arguments of GET(X,C) and the like, as axes or as machine axes, X1; all
// of them where an argument is no letter of an axis. `first_alone`: the others are axes that it
// follows.
AxisBits main_axes_of(std::string_view call, bool first_alone) {
  AxisBits found = 0;
  std::size_t at = call.find('(') + 1;
  while (at < call.size()) {
    const std::size_t end = std::min(call.find_first_of(",)", at), call.size());
    const std::string_view argument =
        without_blanks_behind(without_blanks_in_front(call.substr(at, end - at)));
    at = end + 1;
    const char letter = argument.empty() ? ' ' : upper(argument.front());
    const bool has_number = argument.size() > 1 &&
                            argument.find_first_not_of("0123456789", 1) == std::string_view::npos;
    if (is_letter(letter) && (argument.size() == 1 || has_number)) {
      if (letter >= 'X' && letter <= 'Z')
        found |= main_axis_bit(static_cast<std::size_t>(letter - 'X'));
    } else if (is_letter(letter) || letter == '_' || letter == '$') {
      found |= all_axes;
    }
    if (first_alone) break;
  }
  return found;
}

// D-174
bool read_axis_call(Reading& reading, SinumerikAxisCall effect, const NamedWord& word,
                    ProgramLine& line, BlockWords& block) {
  const std::string_view call = line.word({.begin = word.begin, .end = word.end});
  add(line, word, WordRole::technology);
  const bool displaces = effect == SinumerikAxisCall::displaces;
  const AxisBits axes = main_axes_of(call, !displaces);
  if (axes == 0) return true;
  const bool ends_nothing = effect == SinumerikAxisCall::uncouples &&
                            std::ranges::none_of(by_name::coupled_axis, [&](const auto& coupled) {
                              return reading.gcode.coordinates.is_unfollowed(coupled.tenths());
                            });
  if (ends_nothing) return true;
  if (reading.contour_open())
    return refuse_name(reading, line, word, "a call that changes an axis while TRC is active");
  if (displaces) {
    block.forget |= axes;
    return true;
  }
  const auto& functions =
      effect == SinumerikAxisCall::couples ? by_name::coupled_axis : by_name::coupled_axis_end;
  for (std::size_t axis = 0; axis < functions.size(); ++axis)
    if ((axes & main_axis_bit(axis)) != 0) block.set(functions[axis], word.begin);
  return true;
}

}  // namespace

bool calls_by_name(std::string_view name) { return name == "CALL" || name == "PCALL"; }

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
    block.arc.is_through = true;
    add(line, word, WordRole::motion);
    return true;
  }
  if (name == "CT") {
    block.arc.begins_tangents = true;
    add(line, word, WordRole::motion);
    return true;
  }
  if (name == "CFC") return read_as(feed_at_contour, word, line, block);
  if (name == "CFTCP") return read_as(feed_at_center, word, line, block);
  if (name == "CFIN") return read_as(by_name::feed_at_inside, word, line, block);
  if (name == "KONTC" || name == "KONTT")
    return refuse_name(reading, line, word, "an approach that goes on smoothly: NORM or KONT");
  // D-51. Without G41 and G42 the word has no effect and stays.
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
  if (reading.state.setup().copies_unknown_words)
    return read_as(by_name::unknown_name, word, line, block);
  return refuse_name(reading, line, word, calls_by_name(name) ? "a subprogram call" : "a name");
}

bool read_named_call(Reading& reading, const NamedWord& word, ProgramLine& line,
                     BlockWords& block) {
  ++block.words;
  if (const auto effect = axis_call_of_sinumerik(word.name))
    return read_axis_call(reading, *effect, word, line, block);
  const bool passes = is_passing_sinumerik_call(word.name);
  const bool is_cycle = is_sinumerik_cycle(word.name) && !passes;
  if (word.name == "TRAORI" || (is_cycle && word.name.starts_with("TRA")))
    return read_as(by_name::transformation, word, line, block);
  if (is_cycle && !block.has(cycle)) return read_as(by_name::cycle, word, line, block);
  if (!is_cycle && !passes && !reading.state.setup().pass_words.contains(word.name)) {
    block.calls_the_machine = true;
    return read_as(by_name::call, word, line, block);
  }
  add(line, word, WordRole::technology);
  return true;
}

}  // namespace trc
