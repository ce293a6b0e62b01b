#include "core/verify/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/verify/coverage.h"
#include "core/verify/disk.h"
#include "core/verify/nearest.h"
#include "core/verify/selection_walls.h"
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

// The programmed pieces of one selection, from `begin` to `end`, and their walls.
struct Measured {
  const HeldPath& held;
  std::size_t begin;
  std::size_t end;
  const SelectionWalls& walls;
};

// Measures the path of one selection.
class Selection {
 public:
  Selection(const Measured& what, const ClearanceSettings& settings, Checkpoint& checkpoint)
      : held_(what.held),
        begin_(what.begin),
        end_(what.end),
        latest_(what.begin),
        allowed_(settings.allowed),
        progress_(settings.progress),
        checkpoint_(checkpoint),
        walls_(what.walls),
        sides_(walls_.sides()),
        tree_(walls_.tree()),
        is_plain_(walls_.are_plain()) {
    report_.walls = tree_.walls();
    report_.wall_length = walls_.length();
    if (settings.uncut) touched_.resize(end_ - begin_);
  }

  // The pieces of the path from `next` on that stem from this selection. Returns the one behind.
  std::size_t measure_from(std::size_t next) {
    while (has(next)) {
      std::size_t behind = next;
      BoxAlong around;
      double required = 0;
      for (; behind < next + group_size && has(behind); ++behind) {
        const PathPiece& path = held_.path()[behind];
        add_to(around, path.piece);
        required = std::max(required, required_of(path));
      }
      gouges_ = false;
      find_near(around.box(), required + margin_of_interest() + slack);
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
      Stretch left = walls_.wall_of(block);
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
    if (!path.inserted && own.is_contour) count_touched(path.programmed, path.piece);
    count_left_out(path);
    if (!is_clear_here(path.piece)) search(path);
    if (!gouges_) return;
    ++report_.gouging;
    if (held_.rule_of(own).accepts) ++report_.accepted;
  }

  void count_touched(std::size_t number, const Piece& path) {
    const ProgrammedPiece& block = held_.programmed()[number];
    const Stretch stretch = touched(block.piece, walls_.wall_of(block), path, required_);
    report_.touched_length += stretch.length();
    if (!touched_.empty() && stretch.length() > 0) touched_[number - begin_].push_back(stretch);
  }

  // Of arcs as large as the tool nothing is travelled: it turns in their centre.
  void count_left_out(const PathPiece& path) {
    for (std::size_t number = std::exchange(latest_, path.programmed) + 1; number < path.programmed;
         ++number) {
      checkpoint_.pass();
      const ProgrammedPiece& block = held_.programmed()[number];
      if (block.is_contour && block.piece.is_arc())
        count_touched(number, {.start = path.piece.start, .end = path.piece.start});
    }
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
    const double of_gouge =
        gouges_ ? std::min(least_gouge_ - half_resolution, -allowed_) : -allowed_;
    return std::max(least_ - half_resolution, of_gouge);
  }

  // Path that stands still, beside as many walls as a full circle has, or nearly so.
  [[nodiscard]] bool is_clear_here(const Piece& piece) const {
    return clear_ && clear_->required >= required_ && clear_->margin >= margin_of_interest() &&
           !piece.is_arc() && (piece.start - clear_->place).norm() <= slack &&
           (piece.end - clear_->place).norm() <= slack;
  }

  // The walls that the pieces of a group are compared with, one by one.
  void find_near(const Box& box, double reach) {
    near_.clear();
    has_near_ = report_.worst && tree_.find_near(box, reach, stretches_);
    if (!has_near_) return;
    report_.steps += stretches_.size();
    for (const WallTree::Stretch& stretch : stretches_)
      tree_.for_each_of(stretch,
                        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
                          const Disk disk = disk_of(wall);
                          if (least_gap(disk, box) < reach)
                            near_.push_back({.disk = disk,
                                             .support = wall.is_arc() ? Support() : Support(wall),
                                             .wall = wall,
                                             .block = &block,
                                             .first = first});
                        });
  }

