#include "core/nc/dialect/sinumerik_leads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

// Smooth approach and retraction of Sinumerik: G147 … G348 with DISR=, DISCL= and FAD=. Programming
// manual of SINUMERIK ONE, 2.10.4: the tool comes from or goes to P0, the contour begins or ends at
// P4, and the lead itself lies between P3 and P4 (D-130).

namespace trc {
namespace {

using enum GGroup;

constexpr const char* words_alone = "beside none of G147, G148, G247, G248, G347, G348";

bool is_approach(int number) { return number % 10 == 7; }

bool check_soft_lead(Reading& reading, ProgramLine& line, const BlockWords& block) {
  const BlockWords::Function& lead = block.of(soft_lead);
  const std::string name = "G" + std::to_string(lead.function->number);
  const auto wrong = [&](std::uint32_t begin, const std::string& why) {
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported, .begin = begin, .detail = name + why});
  };
  const bool approaches = is_approach(lead.function->number);
  if (!approaches && !reading.trc_active())
    return wrong(lead.begin, " after G40: write both into one block");
  if (!approaches && !block.deselects())
    return wrong(lead.begin, " without G40: write G40 beside it");
  if (approaches && block.deselects()) return wrong(lead.begin, " beside G40");
  if (block.to_skip)
    return reading.refuse(line, TextFault{.code = Code::block_skip_undecided,
                                          .begin = lead.begin,
                                          .detail = name + " in a block that may be skipped"});
  if (block.center || block.corners.begin)
    return wrong(lead.begin, " beside words of an arc, a rounding or a chamfer");
  if (reading.feed_mode != 94 || block.has(feed_mode))
    return wrong(lead.begin, " beside or after G93, G95: only feeds per minute are followed");
  if (block.soft.way_back)
    return wrong(*block.soft.way_back,
                 " with DISRP=, the plane it returns to: program that height "
                 "in blocks of its own");
  const bool straight = lead.function->number < 200;
  if (!block.soft.length || (!straight && !(block.soft.length->value > 0)))
    return wrong(block.soft.length ? block.soft.length->begin : lead.begin,
                 straight ? " without DISR=, its length" : " without DISR=, its radius, above 0");
  if (block.soft.feed && !reading.state.is_feed(block.soft.feed->value))
    return wrong(block.soft.feed->begin, " with FAD= that is no feed");
  if (block.soft.clearance && !block.soft.clearance_is_absolute && block.soft.clearance->value < 0)
    return wrong(block.soft.clearance->begin, " with DISCL= below 0");
  return true;
}

Lead soft_lead_of(const Reading& reading, const BlockWords& block) {
  const int number = block.of(soft_lead).function->number;
  const double length = block.soft.length->value * reading.length_unit();
  if (number < 200) return {.form = Lead::Form::tangent, .length = length, .from_edge = true};
  const bool left = reading.state.mode().side == Side::left;
  const bool other_side = (reading.gcode.soft.direction == 141 && !left) ||
                          (reading.gcode.soft.direction == 142 && left);
  return {.form = Lead::Form::arc,
          .radius = other_side ? -length : length,
          .angle = number > 300 ? std::numbers::pi : std::numbers::pi / 2,
          .bends_to_tool = reading.gcode.soft.direction == 143};
}

// DISCL= in a block that leads to or from a contour.
std::optional<SoftClearance> clearance_of(const Reading& reading, const BlockWords& block) {
  if (!block.soft.clearance) return {};
  return SoftClearance{.distance = block.soft.clearance->value * reading.length_unit(),
                       .absolute = block.soft.clearance_is_absolute};
}

// The height of the third axis under DISCL=, between the height `plane` of the contour and the
// height `away` from which it comes or to which it goes. Empty if it is not between them: controls
// refuse that too.
std::optional<double> height_of(const std::optional<SoftClearance>& clearance, double plane,
                                double away) {
  if (!clearance) return plane;
  const double height = clearance->absolute ? clearance->distance
                        : away < plane      ? plane - clearance->distance
                                            : plane + clearance->distance;
  const bool between = (height - plane) * (away - height) >= -1e-9;
  return between ? std::optional(height) : std::nullopt;
}

bool refuse_clearance(Reading& reading, const ProgramLine& line, std::uint32_t begin) {
  return reading.refuse(
      line, TextFault{.code = Code::nc_unsupported,
                      .begin = begin,
                      .detail = "DISCL= that is not between the plane of the contour and "
                                "where the tool comes from or goes to"});
}

