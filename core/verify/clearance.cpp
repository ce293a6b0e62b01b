#include "core/verify/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/trc/walls/closing.h"
#include "core/trc/walls/sided_walls.h"
#include "core/verify/coverage.h"
#include "core/verify/disk.h"
#include "core/verify/nearest.h"
#include "core/verify/shape.h"
#include "core/verify/wall_tree.h"

namespace trc::verify {
namespace {

// Longer arcs are compared part by part: their boxes would be near to too much.
constexpr double longest_probe = 2;  // rad

// Pieces one behind the other are near to the same walls: those are looked for together.
constexpr std::size_t group_size = 16;

// What is told of the worst place, and what is looked for below the least margin that was seen, are
// each exact to half of it.
constexpr double half_resolution = margin_resolution / 2;  // mm

// Where one piece of path was clear, those as near to it need not be searched again.
constexpr double slack = half_resolution / 2;  // mm

// Measures the path of one selection.
class Selection {
 public:
  // Its programmed pieces are those from `begin` to `end`.
  Selection(const HeldPath& held, std::size_t begin, std::size_t end,
            const ClearanceSettings& settings, Checkpoint& checkpoint)
      : held_(held),
        begin_(begin),
        end_(end),
        allowed_(settings.allowed),
        progress_(settings.progress),
        checkpoint_(checkpoint),
        sides_(walls_between(begin, end, settings.leads)),
        tree_(held, begin, end, sides_, checkpoint) {
    report_.walls = tree_.walls();
    if (settings.uncut) touched_.resize(end - begin);
    is_plain_ = sides_.sides.size() == 1 && sides_.sides.front().are_plain();
    for (std::size_t place = begin; place < end; ++place) {
      checkpoint.pass();
      const ProgrammedPiece& piece = held.programmed()[place];
      if (piece.is_contour) report_.wall_length += wall_of(piece).length();
    }
  }

  // The pieces of the path from `next` on that stem from this selection. Returns the one behind.
  std::size_t measure_from(std::size_t next) {
    while (has(next)) {
      std::size_t behind = next;
      UprightBox around;
      double required = 0;
      for (; behind < next + group_size && has(behind); ++behind) {
        const PathPiece& path = held_.path()[behind];
        around.add(box_of(path.piece));
        required = std::max(required, required_of(path));
      }
      gouges_ = false;
      const double reach = required + margin_of_interest() + slack;
      if (!report_.worst || !tree_.find_near(around.box(), reach, near_))
        near_.assign(1, tree_.whole());
      for (; next < behind; ++next) {
        checkpoint_.pass();
        measure(held_.path()[next]);
      }
      const auto& all = held_.path();
      if (progress_) progress_(next - all.begin(), all.end() - all.begin());
    }
    return next;
  }

  [[nodiscard]] const ClearanceReport& report() const { return report_; }

