#include "core/nc/dialect/apply_block.h"

#include <algorithm>
#include <utility>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/copied_block.h"
#include "core/nc/dialect/full_turns.h"
#include "core/nc/dialect/kept_modes.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_arcs.h"
#include "core/nc/dialect/sinumerik_leads.h"

// Carries out a block that has been read: modes, tool and radius, compensation, motion.

namespace trc {
namespace {

Side side_of(int g_number) {
  return g_number == 41 ? Side::left : g_number == 42 ? Side::right : Side::off;
}

Selection selection_of(int g_number) {
  switch (g_number) {
    case 138:
      return Selection::direct;
    case 236:
      return Selection::on_path;
    case 237:
      return Selection::perpendicular;
    case 238:
      return Selection::inside_corner;
    case 239:
      return Selection::without_block;
    default:
      return Selection::indirect;
  }
}

// Whether a copied line may move axes at the feed in force.
bool may_move_at_the_feed(const Reading& reading, const BlockWords& block) {
  using enum GGroup;
  if (!block.copied || block.isg.homes || block.has(dwell) || block.has(frame) ||
      block.has(zero_shift) || block.has(axis_technology) || block.has(tool_data))
    return false;
  if (block.has(single_move)) {
    // These always move at rapid. G53 and G153 do under G00; for the rest only the control knows.
    constexpr std::array always_rapid{27, 28, 29, 30, 60, 74, 75};
    const int number = block.of(single_move).function->number;
    const bool moves_as_g00_says = number == 53 || number == 153 || block.has(motion);
    return std::ranges::find(always_rapid, number) == always_rapid.end() &&
           !(moves_as_g00_says && reading.motion == MotionKind::rapid);
  }
  if (block.has(cycle) || reading.gcode.cycle) return true;
  return (block.axis || block.center || block.moves_unfollowed()) &&
         reading.motion != MotionKind::rapid;
}

// G92 shifts the axes it names. Controls differ in whether G53 acts in its own block only, so the
// end of its motion is unknown.
void forget_position(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  std::array<bool, 3> axes{};
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    axes[axis] = !block.axis || !block.of(GGroup::zero_shift).is(92) || block.move.end[axis];
  reading.state.forget_position(axes, line.source);
}

std::array<bool, 3> axes_of_bits(AxisBits bits) {
  std::array<bool, 3> axes{};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) axes[axis] = (bits >> axis & 1) != 0;
  return axes;
}

// Where the axes are after a copied line.
void follow_copied_axes(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  if (block.forget != 0) reading.state.forget_position(axes_of_bits(block.forget), line.source);
  if (block.without_value.axes != 0)
    reading.state.forget_position(axes_of_bits(block.without_value.axes), line.source,
                                  Unknown::without_value);  // D-168
}

bool apply_modes(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  if (block.has(motion)) {
    reading.motion = motion_of_function(block.of(motion).function->number);
    reading.motion_given = true;
  }
  if (block.has(unit)) {
    const LengthUnit lengths = reading.unit_of(*block.of(unit).function);
    if (!reading.say_unit(line, block.of(unit).begin, lengths)) return false;
    reading.count_in(line, lengths);
    reading.feed_in_mm =
        reading.dialect.name == DialectName::sinumerik && block.of(unit).function->number < 100;
  }
  if (block.has(dimension)) {
    const bool incremental = block.of(dimension).is(91);
    if (incremental && !reading.incremental) reading.state.count_increments_since(line.source);
    reading.incremental = incremental;
  }
  if (block.has(feed_mode)) {
    reading.feed_mode = block.of(feed_mode).function->number;
    reading.gcode.feed_mode_line = line.source.line;
  }
  if (block.feed) reading.feed = block.feed->value * reading.feed_unit(reading.unit);
  // Blocks cannot express a feed per tooth.
  if (block.tooth_feed) reading.feed = 0;
  if (block.has(circle_center)) {
    const GFunction& function = *block.of(circle_center).function;
    reading.state.set_absolute_center(function.number == 161 ||
                                      function.tenths() == tenths_of(90, 1));
  }
  if (block.has(circle_check)) reading.state.set_circle_correction(block.of(circle_check).is(165));
  if (block.has(zero_shift)) forget_position(reading, line, block);
  follow_copied_axes(reading, line, block);
  if (block.coordinates.sets_position) {
    std::array<std::optional<double>, 3> place = block.move.end;
    for (auto& coordinate : place)
      if (coordinate) *coordinate *= reading.length_unit();
    reading.state.set_position(place, line.source);
  }
  if (block.kept_modes) return apply_kept_modes(reading, line, block);
  if (!block.has(plane)) return true;
  reading.place(line, block.of(plane).begin);
  const int number = block.of(plane).function->number;
  return reading.state.set_plane(number == 17   ? Plane::xy
                                 : number == 18 ? Plane::zx
                                                : Plane::yz,
                                 line.source);
}

// The radius, as a number or as a tool.
bool apply_tool(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  const Source& source = line.source;
  const auto at = [&](std::uint32_t begin) { return reading.place(line, begin), true; };
  if (block.tools.radius && block.tools.radius->value != 0)
    reading.keep_length(line, "a tool radius");
  if (block.tools.allowance && block.tools.allowance->value != 0)
    reading.keep_length(line, "an allowance");
  if (block.tools.radius && at(block.tools.radius->begin)) {
    const double value = block.tools.radius->value * reading.length_unit();
    if (!(block.tools.radius_is_change ? reading.state.change_tool_radius(value, source)
                                       : reading.state.set_tool_radius(value, source)))
      return false;
  }
  if (block.tools.allowance && at(block.tools.allowance->begin) &&
      !reading.state.set_allowance_of_program(block.tools.allowance->value * reading.length_unit(),
                                              source))
    return false;
  if (block.tools.t_word)
    reading.state.prepare_tool(static_cast<std::int64_t>(block.tools.t_word->value),
                               reading.place_of_word(line, block.tools.t_word->begin));
  if (block.tools.loads && at(0) && !reading.state.load_tool(source)) return false;
  if (block.tools.only && at(*block.tools.only) &&
      !reading.state.call_tool(
          ToolRow(reading.state.setup().mode.tool_radius,
                  reading.state.tool().wear_of(reading.gcode.tools.only_register.value_or(0))),
          source))
    return false;
  const bool zero = block.tools.d_word && block.tools.d_word->value == 0 &&
                    reading.dialect.zero_is_a_radius && !reading.state.tool().row_of_tool(0);
  if (zero && at(block.tools.d_word->begin) && !reading.state.set_tool_radius(0, source))
    return false;
  return !block.tools.d_word || zero ||
         (at(block.tools.d_word->begin) &&
          reading.state.set_tool(static_cast<std::int64_t>(block.tools.d_word->value), source,
                                 reading.place_of_word(line, block.tools.d_word->begin)));
}

// Modes and radius come before the side, so that G41 starts with everything in its block.
bool apply_trc(Reading& reading, const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  const Source& source = line.source;
  const auto at = [&](std::uint32_t begin) { return reading.place(line, begin), true; };
  const auto has = [&](GGroup group) { return block.has(group) && at(block.of(group).begin); };

  if (has(transition) &&
      !reading.state.set_transition(block.of(transition).is(25) || block.of(transition).is(451)
                                        ? Transition::linear
                                        : Transition::circular,
                                    source))
    return false;
  if (has(masking) &&
      !reading.state.set_masking(block.of(masking).is(141) ? Masking::on : Masking::off, source))
    return false;
  if (block.masks && at(0) &&
      !(*block.masks ? leave_out_bottlenecks(reading, source)
                     : treat_bottlenecks_by_setup(reading, source)))
    return false;
  if (has(feed_adaptation) &&
      !reading.state.set_feed_adaptation(block.of(feed_adaptation).is(11) ? FeedAdaptation::on
                                         : block.of(feed_adaptation).is(by_name::feed_at_inside)
                                             ? FeedAdaptation::inside
                                             : FeedAdaptation::off,
                                         source))
    return false;
  if (block.isg.options && at(block.isg.command) &&
      !reading.state.set_options(*block.isg.options, source))
    return false;
  if (block.isg.tangfeed && at(block.isg.command) &&
      !reading.state.set_tangfeed_minimum(*block.isg.tangfeed * reading.length_unit(), source))
    return false;
  if (has(selection) &&
      !reading.state.set_selection(selection_of(block.of(selection).function->number), source))
    return false;
  // A smooth retraction follows the contour before it ends TRC.
  const bool ends = has(side) && block.deselects() && !block.soft.is_followed;
  if (has(tangential) && !reading.state.set_tangential(source)) return false;
  // The D word of such a block no longer belongs to the contour: D0 deselects its tool.
  if (ends && at(block.of(side).begin) && !reading.state.select(Side::off, source)) return false;
  if (!apply_tool(reading, line, block)) return false;
  if (!has(side) || block.deselects()) return true;
  reading.keep_length(line, "a contour");
  return reading.state.select(side_of(block.of(side).function->number), source);
}

// TRC cannot adapt a feed that blocks cannot express; on lines it adapts none.
bool check_feed_of_contour(Reading& reading, const ProgramLine& line, const BlockWords& block,
                           std::uint32_t begin) {
  if (reading.feed_mode == 94 && !reading.gcode.tooth_feed) return true;
  const bool isg = reading.dialect.name == DialectName::isg;
  const bool straight = reading.motion == MotionKind::linear || reading.motion == MotionKind::rapid;
  const bool line_alone = !isg && straight && !block.move.corner;
  const bool adapted = reading.state.mode().feed_adaptation != FeedAdaptation::off && !line_alone;
  if (reading.feed_mode != 93 && !adapted) return true;
  const std::string feed =
      reading.gcode.tooth_feed ? "FZ=" : "G" + std::to_string(reading.feed_mode);
  return reading.refuse(
      line, TextFault{.code = Code::nc_unsupported,
                      .begin = begin,
                      .detail = adapted ? feed + " with the feed at the contour (G11, CFC)"
                                        : feed + ", the time of a block, in force since line " +
                                              std::to_string(reading.gcode.feed_mode_line)});
}

// TURN= beside no arc, and I1= J1= K1= beside no CIP.
std::optional<std::uint32_t> word_of_no_arc(const Reading& reading, const BlockWords& block) {
  const bool moves = block.axis || block.center;
  const bool is_arc =
      reading.motion == MotionKind::clockwise || reading.motion == MotionKind::counter_clockwise;
  if (block.arc.turns && !(moves && is_arc)) return block.arc.turns->begin;
  for (const auto& between : block.arc.through)
    if (between && !(block.axis && block.arc.is_through)) return between->begin;
  return {};
}

bool apply_motion(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (block.copied) return true;
  if (reading.dialect.name == DialectName::sinumerik && (block.axis || block.center) &&
      !resolve_references(reading, line, block))
    return false;
  if (block.angle && !take_angle(reading, line, block)) return false;
  if (reading.gcode.tangent_arcs.in_force && block.axis && !take_tangent(reading, line, block))
    return false;
  const auto stray = reading.contour_open() ? word_of_no_arc(reading, block) : std::nullopt;
  if (stray)
    return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                          .begin = *stray,
                                          .detail = "a circle word without its arc"});
  if (block.soft.is_followed)
    return block.of(GGroup::soft_lead).function->number % 10 == 7
               ? approach_softly(reading, line, block)
               : depart_softly(reading, line, block);
  const bool axis_is_position = !block.has(GGroup::dwell) && !block.of(GGroup::zero_shift).is(92);
  if ((!block.axis || !axis_is_position) && !block.center) return true;
  const std::uint32_t begin = std::min(block.axis.value_or(~0U), block.center.value_or(~0U));
  reading.state.place(reading.place_of_word(line, begin).column,
                      block.center ? reading.place_of_word(line, *block.center).column : 0);
  if (!reading.motion_given && reading.state.contour_open())
    return reading.refuse(line, TextFault{.code = Code::motion_unknown, .begin = begin});
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto& center = block.move.center;
  const bool is_linuxcnc = reading.dialect.name == DialectName::linuxcnc;
  if (is_linuxcnc && reading.state.absolute_center() &&
      center[axes.first].has_value() != center[axes.second].has_value())
    return reading.refuse(line, TextFault{.code = Code::circle_incomplete,
                                          .begin = *block.center,
                                          .detail = "one centre word alone under G90.1"});
  if (reading.state.contour_open() && !check_feed_of_contour(reading, line, block, begin))
    return false;
  if (reading.gcode.soft.approach) return begin_contour_of_approach(reading, line, block);
  return block.arc.turns ? move_in_full_turns(reading, line, block)
                         : move(reading, line, block.move);
}

