#include <algorithm>
#include <utility>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/interpreter.h"

// What a block does that has been read: modes, tool and radius, compensation, motion.

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

constexpr std::array<MotionKind, 4> motions{MotionKind::rapid, MotionKind::linear,
                                            MotionKind::clockwise, MotionKind::counter_clockwise};

}  // namespace

bool Interpreter::apply(ProgramLine& line, BlockWords& block) {
  line.has_trc_words = line.has(WordRole::trc);
  const auto pass = [&](WordRole role) { return !line.has(role) || pass_words(line, role); };
  block.motion_before = motion_;
  block.feed_before = feed_;
  const bool goes_on = apply_modes(line, block) && apply_trc(line, block) &&
                       leave_contour_by_copy(line, block) && pass(WordRole::technology) &&
                       apply_motion(line, block) && pass(WordRole::stop);
  if (!goes_on) return false;
  if (block.sets_position) {
    line.third_set = block.move.end[axes_of(state_.mode().plane).third];
    if (line.third_set) *line.third_set *= length_unit();
  }
  if (feed_mode_ == 94 && may_move_at_the_feed(block)) line.feed_it_takes = feed_;
  if (block.of(GGroup::zero_shift).is(53)) forget_position(line, block);
  if (!line.ends_program) return true;
  ended_ = true;
  state_.place(0);
  return state_.end(line.source);
}

// Of a line that is copied: what it moves counts on the feed in force.
bool Interpreter::may_move_at_the_feed(const BlockWords& block) const {
  using enum GGroup;
  if (!block.copied || block.homes || block.has(dwell) || block.has(frame) ||
      block.has(zero_shift) || block.has(axis_technology) || block.has(tool_data))
    return false;
  if (block.has(single_move)) {
    // Always rapid; rapid as G00 is in force; of the others only the control knows.
    constexpr std::array always_rapid{27, 28, 29, 30, 60, 74, 75};
    const int number = block.of(single_move).function->number;
    const bool moves_as_g00_says = number == 53 || number == 153 || block.has(motion);
    return std::ranges::find(always_rapid, number) == always_rapid.end() &&
           !(moves_as_g00_says && motion_ == MotionKind::rapid);
  }
  if (block.has(cycle) || code_.cycle) return true;
  return (block.axis || block.center || block.unfollowed_word) && motion_ != MotionKind::rapid;
}

bool Interpreter::apply_modes(const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  if (block.has(motion)) {
    motion_ = motions[static_cast<std::size_t>(block.of(motion).function->number)];
    motion_given_ = true;
  }
  if (block.has(unit)) {
    count_in(line, counts_in_inch(*block.of(unit).function));
    feed_in_mm_ = dialect_.name == DialectName::sinumerik && block.of(unit).function->number < 100;
  }
  if (block.has(dimension)) {
    const bool incremental = block.of(dimension).is(91);
    if (incremental && !incremental_) state_.count_increments_since(line.source);
    incremental_ = incremental;
  }
  if (block.has(feed_mode)) {
    feed_mode_ = block.of(feed_mode).function->number;
    code_.feed_mode_line = line.source.line;
  }
  if (block.feed) feed_ = block.feed->value * feed_unit(inch_);
  // A feed per tooth, which blocks have no number for.
  if (block.tooth_feed) feed_ = 0;
  if (block.has(circle_center)) {
    const GFunction& function = *block.of(circle_center).function;
    absolute_center_ = function.number == 161 || function.tenths() == 901;
    state_.set_absolute_center(absolute_center_);
  }
  if (block.has(circle_check)) state_.set_circle_correction(block.of(circle_check).is(165));
  if (block.has(zero_shift)) forget_position(line, block);
  if (block.forget != 0) {
    std::array<bool, 3> axes{};
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      axes[axis] = (block.forget >> axis & 1) != 0;
    state_.forget_position(axes, line.source);
  }
  if (block.sets_position) {
    std::array<std::optional<double>, 3> place = block.move.end;
    for (auto& coordinate : place)
      if (coordinate) *coordinate *= length_unit();
    state_.set_position(place, line.source);
  }
  if (block.kept_modes) return apply_kept_modes(line, block);
  if (!block.has(plane)) return true;
  place(line, block.of(plane).begin);
  const int number = block.of(plane).function->number;
  return state_.set_plane(number == 17   ? Plane::xy
                          : number == 18 ? Plane::zx
                                         : Plane::yz,
                          line.source);
}

