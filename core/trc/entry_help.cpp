#include "core/trc/entry_help.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/diagnostics.h"
#include "core/geometry/box_tree.h"
#include "core/geometry/distance.h"
#include "core/trc/compensator.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/selection/free_start.h"

namespace trc::selection {
namespace {

constexpr double pi = std::numbers::pi;

// A contour of more blocks is not looked at: the answer to a refusal must not take long.
constexpr std::size_t most_blocks = 1000;

// What a way is made longer by, mm, until what is written with a few decimals is long enough.
constexpr std::array<double, 6> spares{0, 1e-4, 3e-4, 5e-4, 1e-3, 2e-3};
constexpr double written = 1e3;  // steps a mm

// Radii of the quarter circle, of the tool's.
constexpr std::array<double, 5> quarter_radii{2, 1.5, 3, 1.2, 5};

// Motions in the plane that lead to the contour, or off it.
struct Way {
  EntryProposal::Shape shape = EntryProposal::Shape::line;
  std::vector<Segment> motions{};
};

Point rounded(const Point& point) {
  return {std::round(point.x() * written) / written, std::round(point.y() * written) / written};
}

DiagnosticPoint machine_point(Plane plane, const Point& point, double height) {
  const Position position = from_plane(plane, point, height);
  return {.x = position[0], .y = position[1], .z = position[2]};
}

// What a corner leaves of a block whose start it cuts; none: nothing.
std::optional<Segment> behind_cut(const Segment& block, double cut) {
  if (cut <= 0) return block;
  if (const auto* line = std::get_if<Line>(&block)) {
    if (cut >= length_of(*line)) return std::nullopt;
    return Line{.start = line->start + cut * tangent_of(*line), .end = line->end};
  }
  Arc arc = std::get<Arc>(block);
  if (cut >= std::abs(arc.sweep)) return std::nullopt;
  const double turn = std::copysign(cut, arc.sweep);
  const Vector radial = arc.start - arc.center;
  arc.start = arc.center + std::cos(turn) * radial + std::sin(turn) * left_of(radial);
  arc.sweep -= turn;
  return arc;
}

// Accepted, but not what anybody would want.
bool leaves_much_out(const Diagnostics& found) {
  const auto& told = found.pending();
  return std::any_of(told.begin(), told.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.code == Code::blocks_masked && diagnostic.severity == Severity::warning;
  });
}

class EntrySearch {
 public:
  EntrySearch(const RefusedWay& refused, const CompensatorSetup& setup)
      : refused_(refused),
        setup_(setup),
        refused_block_(refused.leaves ? refused.blocks.back() : refused.blocks.front()),
        contour_(refused.leaves ? std::span(refused.blocks).first(1)
                                : std::span(refused.blocks).subspan(1)),
        nearest_contour_block_(contour_.front()),
        walls_(contour_.first(contour_.size() - refused.leads_out)),
        plane_(refused_block_.mode->plane) {
    setup_.helps_with_entries = false;
  }

  [[nodiscard]] EntryHelp find() const;
  // Where loops are removed: with the leads at the end, or without them.
  [[nodiscard]] EntryHelp find_past_leads();
  // Of a contour that begins in an inside corner.
  [[nodiscard]] EntryHelp find_in_corner() const;

 private:
  [[nodiscard]] std::optional<Way> longer_line() const;
  [[nodiscard]] std::optional<Way> line_from_tool_side() const;
  [[nodiscard]] std::optional<Way> quarter_circle() const;
  [[nodiscard]] std::optional<Way> line_from_free_start() const;
  [[nodiscard]] std::optional<Way> line_into_corner() const;
  [[nodiscard]] std::optional<Point> start_under_g238(const Way& way) const;
  [[nodiscard]] std::optional<Way> longer_arc() const;
  [[nodiscard]] Way quarter_circle(double radius) const;

  // Whether the way is accepted and clear.
  [[nodiscard]] bool does(const Way& way) const;
  struct Tried {
    bool accepted = false;
    std::vector<CompensatedBlock> path{};
  };
  [[nodiscard]] Tried compensated(const Way& way, CompensatorSetup setup,
                                  Diagnostics& diagnostics) const;
  [[nodiscard]] std::vector<Block> program(const Way& way) const;
  [[nodiscard]] bool is_of_way(const CompensatedBlock& block, std::size_t motions) const;
  [[nodiscard]] bool is_clear(const Segment& path) const;