// From inch to mm.
void scale(const Reading& reading, MoveRequest& request) {
  const auto scale = [](std::optional<double>& value) {
    if (value) *value *= mm_per_inch;
  };
  for (auto& coordinate : request.end) scale(coordinate);
  for (auto& coordinate : request.center) scale(coordinate);
  scale(request.radius);
  if (request.corner) request.corner->size *= mm_per_inch;
  // U V W are linear axes. A B C are rotary: degrees do not scale with inches.
  const auto& names = reading.state.setup().tracking_axes;
  for (std::size_t axis = 0; axis < request.tracking.size(); ++axis)
    if (!names[axis].empty() &&
        std::string_view("UVWXYZ").find(names[axis][0]) != std::string_view::npos)
      scale(request.tracking[axis]);
}

}  // namespace

bool apply_block(Reading& reading, ProgramLine& line, BlockWords& block) {
  line.has_trc_words = line.has(WordRole::trc);
  const auto pass = [&](WordRole role) {
    return !line.has(role) || pass_words(reading, line, role);
  };
  block.soft.motion_before = reading.motion;
  block.soft.feed_before = reading.feed;
  const bool goes_on = apply_modes(reading, line, block) && apply_trc(reading, line, block) &&
                       leave_contour_by_copy(reading, line, block) && pass(WordRole::technology) &&
                       apply_motion(reading, line, block) && pass(WordRole::stop);
  if (!goes_on) return false;
  if (block.coordinates.sets_position) {
    line.third_set = block.move.end[axes_of(reading.state.mode().plane).third];
    if (line.third_set) *line.third_set *= reading.length_unit();
  }
  if (reading.feed_mode == 94 && may_move_at_the_feed(reading, block))
    line.feed_it_takes = reading.feed;
  if (block.of(GGroup::zero_shift).is(53)) forget_position(reading, line, block);
  if (!line.ends_program) return true;
  reading.ended = true;
  reading.state.place(0);
  return reading.state.end(line.source);
}

