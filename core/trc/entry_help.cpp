#include "core/trc/entry_help.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "core/base/diagnostics.h"
#include "core/trc/entry_trial.h"
#include "core/trc/selection/free_start.h"

namespace trc::selection {
namespace {

constexpr double pi = std::numbers::pi;

// A contour with more blocks is not examined: the answer to a refusal must not take long.
constexpr std::size_t most_blocks = 1000;

// Lengths, mm, to add to a way until it is long enough when written with a few decimals.
constexpr std::array<double, 6> spares{0, 1e-4, 3e-4, 5e-4, 1e-3, 2e-3};
constexpr double written = 1e3;  // steps per mm

// Radii of the quarter circle, in tool radii.
constexpr std::array<double, 5> quarter_radii{2, 1.5, 3, 1.2, 5};

Point rounded(const Point& point) {
  return {std::round(point.x() * written) / written, std::round(point.y() * written) / written};
}

DiagnosticPoint machine_point(Plane plane, const Point& point, double height) {
  const Position position = from_plane(plane, point, height);
  return {.x = position[0], .y = position[1], .z = position[2]};
}

class EntrySearch {
 public:
  EntrySearch(const RefusedWay& refused, const CompensatorSetup& setup)
      : refused_(refused),
        setup_(setup),
        refused_block_(refused.leaves() ? refused.blocks.back() : refused.blocks.front()),
        trial_(refused, setup),
        nearest_contour_block_(trial_.contour().front()),
        plane_(refused_block_.mode->plane) {}

  // For a block whose length may be at fault.
  [[nodiscard]] EntryHelp find() const;
  [[nodiscard]] EntryHelp find(const WayIntoCorner& refused) const;
  // With the leads at the end, or without them.
  [[nodiscard]] EntryHelp find(const WayPastLeads& refused);
  [[nodiscard]] EntryHelp find(const WayBesideCorner& refused) const;

 private:
  // What is known without a search.
  [[nodiscard]] EntryHelp given() const;
  [[nodiscard]] std::optional<EntryWay> longer_line() const;
  [[nodiscard]] std::optional<EntryWay> line_from_tool_side() const;
  [[nodiscard]] std::optional<EntryWay> quarter_circle() const;
  [[nodiscard]] std::optional<EntryWay> line_from(const WayIntoCorner& refused) const;
  [[nodiscard]] std::optional<EntryWay> line_into_corner() const;
  [[nodiscard]] std::optional<Point> start_under_g238(const EntryWay& way) const;
  [[nodiscard]] std::optional<EntryWay> longer_arc() const;
  [[nodiscard]] EntryWay quarter_circle(double radius) const;

  [[nodiscard]] double tool_radius() const { return std::abs(refused_.shift); }
  [[nodiscard]] EntryProposal proposal(const EntryWay& way) const;
  [[nodiscard]] DiagnosticPoint start_point(const Point& point) const {
    return machine_point(plane_, point, refused_block_.normal.from);
  }
  // The end of the way that can be chosen freely.
  [[nodiscard]] DiagnosticPoint free_end(const EntryWay& way) const {
    return refused_.leaves()
               ? machine_point(plane_, end_of(way.motions.back()), refused_block_.normal.to)
               : start_point(start_of(way.motions.front()));
  }