  // What was kept as touched leaves over.
  void tell_uncut(const UncutSink& uncut) {
    for (std::size_t place = begin_; place < end_; ++place) {
      checkpoint_.pass();
      const ProgrammedPiece& block = held_.programmed()[place];
      if (!block.is_contour) continue;
      std::vector<Stretch>& touched = touched_[place - begin_];
      std::sort(touched.begin(), touched.end(),
                [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
      Stretch left = wall_of(block);
      for (const Stretch& stretch : touched) {
        tell_uncut(block, {left.from, stretch.from}, uncut);
        left.from = std::max(left.from, stretch.to);
      }
      tell_uncut(block, left, uncut);
    }
  }

 private:
  void tell_uncut(const ProgrammedPiece& block, const Stretch& stretch, const UncutSink& uncut) {
    constexpr double shortest = 1e-3;  // mm
    if (stretch.length() < shortest) return;
    uncut({.source = block.source,
           .plane = held_.rule_of(block).plane,
           .path = trc::verify::part_of(segment_of(block.piece), stretch)});
  }

  [[nodiscard]] SidedWalls walls_between(std::size_t begin, std::size_t end,
                                         const LeadSettings& leads) const {
    std::vector<std::size_t> places;  // of the contour blocks
    std::vector<std::size_t> changes;
    double radius = 0;
    bool has_roles = false;
    const auto rule = [&](std::size_t place) -> const Rule& {
      return held_.rule_of(held_.programmed()[place]);
    };
    for (std::size_t place = begin; place < end; ++place) {
      checkpoint_.pass();
      const ProgrammedPiece& piece = held_.programmed()[place];
      if (!piece.is_contour) continue;
      if (!places.empty() && rule(places.back()).side != rule(place).side)
        changes.push_back(places.size());
      places.push_back(place);
      radius = std::max(radius, rule(place).radius);
      has_roles = has_roles || piece.role != ContourRole::unspecified;
    }
    ContourView view{.count = places.size(),
                     .segment =
                         [&](std::size_t number) {
                           return segment_of(held_.programmed()[places[number]].piece);
                         },
                     .checkpoint = &checkpoint_};
    if (has_roles)
      view.role = [&](std::size_t number) { return held_.programmed()[places[number]].role; };
    if (!places.empty()) view.shift = rule(places.front()).side == Side::left ? 1 : -1;
    return find_walls(view, changes, leads, radius);
  }

  // What of a contour block is a wall; nothing where none of it is.
  [[nodiscard]] Stretch wall_of(const ProgrammedPiece& block) const {
    const double length = extent_of(segment_of(block.piece));
    if (is_plain_) return {0, length};
    if (sides_.is_lead(block.number)) return {};
    const auto part = sides_.part_of(block.number);
    return part ? Stretch{part->from, std::min(part->to, length)} : Stretch{0, length};
  }

  [[nodiscard]] bool has(std::size_t number) const {
    return number < held_.path().end() && held_.path()[number].programmed < end_;
  }

  void measure(const PathPiece& path) {
    if (tree_.walls() == 0) return;
    ++report_.checked;
    const ProgrammedPiece& own = held_.programmed()[path.programmed];
    required_ = required_of(path);
    gouges_ = false;
    if (path.on_contour) check_side(path, own);
    if (!path.inserted && own.is_contour) {
      const Stretch stretch =
          touched(segment_of(own.piece), wall_of(own), segment_of(path.piece), required_);
      report_.touched_length += stretch.length();
      if (!touched_.empty() && stretch.length() > 0)
        touched_[path.programmed - begin_].push_back(stretch);
    }
    if (!is_clear_here(path.piece)) search(path);
    if (!gouges_) return;
    ++report_.gouging;
    if (held_.rule_of(own).accepts) ++report_.accepted;
  }

  [[nodiscard]] double required_at(std::size_t number) const {
    const double own = held_.rule_of(held_.programmed()[number]).required;
    return number == begin_ ? own
                            : std::min(own, held_.rule_of(held_.programmed()[number - 1]).required);
  }
  [[nodiscard]] double required_of(const PathPiece& path) const {
    const double own = required_at(path.programmed);
    const bool has_next = path.inserted && path.programmed + 1 < end_;
    return has_next ? std::min(own, required_at(path.programmed + 1)) : own;
  }

  // A margin from here on changes nothing of the report.
  [[nodiscard]] double margin_of_interest() const {
    const double lower = least_ - half_resolution;
    return gouges_ ? lower : std::max(lower, -allowed_);
  }

  // Path that stands still, beside as many walls as a full circle has, or nearly so.
  [[nodiscard]] bool is_clear_here(const Piece& piece) const {
    return clear_ && clear_->required >= required_ && clear_->margin >= margin_of_interest() &&
           !piece.is_arc() && (piece.start - clear_->place).norm() <= slack &&
           (piece.end - clear_->place).norm() <= slack;
  }

  void search(const PathPiece& path) {
    const double margin = margin_of_interest();
    is_near_ = false;
    const auto parts =
        static_cast<int>(std::max(1.0, std::ceil(std::abs(path.piece.sweep) / longest_probe)));
    for (int part = 0; part < parts; ++part) search(path, part_of(path.piece, part, parts));
    if (!is_near_) clear_ = {.place = path.piece.start, .margin = margin, .required = required_};
  }

  void search(const PathPiece& path, const Piece& part) {
    disk_ = disk_of(part);
    tree_.for_each_near(
        tree_.probe(part), near_,
        [this](double required) {
          ++report_.steps;
          return std::min(required_, required) + margin_of_interest() + slack;
        },
        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
          checkpoint_.pass();
          compare(path, block, wall, first);
        });
  }

  // `first`: the first of the contour blocks that are like this one.
  void compare(const PathPiece& path, const ProgrammedPiece& block, const Piece& wall,
               std::size_t first) {
    ++report_.steps;
    const double required = std::min(required_, held_.rule_of(block).required);
    const double limit = required + margin_of_interest() + slack;
    // Most walls beside one that is near are told apart by this already.
    if (least_gap(disk_, disk_of(wall)) >= limit) return;
    if (path.piece.is_arc() || wall.is_arc()) {
      const Point& center = wall.is_arc() ? wall.center : path.piece.center;
      if (least_gap(ring_of(path.piece, center), ring_of(wall, center)) >= limit) return;
    } else if (are_apart(path.piece, wall, limit)) {
      return;
    }
    const Gap gap = gap_between(path.piece, wall);
    if (gap.distance >= limit) return;
    // Only of what is near it matters whether it is a wall, and how near the path may come to it.
    double touch = 0;
    if (!is_plain_) {
      const std::size_t own = held_.programmed()[path.programmed].number;
      if (!sides_.is_wall_for(block.number, own)) return;
      touch = first == block.number ? sides_.touch_between(block.number, own)
                                    : touch_of_laps(block.number, first, own);
    }
    if (gap.distance < limit - touch) is_near_ = true;
    note(path, gap.distance, required - touch, gap.on_a, block.source);
  }

  // One of them lies in the lap of the path itself: as far behind the begin of that.
  [[nodiscard]] double touch_of_laps(std::size_t last, std::size_t first, std::size_t own) const {
    const Walls& walls = sides_.sides.front();
    const std::size_t ring = walls.ring_of(own);
    if (walls.ring_of(first) > ring) return walls.touch_between(last, own);
    const auto begin_of = [&](std::size_t number) {
      return number > 0 ? walls.rings[number - 1] : walls.head.end - 2;
    };
    const std::size_t same = last - begin_of(walls.ring_of(last)) + begin_of(ring);
    return walls.ring_of(same) == ring ? walls.touch_between(same, own) : 0;
  }

  // Whether the middle of the path lies on the side of its own block that the program asks for.
  void check_side(const PathPiece& path, const ProgrammedPiece& own) {
    const Rule& rule = held_.rule_of(own);
    const bool is_point = !own.piece.is_arc() && own.piece.start == own.piece.end;
    if (!rule.follows || is_point) return;
    const Point middle = place_at(segment_of(path.piece), 0.5).point;
    const Segment contour = segment_of(own.piece);
    const Point foot = nearest_point(contour, middle);
    const double left = cross(direction_at(contour, foot), middle - foot);
    if (rule.side == Side::left ? left >= 0 : left <= 0) return;
    note(path, -(middle - foot).norm(), required_, middle, own.source);
  }

  void note(const PathPiece& path, double distance, double required, const Point& point,
            const Source& wall) {
    const double margin = distance - required;
    if (margin < -allowed_) gouges_ = true;
    if (margin >= least_) return;
    // Whatever was compared counts, also what is not told: else walls that are a little less far
    // than what is told, as around a tool that goes round in a hole, would be near for ever.
    least_ = margin;
    if (report_.worst && margin > report_.worst->margin() - half_resolution) return;
    const ProgrammedPiece& own = held_.programmed()[path.programmed];
    const Rule& rule = held_.rule_of(own);
    report_.worst = {.distance = distance,
                     .required = required,
                     .place = from_plane(rule.plane, point, path.height),
                     .path = own.source,
                     .contour = wall,
                     .accepted = rule.accepts};
  }

  static Piece part_of(const Piece& piece, int part, int parts) {
    if (parts == 1) return piece;
    const Segment whole = segment_of(piece);
    const auto share = [&](int number) { return static_cast<double>(number) / parts; };
    return {.start = place_at(whole, share(part)).point,
            .end = place_at(whole, share(part + 1)).point,
            .center = piece.center,
            .sweep = piece.sweep / parts};
  }

  const HeldPath& held_;
  std::size_t begin_;
  std::size_t end_;
  double allowed_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  Checkpoint& checkpoint_;
  SidedWalls sides_;
  bool is_plain_ = false;  // all of the contour is a wall for all of the path
  WallTree tree_;
  ClearanceReport report_;
  double least_ = std::numeric_limits<double>::infinity();  // margin that was seen, mm
  std::vector<std::vector<Stretch>> touched_;  // of each programmed piece, where that is asked for
  std::vector<WallTree::Stretch> near_;        // to the group of pieces that is being measured
  // A place of the path that is clear with `slack` to spare.
  struct Clear {
    Point place = Point::Zero();
    double margin = 0;
    double required = 0;
  };
  std::optional<Clear> clear_;
  // Of the piece that is being measured.
  double required_ = 0;
  Disk disk_;  // around the part of it that is compared
  bool gouges_ = false;
  bool is_near_ = false;
};

// Behind the last piece of the selection that begins there.
std::size_t end_of_selection(const HeldPath& held, std::size_t begin, std::size_t end,
                             Checkpoint& checkpoint) {
  const std::uint32_t selection = held.rule_of(held.programmed()[begin]).selection;
  std::size_t number = begin + 1;
  for (; number < end && held.rule_of(held.programmed()[number]).selection == selection; ++number)
    checkpoint.pass();
  return number;
}

}  // namespace

void ClearanceReport::add(const ClearanceReport& other) {
  checked += other.checked;
  walls += other.walls;
  gouging += other.gouging;
  accepted += other.accepted;
  wall_length += other.wall_length;
  touched_length += other.touched_length;
  steps += other.steps;
  if (other.worst && (!worst || other.worst->margin() < worst->margin())) worst = other.worst;
}

ClearanceReport measure_clearance(const HeldPath& held, std::size_t end,
                                  const ClearanceSettings& settings, Checkpoint& checkpoint) {
  ClearanceReport report;
  std::size_t next = held.path().begin();
  for (std::size_t begin = held.programmed().begin(); begin < end;) {
    const std::size_t behind = end_of_selection(held, begin, end, checkpoint);
    Selection selection(held, begin, behind, settings, checkpoint);
    next = selection.measure_from(next);
    report.add(selection.report());
    if (settings.uncut) selection.tell_uncut(settings.uncut);
    begin = behind;
  }
  return report;
}

ClearanceReport measure_clearance(std::span<const Block> programmed,
                                  std::span<const CompensatedBlock> path, double allowed,
                                  const LeadSettings& leads) {
  return measure_clearance(programmed, path, {.allowed = allowed, .leads = leads});
}

ClearanceReport measure_clearance(std::span<const Block> programmed,
                                  std::span<const CompensatedBlock> path,
                                  const ClearanceSettings& settings) {
  HeldPath held;
  for (const Block& block : programmed) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion != nullptr && motion->mode && motion->mode->active()) held.add(*motion);
  }
  for (const CompensatedBlock& block : path) held.add(block);
  Checkpoint checkpoint({});
  return measure_clearance(held, held.programmed().end(), settings, checkpoint);
}

}  // namespace trc::verify