// G92 shifts the axes it names. Controls differ in whether G53 holds for its own block only, so
// that the place its motion leads to is known to none of them.
void Interpreter::forget_position(const ProgramLine& line, const BlockWords& block) {
  std::array<bool, 3> axes{};
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    axes[axis] = !block.axis || !block.of(GGroup::zero_shift).is(92) || block.move.end[axis];
  state_.forget_position(axes, line.source);
}

// Modes and radius before the side, so that G41 begins with all of its block.
bool Interpreter::apply_trc(const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  const Source& source = line.source;
  const auto at = [&](std::uint32_t begin) { return place(line, begin), true; };
  const auto has = [&](GGroup group) { return block.has(group) && at(block.of(group).begin); };

  if (has(transition) &&
      !state_.set_transition(block.of(transition).is(25) || block.of(transition).is(451)
                                 ? Transition::linear
                                 : Transition::circular,
                             source))
    return false;
  if (has(masking) &&
      !state_.set_masking(block.of(masking).is(141) ? Masking::on : Masking::off, source))
    return false;
  if (block.masks && at(0) && !leave_out_bottlenecks(*block.masks, source)) return false;
  if (has(feed_adaptation) &&
      !state_.set_feed_adaptation(block.of(feed_adaptation).is(11) ? FeedAdaptation::on
                                  : block.of(feed_adaptation).is(feed_at_inside)
                                      ? FeedAdaptation::inside
                                      : FeedAdaptation::off,
                                  source))
    return false;
  if (block.options && at(block.command) && !state_.set_options(*block.options, source))
    return false;
  if (block.tangfeed && at(block.command) &&
      !state_.set_tangfeed_minimum(*block.tangfeed * length_unit(), source))
    return false;
  if (has(selection) &&
      !state_.set_selection(selection_of(block.of(selection).function->number), source))
    return false;
  // A smooth retraction runs along the contour before it ends TRC.
  const bool ends = has(side) && block.of(side).is(40) && !block.leads_softly;
  if (has(tangential) && !state_.set_tangential(source)) return false;
  // The tool of such a block is no longer one of the contour: D0 takes it out of force.
  if (ends && at(block.of(side).begin) && !state_.select(Side::off, source)) return false;
  if (!apply_tool(line, block)) return false;
  if (!has(side) || block.of(side).is(40)) return true;
  return state_.select(side_of(block.of(side).function->number), source);
}

// The radius, as a number or as a tool.
bool Interpreter::apply_tool(const ProgramLine& line, const BlockWords& block) {
  const Source& source = line.source;
  const auto at = [&](std::uint32_t begin) { return place(line, begin), true; };
  if (block.tool_radius && at(block.tool_radius->begin)) {
    const double value = block.tool_radius->value * length_unit();
    if (!(block.radius_is_change ? state_.change_tool_radius(value, source)
                                 : state_.set_tool_radius(value, source)))
      return false;
  }
  if (block.allowance && at(block.allowance->begin) &&
      !state_.set_allowance_of_program(block.allowance->value * length_unit(), source))
    return false;
  if (block.tool_number)
    state_.prepare_tool(static_cast<std::int64_t>(block.tool_number->value),
                        place_of_word(line, block.tool_number->begin));
  if (block.loads_tool && at(0) && !state_.load_tool(source)) return false;
  if (block.only_tool && at(*block.only_tool) &&
      !state_.call_tool(ToolRow(state_.setup().mode.tool_radius,
                                state_.tool().wear_of(code_.only_register.value_or(0))),
                        source))
    return false;
  const bool zero = block.tool && block.tool->value == 0 && dialect_.zero_is_a_radius &&
                    !state_.tool().row_of_tool(0);
  if (zero && at(block.tool->begin) && !state_.set_tool_radius(0, source)) return false;
  return !block.tool || zero ||
         (at(block.tool->begin) && state_.set_tool(static_cast<std::int64_t>(block.tool->value),
                                                   source, place_of_word(line, block.tool->begin)));
}

// CDON of Sinumerik, M120 of Heidenhain: G141 with REMOVE_MASKED_BLOCKS. Without them the setup
// decides.
bool Interpreter::leave_out_bottlenecks(bool on, const Source& source) {
  const TrcMode& initial = state_.setup().mode;
  TrcOptions options = state_.mode().options;
  options.remove_masked_blocks = on || initial.options.remove_masked_blocks;
  return state_.set_masking(on ? Masking::on : initial.masking, source) &&
         state_.set_options(options, source);
}