  const RefusedWay& refused_;
  const CompensatorSetup& setup_;
  const MotionBlock& refused_block_;
  EntryTrial trial_;
  const MotionBlock& nearest_contour_block_;
  Plane plane_;
};

EntryHelp EntrySearch::given() const {
  return {.leaves = refused_.leaves(),
          .third_axis = static_cast<std::uint8_t>(axes_of(plane_).third),
          .given_length = length_of(refused_block_.path),
          .tried_on = static_cast<std::uint32_t>(trial_.contour().size())};
}

EntryHelp EntrySearch::find() const {
  EntryHelp help = given();
  help.needed_length = refused_.needed_length().along_itself.value_or(0);
  const std::optional<EntryWay> line = longer_line();
  const bool is_arc_refused = is_arc(refused_block_.path);
  if (const auto longer = is_arc_refused ? longer_arc() : line) help.legal = free_end(*longer);
  if (line) help.proposals.push_back(proposal(*line));
  if (const auto quarter = quarter_circle()) help.proposals.push_back(proposal(*quarter));
  return help;
}

// The contour of G238 closes where it begins: an arc before it would open it.
EntryHelp EntrySearch::find(const WayIntoCorner& refused) const {
  EntryHelp help = given();
  const auto line = line_from(refused);
  if (!line) return help;
  if (!is_arc(refused_block_.path)) help.legal = free_end(*line);
  help.proposals.push_back(proposal(*line));
  return help;
}

EntryHelp EntrySearch::find(const WayPastLeads& refused) {
  EntryHelp help = given();
  help.replaced = static_cast<std::uint32_t>(refused.leads_in);
  std::optional<EntryWay> quarter = quarter_circle();
  // If a way in fails on the whole contour, the leads at its end may be the cause.
  if (!quarter && refused.at_begin && refused.leads_out > 0) {
    trial_.leave_out_leads();
    help.left_out = static_cast<std::uint32_t>(refused.leads_out);
    quarter = quarter_circle();
  }
  help.tried_on = static_cast<std::uint32_t>(trial_.contour().size());
  if (quarter) help.proposals.push_back(proposal(*quarter));
  const bool has_leads = refused.leads_in > 0 || refused.leads_out > 0;
  if (!quarter && refused.at_begin && !has_leads)
    if (const auto corner = line_into_corner()) help.proposals.push_back(proposal(*corner));
  return help;
}

EntryHelp EntrySearch::find(const WayBesideCorner& /*refused*/) const {
  EntryHelp help = given();
  if (const auto corner = line_into_corner()) help.proposals.push_back(proposal(*corner));
  return help;
}

std::optional<EntryWay> EntrySearch::line_into_corner() const {
  const TrcMode& mode = *refused_block_.mode;
  const bool begins_beside_it =
      mode.selection == Selection::direct || mode.selection == Selection::indirect;
  const Point& corner = start_of(trial_.contour().front().path);
  const double gap = (end_of(trial_.contour().back().path) - corner).norm();
  if (!begins_beside_it || mode.tangential || gap > setup_.tolerances.same_point)
    return std::nullopt;
  EntryWay way{.shape = EntryProposal::Shape::inside_corner,
               .motions = {Line{.start = start_of(refused_block_.path), .end = corner}}};
  if (trial_.does(way)) return way;
  const auto start = start_under_g238(way);
  if (!start) return std::nullopt;
  way.motions = {Line{.start = *start, .end = corner}};
  if (!trial_.does(way)) return std::nullopt;
  return way;
}

// The start that G238 itself proposes.
std::optional<Point> EntrySearch::start_under_g238(const EntryWay& way) const {
  Diagnostics diagnostics;
  if (trial_.is_accepted_with_help(way, diagnostics) || diagnostics.pending().empty())
    return std::nullopt;
  const auto& help = diagnostics.pending().back().entry_help;
  if (!help || !help->legal) return std::nullopt;
  return to_plane(plane_, {help->legal->x, help->legal->y, help->legal->z});
}

// If no length in the programmed direction suffices: a line from the programmed point, or from the
// tool side, square to the contour or set back a little from its end.
std::optional<EntryWay> EntrySearch::line_from_tool_side() const {
  const Segment& contour = nearest_contour_block_.path;
  const Vector along = refused_.leaves() ? tangent_at_end(contour) : tangent_at_start(contour);
  const Point& corner = refused_.leaves() ? end_of(contour) : start_of(contour);
  const Point& given =
      refused_.leaves() ? end_of(refused_block_.path) : start_of(refused_block_.path);
  const double radius = tool_radius();
  const Vector across = 2 * std::copysign(radius, refused_.shift) * left_of(along);
  const Vector behind = (refused_.leaves() ? radius : -radius) * along;
  for (const Point& free : {given, rounded(corner + across + behind), rounded(corner + across)}) {
    if ((free - corner).norm() <= radius) continue;
    EntryWay way{.motions = {refused_.leaves() ? Line{.start = corner, .end = free}
                                               : Line{.start = free, .end = corner}}};
    if (trial_.does(way)) return way;
  }
  return std::nullopt;
}

std::optional<EntryWay> EntrySearch::longer_line() const {
  const auto needed = refused_.needed_length().straight;
  if (!needed) return line_from_tool_side();
  const Segment& given = refused_block_.path;
  for (const double spare : spares) {
    const double length = *needed + spare;
    Line line;
    if (refused_.leaves()) {
      line.start = start_of(given);
      line.end = rounded(line.start + length * tangent_at_start(given));
    } else {
      line.end = end_of(given);
      line.start = rounded(line.end - length * tangent_at_end(given));
    }
    if (length_of(line) < *needed) continue;
    EntryWay way{.motions = {line}};
    if (trial_.does(way)) return way;
  }
  return std::nullopt;
}

std::optional<EntryWay> EntrySearch::longer_arc() const {
  const Arc& given = std::get<Arc>(refused_block_.path);
  const double radius = radius_of(given);
  const auto needed = refused_.needed_length().along_itself;
  if (!needed || !(radius > 0)) return std::nullopt;
  for (const double spare : spares) {
    const double angle = (*needed + spare) / radius;
    if (angle >= 2 * pi) return std::nullopt;
    Arc arc = given;
    arc.sweep = std::copysign(angle, given.sweep);
    const double turn = refused_.leaves() ? arc.sweep : -arc.sweep;
    const Vector radial = (refused_.leaves() ? given.start : given.end) - given.center;
    const Point end = given.center + std::cos(turn) * radial + std::sin(turn) * left_of(radial);
    (refused_.leaves() ? arc.end : arc.start) = end;
    EntryWay way{.motions = {arc}};
    if (trial_.does(way)) return way;
  }
  return std::nullopt;
}

std::optional<EntryWay> EntrySearch::quarter_circle() const {
  for (const double radii : quarter_radii) {
    EntryWay way = quarter_circle(radii * tool_radius());
    if (trial_.does(way)) return way;
  }
  return std::nullopt;
}

EntryWay EntrySearch::quarter_circle(double radius) const {
  const Segment& contour = nearest_contour_block_.path;
  const Vector along = refused_.leaves() ? tangent_at_end(contour) : tangent_at_start(contour);
  const Point& corner = refused_.leaves() ? end_of(contour) : start_of(contour);
  const double side = std::copysign(1.0, refused_.shift);
  const Point center = corner + side * radius * left_of(along);
  EntryWay way{.shape = EntryProposal::Shape::quarter_circle};
  if (refused_.leaves()) {
    const Point off = center + radius * along;
    way.motions = {Arc{.start = corner, .end = off, .center = center, .sweep = side * pi / 2},
                   Line{.start = off, .end = center}};
  } else {
    const Point on = center - radius * along;
    way.motions = {Line{.start = center, .end = on},
                   Arc{.start = on, .end = corner, .center = center, .sweep = side * pi / 2}};
  }
  return way;
}

std::optional<EntryWay> EntrySearch::line_from(const WayIntoCorner& refused) const {
  const FreeStart search({.contour = trial_.contour(),
                          .way = {start_of(refused_block_.path), end_of(refused_block_.path)},
                          .target = refused.target,
                          .shift = refused_.shift,
                          .on_tool_side = refused.starts_on_tool_side,
                          .step = 1 / written},
                         setup_);
  const auto start = search.find();
  if (!start) return std::nullopt;
  EntryWay way{.motions = {Line{.start = *start, .end = end_of(refused_block_.path)}}};
  if (!trial_.does(way)) return std::nullopt;
  return way;
}

EntryProposal EntrySearch::proposal(const EntryWay& way) const {
  const double to = refused_block_.normal.to;
  // Leads that are left out may have come down to the contour.
  const double at_contour =
      refused_.leads().leads_in > 0 ? trial_.contour().front().normal.from : to;
  double height = refused_block_.normal.from;
  EntryProposal result{.shape = way.shape, .start = start_point(start_of(way.motions.front()))};
  for (const Segment& motion : way.motions) {
    // A way out rises in its last motion, a way in comes down in its first one.
    const bool is_last = &motion == &way.motions.back();
    const double last = refused_.leaves() ? to : at_contour;
    const double between = refused_.leaves() ? height : to;
    const double end = is_last ? last : between;
    ProposedBlock block{.end = machine_point(plane_, end_of(motion), end)};
    if (const auto* arc = std::get_if<Arc>(&motion)) {
      block.center = machine_point(plane_, arc->center, height);
      block.sweep = arc->sweep;
    }
    height = end;
    result.blocks.push_back(block);
  }
  return result;
}

}  // namespace

std::shared_ptr<const EntryHelp> help_with(const RefusedWay& refused,
                                           const CompensatorSetup& setup) {
  if (refused.blocks.size() < 2 + refused.leads().leads_out ||
      refused.blocks.size() > most_blocks || refused.shift == 0)
    return nullptr;
  EntrySearch search(refused, setup);
  const auto told = [](EntryHelp help) {
    return std::make_shared<const EntryHelp>(std::move(help));
  };
  const auto told_with_proposals = [&](EntryHelp help) {
    return help.proposals.empty() ? nullptr : told(std::move(help));
  };
  return std::visit(
      overloaded{
          [&](const WayIn&) { return told(search.find()); },
          [&](const WayOut&) { return told(search.find()); },
          [&](const WayIntoCorner& way) { return told(search.find(way)); },
          // Refusals of loop removal mostly have other causes.
          [&](const WayPastLeads& way) { return told_with_proposals(search.find(way)); },
          [&](const WayBesideCorner& way) { return told_with_proposals(search.find(way)); },
      },
      refused.kind);
}

}  // namespace trc::selection