bool leave_out_bottlenecks(Reading& reading, const Source& source) {
  TrcOptions options = reading.state.mode().options;
  options.remove_masked_blocks = true;
  return reading.state.set_masking(Masking::on, source) &&
         reading.state.set_options(options, source);
}

bool treat_bottlenecks_by_setup(Reading& reading, const Source& source) {
  const TrcMode& initial = reading.state.setup().mode;
  TrcOptions options = reading.state.mode().options;
  options.remove_masked_blocks = initial.options.remove_masked_blocks;
  return reading.state.set_masking(initial.masking, source) &&
         reading.state.set_options(options, source);
}

bool move(Reading& reading, ProgramLine& line, MoveRequest& request) {
  request.source = line.source;
  request.kind = reading.motion;
  request.incremental = reading.incremental;
  request.feed = reading.feed_mode == 94 ? reading.feed : 0;
  if (reading.unit == LengthUnit::inch) scale(reading, request);
  // FANUC takes R if an arc has both R and I, J (D-126).
  if (reading.dialect.name == DialectName::fanuc && request.radius) request.center = {};
  // Many post-processors write all three centre words.
  auto& across = request.center[axes_of(reading.state.mode().plane).third];
  if (reading.dialect.name != DialectName::isg && across == 0.0) across.reset();
  const bool leads_on_an_arc =
      reading.dialect.arcs_to_the_contour && reading.state.awaits_approach() &&
      (reading.motion == MotionKind::clockwise || reading.motion == MotionKind::counter_clockwise);
  line.is_motion = true;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  if (request.end[axes.first] || request.end[axes.second])
    reading.gcode.leaves_contour = reading.state.contour_open();
  return leads_on_an_arc ? reading.state.approach_on_arc(request) : reading.state.move(request);
}

bool pass_words(Reading& reading, const ProgramLine& line, WordRole role) {
  std::string text;
  for (const WordRange& range : line.words) {
    if (range.role != role) continue;
    if (!text.empty()) text += ' ';
    text += line.word(range);
  }
  return reading.state.pass(line.source, std::move(text));
}

}  // namespace trc