// The ends of the named axes, absolute and in mm.
bool find_soft_end(Reading& reading, const ProgramLine& line, const BlockWords& block,
                   std::array<std::optional<double>, 3>& end) {
  for (std::size_t axis = 0; axis < end.size(); ++axis) {
    if (!block.move.end[axis]) continue;
    if (reading.incremental && !reading.state.is_known(axis))
      return reading.refuse(line,
                            TextFault{.code = Code::position_unknown,
                                      .begin = *block.axis,
                                      .detail = std::string(1, static_cast<char>('X' + axis))});
    end[axis] = *block.move.end[axis] * reading.length_unit() +
                (reading.incremental ? reading.state.position()[axis] : 0);
  }
  return true;
}

}  // namespace

bool read_soft_word(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block) {
  const auto refused = [&](Code code, std::string_view why) {
    return reading.refuse(
        line, TextFault{.code = code,
                        .begin = word.begin,
                        .detail = std::string(line.word({.begin = word.begin, .end = word.end}))
                                      .append(", ")
                                      .append(why)});
  };
  const bool clearance = word.name == "DISCL";
  if (word.reference != NamedWord::Reference::modal && word.name != "DISRP" &&
      !(clearance && word.reference == NamedWord::Reference::absolute))
    return refused(Code::nc_unsupported, "a reference that it cannot have");
  if (word.name == "DISRP") {
    block.soft.way_back = word.begin;
  } else {
    auto& target = clearance             ? block.soft.clearance
                   : word.name == "DISR" ? block.soft.length
                                         : block.soft.feed;
    if (target) return refused(Code::nc_word_twice, "a second time");
    target = {.value = word.value, .begin = word.begin};
    if (clearance)
      block.soft.clearance_is_absolute = word.reference == NamedWord::Reference::absolute;
  }
  line.words.push_back({.begin = word.begin, .end = word.end, .role = WordRole::technology});
  return true;
}

bool take_soft_lead(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (block.has(soft_direction))
    reading.gcode.soft.direction = block.of(soft_direction).function->number;
  if (block.has(soft_steps)) reading.gcode.soft.in_space = block.of(soft_steps).is(340);
  const BlockWords::Function& lead = block.of(soft_lead);
  const bool selects = block.selects();
  if (!block.has(soft_lead)) {
    for (const auto& word : {block.soft.length, block.soft.clearance, block.soft.feed})
      if (word && (selects || reading.contour_open()))
        return reading.refuse(
            line, TextFault{.code = Code::nc_unsupported,
                            .begin = word->begin,
                            .detail = std::string("DISR=, DISCL= or FAD= ").append(words_alone)});
    if (reading.gcode.soft.approach && reading.faults.empty() && block.has(side))
      return reading.refuse(
          line, TextFault{.code = Code::nc_unsupported,
                          .begin = block.of(side).begin,
                          .detail = "G40 … G42 between a smooth approach and its contour"});
    return true;
  }
  const bool approaches = is_approach(lead.function->number);
  block.soft.is_followed = approaches ? selects || reading.trc_active() : reading.trc_active();
  if (!block.soft.is_followed && !reading.contour_open()) {
    // Only the control knows the end of this lead: its contour is not compensated here.
    block.functions[static_cast<std::size_t>(single_move)] = lead;
    return true;
  }
  if (!check_soft_lead(reading, line, block)) return false;
  for (WordRange& word : line.words)
    for (const auto& mine : {std::optional(BlockWords::Value{.begin = lead.begin}),
                             block.soft.length, block.soft.clearance, block.soft.feed})
      if (mine && word.begin == mine->begin) word.role = WordRole::trc;
  return true;
}

bool approach_softly(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (!reading.state.awaits_approach() || reading.gcode.soft.approach)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.of(soft_lead).begin,
                        .detail = "a smooth approach within a contour or after another"});
  SoftApproach approach{.lead = soft_lead_of(reading, block),
                        .clearance = clearance_of(reading, block),
                        .along_the_lead = reading.gcode.soft.in_space,
                        .rapid = block.soft.motion_before == MotionKind::rapid,
                        .feed_before = block.soft.feed_before};
  if (block.soft.feed) approach.feed = block.soft.feed->value * reading.feed_unit(reading.unit);
  std::array<std::optional<double>, 3> end{};
  if (!find_soft_end(reading, line, block, end)) return false;
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  approach.height = end[axes.third];
  reading.gcode.soft.approach = approach;
  if (end[axes.first] || end[axes.second]) return begin_contour_of_approach(reading, line, block);
  reading.reads_plain_lines = false;
  return true;
}

