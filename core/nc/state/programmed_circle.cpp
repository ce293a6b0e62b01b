#include <cmath>
#include <utility>

#include "core/nc/state/circle_words.h"
#include "core/nc/state/program_state.h"

// The arc that a request asks for, or why it is refused.

namespace trc {
namespace {

constexpr std::array<const char*, 3> center_words{"I", "J", "K"};

}  // namespace

std::optional<Refusal> ProgramState::check_circle_words(const MoveRequest& request) const {
  if (displaced_)
    return Refusal{
        .code = Code::circle_center_misfit,
        .detail =
            "an arc directly after G40 under G239, where the tool stands at the compensated point",
        .point = standing_point()};
  const PlaneAxes axes = axes_of(mode_.plane);
  // 0 is no pitch, nor a centre that lies elsewhere (D-87).
  if (request.center[axes.third].value_or(0) != 0)
    return Refusal{.code = Code::nc_unsupported, .detail = center_words[axes.third]};
  const bool has_center = request.center[axes.first] || request.center[axes.second];
  if (has_center && request.radius) return Refusal{.code = Code::center_and_radius_together};
  if (!has_center && !request.radius)
    // With G164 the reference control uses the start point as the missing centre.
    return Refusal{.code =
                       circle_.correct_center ? Code::circle_incomplete : Code::circle_radius_zero};
  if (request.radius && !std::isfinite(*request.radius))
    return Refusal{.code = Code::field_invalid, .detail = "R"};
  return {};
}

Point ProgramState::center_of(const MoveRequest& request, const Point& start, bool absolute) const {
  const PlaneAxes axes = axes_of(mode_.plane);
  const Point base = absolute ? Point::Zero() : start;
  const Point missing = absolute ? start : Point::Zero();
  return base + Point(request.center[axes.first].value_or(missing.x()),
                      request.center[axes.second].value_or(missing.y()));
}

Refusal ProgramState::misfit(CircleFault&& fault, const MoveRequest& request,
                             const CircleEnds& ends) const {
  Refusal refusal{.code = fault.code, .values = std::move(fault.values), .point = standing_point()};
  if (refusal.code != Code::circle_center_misfit) return refusal;
  const bool klartext = setup_.dialect == DialectName::heidenhain;
  std::optional<Point> center;
  if (!request.radius) center = center_of(request, ends.start, absolute_center_);
  refusal.detail =
      told_circle(ends, center,
                  {.plane = mode_.plane,
                   .absolute_center = absolute_center_,
                   .klartext = klartext,
                   .unit = circle_.last_digit == last_digit(LengthUnit::inch) ? LengthUnit::inch
                                                                              : LengthUnit::mm});
  if (!center || klartext) return refusal;
  const CircleResult other = arc_about(center_of(request, ends.start, !absolute_center_), ends,
                                       circle_, use_of_arcs(), tolerances_);
  if (std::holds_alternative<Arc>(other))
    refusal.detail += absolute_center_ ? ", which fits where they count from the start"
                                       : ", which fits where they are absolute";
  return refusal;
}

std::optional<Refusal> ProgramState::circle(const MoveRequest& request, const Position& end,
                                            ProgrammedCircle& programmed) const {
  if (auto refusal = check_circle_words(request)) return refusal;
  const CircleEnds ends{.start = to_plane(mode_.plane, position_),
                        .end = to_plane(mode_.plane, end),
                        .clockwise = request.kind == MotionKind::clockwise};
  const auto too_large = [&](const Point& point) {
    return !(point.cwiseAbs().maxCoeff() <= tolerances_.largest_coordinate);
  };
  Point center = Point::Zero();
  if (!request.radius) {
    center = center_of(request, ends.start, absolute_center_);
    if (too_large(center))
      return Refusal{.code = center.allFinite() ? Code::center_out_of_range : Code::field_invalid,
                     .detail = "I, J, K"};
  }
  CircleResult result = request.radius
                            ? arc_of_radius(*request.radius, ends, circle_, tolerances_)
                            : arc_about(center, ends, circle_, use_of_arcs(), tolerances_);
  if (CircleFault* fault = std::get_if<CircleFault>(&result))
    return misfit(std::move(*fault), request, ends);
  programmed.arc = std::get<Arc>(result);
  if (too_large(programmed.arc.center)) return Refusal{.code = Code::center_out_of_range};
  if (!request.radius && circle_.correct_center) {
    programmed.center_shift = (programmed.arc.center - center).norm();
    programmed.width = width_about(center, programmed.arc);
  }
  return {};
}

}  // namespace trc