  void search(const PathPiece& path) {
    const double margin = margin_of_interest();
    is_near_ = false;
    if (has_near_)
      search_near(path);
    else
      search_all(path);
    if (!is_near_) clear_ = {.place = path.piece.start, .margin = margin, .required = required_};
  }

  void search_near(const PathPiece& path) {
    const Piece& piece = path.piece;
    const Disk disk = disk_of(piece);
    const bool is_line = !piece.is_arc();
    const Support support = is_line ? Support(piece) : Support();
    double reach = required_ + margin_of_interest() + slack;
    for (const NearWall& near : near_) {
      // Most walls are told apart by one of these already.
      const double apart = reach + disk.radius + near.disk.radius;
      if (apart < 0 || (disk.center - near.disk.center).squaredNorm() >= apart * apart) continue;
      if (is_line && !near.wall.is_arc() &&
          (support.is_apart(near.wall, reach) || near.support.is_apart(piece, reach)))
        continue;
      compare(path, *near.block, near.wall, near.first);
      reach = required_ + margin_of_interest() + slack;
    }
  }

  void search_all(const PathPiece& path) {
    const auto parts =
        static_cast<int>(std::max(1.0, std::ceil(std::abs(path.piece.sweep) / longest_probe)));
    for (int part = 0; part < parts; ++part) search_all(path, part_of(path.piece, part, parts));
  }