bool Interpreter::apply_motion(ProgramLine& line, BlockWords& block) {
  if (block.copied) return true;
  if (dialect_.name == DialectName::sinumerik && (block.axis || block.center) &&
      !resolve_references(line, block))
    return false;
  if (block.angle && !take_angle(line, block)) return false;
  if (code_.tangent_arcs && block.axis && !take_tangent(line, block)) return false;
  if (block.leads_softly)
    return block.of(GGroup::soft_lead).function->number % 10 == 7 ? approach_softly(line, block)
                                                                  : depart_softly(line, block);
  const bool axis_is_position = !block.has(GGroup::dwell) && !block.of(GGroup::zero_shift).is(92);
  if ((!block.axis || !axis_is_position) && !block.center) return true;
  const std::uint32_t begin = std::min(block.axis.value_or(~0U), block.center.value_or(~0U));
  state_.place(place_of_word(line, begin).column,
               block.center ? place_of_word(line, *block.center).column : 0);
  if (!motion_given_ && state_.contour_open())
    return refuse(line, TextFault{.code = Code::motion_unknown, .begin = begin});
  if (state_.contour_open() && !check_feed_of_contour(line, block, begin)) return false;
  if (code_.soft_approach) return begin_contour_of_approach(line, block);
  return block.turns ? move_in_full_turns(line, block) : move(line, block.move);
}

// Feeds that blocks have no number for cannot be adapted; on lines nothing is.
bool Interpreter::check_feed_of_contour(const ProgramLine& line, const BlockWords& block,
                                        std::uint32_t begin) {
  if (feed_mode_ == 94 && !code_.tooth_feed) return true;
  const bool isg = dialect_.name == DialectName::isg;
  const bool straight = motion_ == MotionKind::linear || motion_ == MotionKind::rapid;
  const bool line_alone = !isg && straight && !block.move.corner;
  const bool adapted = state_.mode().feed_adaptation != FeedAdaptation::off && !line_alone;
  if (feed_mode_ != 93 && !adapted) return true;
  const std::string feed = code_.tooth_feed ? "FZ=" : "G" + std::to_string(feed_mode_);
  return refuse(line,
                TextFault{.code = Code::nc_unsupported,
                          .begin = begin,
                          .detail = adapted ? feed + " with the feed at the contour (G11, CFC)"
                                            : feed + ", the time of a block, in force since line " +
                                                  std::to_string(code_.feed_mode_line)});
}

// The words of `request` are those of the line; the rest is in force.
bool Interpreter::move(ProgramLine& line, MoveRequest& request) {
  request.source = line.source;
  request.kind = motion_;
  request.incremental = incremental_;
  request.feed = feed_mode_ == 94 ? feed_ : 0;
  if (inch_) scale(request);
  // Of an arc of Fanuc that has both, R is what counts.
  if (dialect_.name == DialectName::fanuc && request.radius) request.center = {};
  // Many post-processors write all three centre words.
  auto& across = request.center[axes_of(state_.mode().plane).third];
  if (dialect_.name != DialectName::isg && across == 0.0) across.reset();
  const bool leads_on_an_arc =
      dialect_.arcs_to_the_contour && state_.awaits_approach() &&
      (motion_ == MotionKind::clockwise || motion_ == MotionKind::counter_clockwise);
  line.is_motion = true;
  const PlaneAxes axes = axes_of(state_.mode().plane);
  if (request.end[axes.first] || request.end[axes.second])
    code_.leaves_contour = state_.contour_open();
  return leads_on_an_arc ? state_.approach_on_arc(request) : state_.move(request);
}

// From inch to mm.
void Interpreter::scale(MoveRequest& request) const {
  const auto scale = [](std::optional<double>& value) {
    if (value) *value *= mm_per_inch;
  };
  for (auto& coordinate : request.end) scale(coordinate);
  for (auto& coordinate : request.center) scale(coordinate);
  scale(request.radius);
  if (request.corner) request.corner->size *= mm_per_inch;
  // U V W are linear axes, A B C turn: degrees have no inch.
  const auto& names = state_.setup().tracking_axes;
  for (std::size_t axis = 0; axis < request.tracking.size(); ++axis)
    if (!names[axis].empty() &&
        std::string_view("UVWXYZ").find(names[axis][0]) != std::string_view::npos)
      scale(request.tracking[axis]);
}

// The words of one role as one text, in their order.
bool Interpreter::pass_words(const ProgramLine& line, WordRole role) {
  std::string text;
  for (const WordRange& range : line.words) {
    if (range.role != role) continue;
    if (!text.empty()) text += ' ';
    text += line.word(range);
  }
  return state_.pass(line.source, std::move(text));
}

}  // namespace trc