  [[nodiscard]] double tool_radius() const { return std::abs(refused_.shift); }
  [[nodiscard]] EntryProposal proposal(const Way& way) const;
  [[nodiscard]] DiagnosticPoint start_point(const Point& point) const {
    return machine_point(plane_, point, refused_block_.normal.from);
  }
  // The point of the way that is free to be chosen.
  [[nodiscard]] DiagnosticPoint free_end(const Way& way) const {
    return refused_.leaves
               ? machine_point(plane_, end_of(way.motions.back()), refused_block_.normal.to)
               : start_point(start_of(way.motions.front()));
  }

  const RefusedWay& refused_;
  CompensatorSetup setup_;
  const MotionBlock& refused_block_;
  std::span<const MotionBlock> contour_;
  const MotionBlock& nearest_contour_block_;
  std::span<const MotionBlock> walls_;
  Plane plane_;
};

EntryHelp EntrySearch::find() const {
  EntryHelp help{.leaves = refused_.leaves,
                 .third_axis = static_cast<std::uint8_t>(axes_of(plane_).third),
                 .given_length = length_of(refused_block_.path),
                 .needed_length = refused_.needed_length.value_or(0),
                 .tried_on = static_cast<std::uint32_t>(contour_.size())};
  const bool inside_corner = refused_.target.has_value();
  const std::optional<Way> line = inside_corner ? line_from_free_start() : longer_line();
  const bool is_arc_refused = is_arc(refused_block_.path);
  if (const auto longer = is_arc_refused ? longer_arc() : line) help.legal = free_end(*longer);
  if (line) help.proposals.push_back(proposal(*line));
  // The contour of G238 closes where it begins: an arc before it would open it.
  if (inside_corner) return help;
  if (const auto quarter = quarter_circle()) help.proposals.push_back(proposal(*quarter));
  return help;
}

EntryHelp EntrySearch::find_past_leads() {
  EntryHelp help{.third_axis = static_cast<std::uint8_t>(axes_of(plane_).third),
                 .given_length = length_of(refused_block_.path),
                 .replaced = static_cast<std::uint32_t>(refused_.leads_in)};
  std::optional<Way> quarter = quarter_circle();
  // Where the begin is well, it is the end that has to be another one.
  if (!quarter && refused_.at_begin && refused_.leads_out > 0) {
    contour_ = walls_;
    help.left_out = static_cast<std::uint32_t>(refused_.leads_out);
    quarter = quarter_circle();
  }
  help.tried_on = static_cast<std::uint32_t>(contour_.size());
  if (quarter) help.proposals.push_back(proposal(*quarter));
  const bool has_leads = refused_.leads_in > 0 || refused_.leads_out > 0;
  if (!quarter && refused_.at_begin && !has_leads)
    if (const auto corner = line_into_corner()) help.proposals.push_back(proposal(*corner));
  return help;
}

EntryHelp EntrySearch::find_in_corner() const {
  EntryHelp help{.third_axis = static_cast<std::uint8_t>(axes_of(plane_).third),
                 .given_length = length_of(refused_block_.path),
                 .tried_on = static_cast<std::uint32_t>(contour_.size())};
  if (const auto corner = line_into_corner()) help.proposals.push_back(proposal(*corner));
  return help;
}

std::optional<Way> EntrySearch::line_into_corner() const {
  const TrcMode& mode = *refused_block_.mode;
  const bool begins_beside_it =
      mode.selection == Selection::direct || mode.selection == Selection::indirect;
  const Point& corner = start_of(contour_.front().path);
  const double gap = (end_of(contour_.back().path) - corner).norm();
  if (!begins_beside_it || mode.tangential || gap > setup_.tolerances.same_point)
    return std::nullopt;
  Way way{.shape = EntryProposal::Shape::inside_corner,
          .motions = {Line{.start = start_of(refused_block_.path), .end = corner}}};
  if (does(way)) return way;
  const auto start = start_under_g238(way);
  if (!start) return std::nullopt;
  way.motions = {Line{.start = *start, .end = corner}};
  if (!does(way)) return std::nullopt;
  return way;
}

// What G238 proposes itself in place of its start.
std::optional<Point> EntrySearch::start_under_g238(const Way& way) const {
  CompensatorSetup setup = setup_;
  setup.helps_with_entries = true;
  Diagnostics diagnostics;
  if (compensated(way, setup, diagnostics).accepted || diagnostics.pending().empty())
    return std::nullopt;
  const auto& help = diagnostics.pending().back().entry_help;
  if (!help || !help->legal) return std::nullopt;
  return to_plane(plane_, {help->legal->x, help->legal->y, help->legal->z});
}

// Where no length of the programmed direction would do: from the programmed point, or from the
// tool side, across the contour and a little behind its begin.
std::optional<Way> EntrySearch::line_from_tool_side() const {
  const Segment& contour = nearest_contour_block_.path;
  const Vector along = refused_.leaves ? tangent_at_end(contour) : tangent_at_start(contour);
  const Point& corner = refused_.leaves ? end_of(contour) : start_of(contour);
  const Point& given =
      refused_.leaves ? end_of(refused_block_.path) : start_of(refused_block_.path);
  const double radius = tool_radius();
  const Vector across = 2 * std::copysign(radius, refused_.shift) * left_of(along);
  const Vector behind = (refused_.leaves ? radius : -radius) * along;
  for (const Point& free : {given, rounded(corner + across + behind), rounded(corner + across)}) {
    if ((free - corner).norm() <= radius) continue;
    Way way{.motions = {refused_.leaves ? Line{.start = corner, .end = free}
                                        : Line{.start = free, .end = corner}}};
    if (does(way)) return way;
  }
  return std::nullopt;
}

std::optional<Way> EntrySearch::longer_line() const {
  if (!refused_.needed_straight) return line_from_tool_side();
  const Segment& given = refused_block_.path;
  for (const double spare : spares) {
    const double length = *refused_.needed_straight + spare;
    Line line;
    if (refused_.leaves) {
      line.start = start_of(given);
      line.end = rounded(line.start + length * tangent_at_start(given));
    } else {
      line.end = end_of(given);
      line.start = rounded(line.end - length * tangent_at_end(given));
    }
    if (length_of(line) < *refused_.needed_straight) continue;
    Way way{.motions = {line}};
    if (does(way)) return way;
  }
  return std::nullopt;
}

std::optional<Way> EntrySearch::longer_arc() const {
  const Arc& given = std::get<Arc>(refused_block_.path);
  const double radius = radius_of(given);
  if (!refused_.needed_length || !(radius > 0)) return std::nullopt;
  for (const double spare : spares) {
    const double angle = (*refused_.needed_length + spare) / radius;
    if (angle >= 2 * pi) return std::nullopt;
    Arc arc = given;
    arc.sweep = std::copysign(angle, given.sweep);
    const double turn = refused_.leaves ? arc.sweep : -arc.sweep;
    const Vector radial = (refused_.leaves ? given.start : given.end) - given.center;
    const Point end = given.center + std::cos(turn) * radial + std::sin(turn) * left_of(radial);
    (refused_.leaves ? arc.end : arc.start) = end;
    Way way{.motions = {arc}};
    if (does(way)) return way;
  }
  return std::nullopt;
}

std::optional<Way> EntrySearch::quarter_circle() const {
  for (const double radii : quarter_radii) {
    Way way = quarter_circle(radii * tool_radius());
    if (does(way)) return way;
  }
  return std::nullopt;
}

Way EntrySearch::quarter_circle(double radius) const {
  const Segment& contour = nearest_contour_block_.path;
  const Vector along = refused_.leaves ? tangent_at_end(contour) : tangent_at_start(contour);
  const Point& corner = refused_.leaves ? end_of(contour) : start_of(contour);
  const double side = std::copysign(1.0, refused_.shift);
  const Point center = corner + side * radius * left_of(along);
  Way way{.shape = EntryProposal::Shape::quarter_circle};
  if (refused_.leaves) {
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

std::optional<Way> EntrySearch::line_from_free_start() const {
  const FreeStart search({.contour = contour_,
                          .way = {start_of(refused_block_.path), end_of(refused_block_.path)},
                          .target = *refused_.target,
                          .shift = refused_.shift,
                          .on_tool_side = refused_.starts_on_tool_side,
                          .step = 1 / written},
                         setup_);
  const auto start = search.find();
  if (!start) return std::nullopt;
  Way way{.motions = {Line{.start = *start, .end = end_of(refused_block_.path)}}};
  if (!does(way)) return std::nullopt;
  return way;
}

bool EntrySearch::does(const Way& way) const {
  Diagnostics diagnostics;
  const auto [accepted, path] = compensated(way, setup_, diagnostics);
  if (!accepted || (refused_.removes_loops && leaves_much_out(diagnostics))) return false;
  return std::all_of(path.begin(), path.end(), [&](const CompensatedBlock& block) {
    // Under G238 the contour begins and ends elsewhere too. Where loops are removed it is clear.
    const bool is_at_stake = refused_.in_corner || is_of_way(block, way.motions.size());
    return !is_at_stake || block.origin == Origin::masked || is_clear(block.path);
  });
}

EntrySearch::Tried EntrySearch::compensated(const Way& way, CompensatorSetup setup,
                                            Diagnostics& diagnostics) const {
  std::vector<Block> blocks = program(way);
  if (blocks.empty()) return {};
  const auto& first = std::get<MotionBlock>(blocks.front());
  setup.start = from_plane(plane_, start_of(first.path), first.normal.from);
  const TrcMode at_end = *std::get<MotionBlock>(blocks.back()).mode;
  Compensator compensator(setup, diagnostics);
  Tried tried;
  tried.accepted = compensator.feed(blocks, tried.path) && compensator.finish(at_end, tried.path);
  return tried;
}

// The way and the contour, numbered from 0 by Source::index; none: of the contour nothing is left.
std::vector<Block> EntrySearch::program(const Way& way) const {
  std::vector<MotionBlock> motions;
  const auto add_lead = [&](const Segment& path, const MotionBlock& like) {
    MotionBlock lead = like;
    lead.path = path;
    motions.push_back(std::move(lead));
  };
  if (refused_.leaves) {
    // What leads to the last block is not known any more: what is left of it is entered across.
    MotionBlock last = nearest_contour_block_;
    const auto left = behind_cut(last.path, refused_.cut_at_start);
    if (!left) return {};
    last.path = *left;
    TrcMode mode = *last.mode;
    mode.selection = Selection::perpendicular;
    mode.tangential = false;
    last.mode = std::make_shared<const TrcMode>(mode);
    motions.push_back(last);
    for (std::size_t i = 0; i + 1 < way.motions.size(); ++i) add_lead(way.motions[i], last);
    motions.push_back(refused_block_);
    motions.back().path = way.motions.back();
  } else {
    motions.push_back(refused_block_);
    motions.back().path = way.motions.front();
    for (std::size_t i = 1; i < way.motions.size(); ++i)
      add_lead(way.motions[i], nearest_contour_block_);
    motions.insert(motions.end(), contour_.begin(), contour_.end());
  }
  std::vector<Block> blocks;
  for (MotionBlock& motion : motions) {
    if (way.shape == EntryProposal::Shape::inside_corner) {
      TrcMode mode = *motion.mode;
      mode.selection = Selection::inside_corner;
      motion.mode = std::make_shared<const TrcMode>(mode);
    }
    motion.source.index = blocks.size();
    // A matter of the plane; of leads that are left out the height would be missing.
    motion.normal = {.from = refused_block_.normal.from, .to = refused_block_.normal.from};
    motion.tracking.clear();
    blocks.emplace_back(std::move(motion));
  }
  return blocks;
}

bool EntrySearch::is_of_way(const CompensatedBlock& block, std::size_t motions) const {
  if (refused_.leaves) return block.source.index > 0 || block.origin == Origin::retract;
  return block.source.index < motions;
}

bool EntrySearch::is_clear(const Segment& path) const {
  if (length_of(path) <= setup_.tolerances.same_point) return true;
  const double required = tool_radius() - setup_.tolerances.on_contour;
  const Box around = bounding_box(path);
  return std::all_of(walls_.begin(), walls_.end(), [&](const MotionBlock& block) {
    if (squared_distance(around, bounding_box(block.path)) > required * required) return true;
    return nearness(path, block.path, setup_.tolerances.same_point).distance >= required;
  });
}

EntryProposal EntrySearch::proposal(const Way& way) const {
  const double to = refused_block_.normal.to;
  // Leads that are left out may have come down to the contour.
  const double at_contour = refused_.leads_in > 0 ? contour_.front().normal.from : to;
  double height = refused_block_.normal.from;
  EntryProposal result{.shape = way.shape, .start = start_point(start_of(way.motions.front()))};
  for (const Segment& motion : way.motions) {
    // A way out rises in its last motion, a way in comes down in its first one.
    const bool is_last = &motion == &way.motions.back();
    const double last = refused_.leaves ? to : at_contour;
    const double between = refused_.leaves ? height : to;
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
  if (refused.blocks.size() < 2 + refused.leads_out || refused.blocks.size() > most_blocks ||
      refused.shift == 0)
    return nullptr;
  EntrySearch search(refused, setup);
  if (refused.in_corner) {
    EntryHelp help = search.find_in_corner();
    return help.proposals.empty() ? nullptr : std::make_shared<const EntryHelp>(std::move(help));
  }
  if (!refused.removes_loops) return std::make_shared<const EntryHelp>(search.find());
  // What loop removal refuses has other causes mostly.
  EntryHelp help = search.find_past_leads();
  return help.proposals.empty() ? nullptr : std::make_shared<const EntryHelp>(std::move(help));
}

}  // namespace trc::selection