bool begin_contour_of_approach(Reading& reading, ProgramLine& line, BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  const auto wrong = [&](const char* why, Code code = Code::nc_unsupported) {
    return reading.refuse(
        line, TextFault{.code = code,
                        .begin = std::min(block.axis.value_or(~0U), block.center.value_or(~0U)),
                        .detail = std::string("the end of a smooth approach ") + why});
  };
  if (!block.move.end[axes.first] && !block.move.end[axes.second])
    return wrong("in a block without an axis of the plane");
  const bool circle =
      reading.motion == MotionKind::clockwise || reading.motion == MotionKind::counter_clockwise;
  const bool corner = block.move.corner && !block.move.corner->modal;
  if ((circle && !block.soft.is_followed) || block.center || corner || !block.move.tracking.empty())
    return wrong("in an arc, beside a corner or a further axis");
  MoveRequest request{.source = line.source, .kind = MotionKind::linear, .feed = reading.feed};
  if (!find_soft_end(reading, line, block, request.end)) return false;
  const SoftApproach approach = *reading.gcode.soft.approach;
  auto& height = request.end[axes.third];
  if (!height) height = approach.height;
  const bool moves_across = height || approach.clearance;
  if (moves_across && !reading.state.is_known(axes.third))
    return wrong("from a height that is not known", Code::position_unknown);
  const double from = reading.state.position()[axes.third];
  const auto quick = height_of(approach.clearance, height.value_or(from), from);
  if (!quick) return refuse_clearance(reading, line, begin_of_words(line));
  MoveRequest way = request;
  way.kind = approach.rapid ? MotionKind::rapid : MotionKind::linear;
  way.feed = approach.feed_before;
  Infeed infeed{.height = *quick, .along_the_lead = approach.along_the_lead, .feed = reading.feed};
  if (approach.feed != 0) (infeed.along_the_lead ? request.feed : infeed.feed) = approach.feed;
  reading.gcode.soft.approach.reset();
  line.is_motion = true;
  return reading.state.approach_by(approach.lead, request, way, infeed);
}

bool depart_softly(Reading& reading, ProgramLine& line, BlockWords& block) {
  const PlaneAxes axes = axes_of(reading.state.mode().plane);
  std::array<std::optional<double>, 3> end{};
  if (!find_soft_end(reading, line, block, end)) return false;
  const Lead lead = soft_lead_of(reading, block);
  const bool in_plane = end[axes.first] || end[axes.second];
  const auto wrong = [&](std::uint32_t begin, const char* why) {
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported, .begin = begin, .detail = std::string(why)});
  };
  if (lead.bends_to_tool && !in_plane)
    return wrong(block.of(soft_lead).begin, "G143 without an end in the plane: G140, G141 or G142");
  const auto clearance = clearance_of(reading, block);
  if (clearance && in_plane && !end[axes.third])
    return wrong(block.soft.clearance->begin, "DISCL= without the height it retracts to");
  const double plane = reading.state.position()[axes.third];
  // Without a programmed height the retraction ends at the height of DISCL=.
  const auto quick = height_of(clearance, plane, end[axes.third].value_or(HUGE_VAL));
  if (!quick) return refuse_clearance(reading, line, block.soft.clearance->begin);
  const double slow = block.soft.feed_before;
  const double infeed = block.soft.feed ? block.soft.feed->value * reading.feed_unit(reading.unit)
                                        : block.soft.feed_before;
  MoveRequest step{.source = line.source, .kind = MotionKind::linear, .feed = slow};
  if (reading.gcode.soft.in_space && block.soft.feed) step.feed = infeed;
  // The side to which the arc bends may depend on the end of the retraction.
  step.end[axes.first] = end[axes.first];
  step.end[axes.second] = end[axes.second];
  if (reading.gcode.soft.in_space) step.end[axes.third] = *quick;
  line.is_motion = true;
  const Climb climb = reading.gcode.soft.in_space ? Climb::along_the_lead : Climb::behind_the_lead;
  if (!reading.state.depart_by(lead, step, climb)) return false;
  const auto travel = [&](const std::array<std::optional<double>, 3>& to) {
    const Position& here = reading.state.position();
    bool moves = false;
    for (std::size_t axis = 0; axis < to.size(); ++axis)
      moves |= to[axis] && *to[axis] != here[axis];
    step.end = to;
    return !moves || reading.state.move(step);
  };
  const auto across = [&](const std::optional<double>& height) {
    std::array<std::optional<double>, 3> to{};
    to[axes.third] = height;
    return to;
  };
  step.feed = infeed;
  if (!travel(across(*quick))) return false;
  step.kind = reading.motion == MotionKind::rapid ? MotionKind::rapid : MotionKind::linear;
  step.feed = reading.feed;
  if (!travel(across(end[axes.third]))) return false;
  end[axes.third].reset();
  return travel(end);
}

}  // namespace trc