  void search_all(const PathPiece& path, const Piece& part) {
    const Disk disk = disk_of(part);
    tree_.for_each_near(
        tree_.probe(part),
        [this](double required) {
          checkpoint_.pass();
          ++report_.steps;
          return std::min(required_, required) + margin_of_interest() + slack;
        },
        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
          if (least_gap(disk, disk_of(wall)) < required_ + margin_of_interest() + slack)
            compare(path, block, wall, first);
        });
  }

  // `first`: the first of the contour blocks that are like this one.
  void compare(const PathPiece& path, const ProgrammedPiece& block, const Piece& wall,
               std::size_t first) {
    ++report_.steps;
    checkpoint_.pass();
    const double required = std::min(required_, held_.rule_of(block).required);
    const double limit = required + margin_of_interest() + slack;
    const Gap gap = gap_between(path.piece, wall, limit);
    if (gap.distance >= limit) return;
    // Only of what is near it matters whether it is a wall, and how near the path may come to it.
    double touch = 0;
    if (!is_plain_) {
      const std::size_t own = held_.programmed()[path.programmed].number;
      if (!sides_.is_wall_for(block.number, own)) return;
      touch = first == block.number ? sides_.touch_between(block.number, own)
                                    : touch_of_laps(block.number, first, own);
    }
    is_near_ = true;
    note(path, {.distance = gap.distance,
                .required = required,
                .touch = touch,
                .point = gap.on_a,
                .wall = block.source});
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

  // Of two lines, and of arcs about one centre of which the path is no more than the contour.
  static bool is_surely_beside(const Piece& path, const Piece& own, Side side) {
    if (path.is_arc() != own.is_arc()) return false;
    if (!path.is_arc()) {
      const Point middle = 0.5 * (path.start + path.end);
      const double left = cross(Vector(own.end - own.start), middle - own.start);
      return side == Side::left ? left >= 0 : left <= 0;
    }
    const bool turns_left = own.sweep > 0;
    if (path.center != own.center || (path.sweep > 0) != turns_left ||
        std::abs(own.sweep) > std::numbers::pi)
      return false;
    const bool is_inside =
        (path.start - path.center).squaredNorm() < (own.start - own.center).squaredNorm();
    return is_inside == (turns_left == (side == Side::left)) && is_within(path, own);
  }

  // Whether the middle of the path lies on the side of its own block that the program asks for.
  void check_side(const PathPiece& path, const ProgrammedPiece& own) {
    const Rule& rule = held_.rule_of(own);
    const bool is_point = !own.piece.is_arc() && own.piece.start == own.piece.end;
    if (!rule.follows || is_point) return;
    // The quick way; what it finds at fault is looked at as all others are.
    if (is_surely_beside(path.piece, own.piece, rule.side)) return;
    const Point middle = place_at(segment_of(path.piece), 0.5).point;
    const Segment contour = segment_of(own.piece);
    const Point foot = nearest_point(contour, middle);
    const double left = cross(direction_at(contour, foot), middle - foot);
    if (rule.side == Side::left ? left >= 0 : left <= 0) return;
    note(path, {.distance = -(middle - foot).norm(),
                .required = required_,
                .point = middle,
                .wall = own.source});
  }

  // A wall near to the path.
  struct Near {
    double distance = 0;
    double required = 0;
    double touch = 0;  // so much nearer than that is no gouge, mm
    Point point = Point::Zero();
    Source wall{};
  };

  void note(const PathPiece& path, const Near& near) {
    const double margin = near.distance - near.required;
    if (margin + near.touch < -allowed_) {
      gouges_ = true;
      if (margin < least_gouge_) {
        least_gouge_ = margin;
        if (!report_.gouge || margin <= report_.gouge->margin() - half_resolution)
          report_.gouge = clearance_of(path, near);
      }
    }
    if (margin >= least_) return;
    // Whatever was compared counts, also what is not told: else walls that are a little less far
    // than what is told, as around a tool that goes round in a hole, would be near for ever.
    least_ = margin;
    if (report_.worst && margin > report_.worst->margin() - half_resolution) return;
    report_.worst = clearance_of(path, near);
  }

  [[nodiscard]] Clearance clearance_of(const PathPiece& path, const Near& near) const {
    const ProgrammedPiece& own = held_.programmed()[path.programmed];
    const Rule& rule = held_.rule_of(own);
    return {.distance = near.distance,
            .required = near.required,
            .place = from_plane(rule.plane, near.point, path.height),
            .path = own.source,
            .contour = near.wall,
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
  std::size_t latest_;  // programmed piece whose path has been measured
  double allowed_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  Checkpoint& checkpoint_;
  const SelectionWalls& walls_;
  const SidedWalls& sides_;
  const WallTree& tree_;
  bool is_plain_;
  ClearanceReport report_;
  double least_ = std::numeric_limits<double>::infinity();        // margin that was seen, mm
  double least_gouge_ = std::numeric_limits<double>::infinity();  // of a gouge, mm
  std::vector<std::vector<Stretch>> touched_;  // of each programmed piece, where that is asked for
  // A wall that may be near to the group of pieces that is being measured.
  struct NearWall {
    Disk disk{};
    Support support{};  // of a line
    Piece wall{};
    const ProgrammedPiece* block = nullptr;
    std::size_t first = 0;
  };
  std::vector<NearWall> near_;
  bool has_near_ = false;  // else they are too many to be looked at for each piece
  std::vector<WallTree::Stretch> stretches_;
  // A place of the path that is clear with `slack` to spare.
  struct Clear {
    Point place = Point::Zero();
    double margin = 0;
    double required = 0;
  };
  std::optional<Clear> clear_;
  // Of the piece that is being measured.
  double required_ = 0;
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
  if (other.gouge && (!gouge || other.gouge->margin() < gouge->margin())) gouge = other.gouge;
}

ClearanceReport measure_clearance(const HeldPath& held, std::size_t end,
                                  const ClearanceSettings& settings, Checkpoint& checkpoint) {
  ClearanceReport report;
  std::size_t next = held.path().begin();
  for (std::size_t begin = held.programmed().begin(); begin < end;) {
    const std::size_t behind = end_of_selection(held, begin, end, checkpoint);
    std::optional<SelectionWalls> own;
    const SelectionWalls& walls =
        settings.known_walls != nullptr
            ? settings.known_walls->of(held, begin, behind, settings.leads, checkpoint)
            : own.emplace(held, begin, behind, settings.leads, checkpoint);
    Selection selection({.held = held, .begin = begin, .end = behind, .walls = walls}, settings,
                        checkpoint);
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
