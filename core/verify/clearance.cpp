#include "core/verify/clearance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/verify/coverage.h"
#include "core/verify/disk.h"
#include "core/verify/near_walls.h"
#include "core/verify/nearest.h"
#include "core/verify/selection_walls.h"
#include "core/verify/shape.h"
#include "core/verify/wall_tree.h"

namespace trc::verify {
namespace {

// Longer arcs are compared part by part: their boxes would be near to too much.
constexpr double longest_probe = 2;  // rad

// Of long pieces there are fewer in a group, else what is near to all of them together is most of
// the contour.
constexpr std::size_t few_of_group = 20;
constexpr double reach_of_group = 8;  // times the tool radius

// Of laps so many pieces of path are known again; a power of 2.
constexpr std::size_t most_clear = std::size_t{1} << 16U;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

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
        input_resolution_(settings.leads.input_resolution),
        progress_(settings.progress),
        checkpoint_(checkpoint),
        walls_(what.walls),
        sides_(walls_.sides()),
        tree_(walls_.tree()),
        is_plain_(walls_.are_plain()),
        near_(held_, tree_, checkpoint_) {
    // Rules count upwards.
    const ProgrammedPiece& first = held_.programmed()[begin_];
    has_one_rule_ = first.rule == held_.programmed()[end_ - 1].rule;
    required_by_rule_ = held_.rule_of(first).required;
    report_.walls = walls_.count();
    report_.wall_length = walls_.length();
    if (settings.uncut) touched_.resize(end_ - begin_);
    if (sides_.sides.size() == 1 && !sides_.sides.front().rings.empty())
      clear_before_.assign(std::min(most_clear, std::bit_ceil(2 * (end_ - begin_))), none);
  }

  // The pieces of the path from `next` on that stem from this selection. Returns the one behind.
  std::size_t measure_from(std::size_t next) {
    auto pieces = held_.path().from(next);
    while (has(next)) {
      begin_group(next);
      for (; next < group_.behind; ++next) {
        checkpoint_.pass();
        measure(next, pieces.next());
      }
      const auto& all = held_.path();
      if (progress_) progress_(next - all.begin(), all.end() - all.begin());
    }
    if (report_.checked > 0) count_left_out(end_, place_);
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

  void begin_group(std::size_t first) {
    group_ = {.first = first, .behind = first};
    near_.clear();
    auto pieces = held_.path().from(first);
    const Point& start = held_.path()[first].piece.start;
    const std::size_t last = std::min(first + NearWalls::most_of_group, held_.path().end());
    for (; group_.behind < last; ++group_.behind) {
      const PathPiece& path = pieces.next();
      if (path.programmed >= end_) break;
      group_.required = std::max(group_.required, required_of(path));
      const double most = reach_of_group * group_.required;
      if (!near_.path_winds() && group_.behind >= first + few_of_group &&
          (path.piece.end - start).squaredNorm() > most * most)
        break;
    }
  }

  void measure(std::size_t number, const PathPiece& path) {
    if (walls_.count() == 0) return;
    const ProgrammedPiece& own = held_.programmed()[path.programmed];
    // SUPPRESS_TRC: the path of no tool says nothing of the one that cuts.
    if (const Rule& rule = held_.rule_of(own); !rule.follows && rule.radius > 0) return;
    ++report_.checked;
    required_ = required_of(path);
    gouges_ = false;
    if (path.on_contour) check_side(path, own);
    if (!path.inserted && own.is_contour)
      count_touched(path.programmed,
                    touched(own.piece, walls_.wall_of(own), path.piece, required_));
    // Over the seam of a closed contour the path comes back to the first blocks.
    count_left_out(path.programmed < latest_ ? end_ : path.programmed, path.piece.start);
    place_ = path.piece.end;
    const double margin = margin_of_interest();
    if (!is_clear_here(path.piece, margin) && !was_clear(path)) {
      search(number, path, own, margin);
      // What gouges has been compared with what is nearer than that alone.
      if (!is_near_ && !gouges_) keep_clear(number);
    }
    if (!gouges_) return;
    ++report_.gouging;
  }

  // Laps on top of each other have the same path again and again: where a piece of it was clear,
  // it is so in later laps, which have to keep clear of no more walls.
  [[nodiscard]] bool was_clear(const PathPiece& path) {
    if (clear_before_.empty()) return false;
    slot_ = slot_of(path.piece);
    const std::size_t known = clear_before_[slot_];
    if (known == none) return false;
    const PathPiece& other = held_.path()[known];
    return other.programmed <= path.programmed && other.piece == path.piece &&
           required_of(other) >= required_;
  }
  void keep_clear(std::size_t number) {
    if (!clear_before_.empty()) clear_before_[slot_] = number;
  }
  [[nodiscard]] std::size_t slot_of(const Piece& path) const {
    std::uint64_t key = 0;
    for (const double value : {path.start.x(), path.start.y(), path.end.x(), path.end.y()})
      key = (std::rotl(key, 23) ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
    return key >> 32U & (clear_before_.size() - 1);
  }

  void count_touched(std::size_t number, const Stretch& stretch) {
    if (!(stretch.from < stretch.to)) return;
    report_.touched_length += stretch.length();
    if (!touched_.empty()) touched_[number - begin_].push_back(stretch);
  }

  // Of arcs as large as the tool, and of what is smaller than the input is exact, nothing is
  // travelled: the tool turns in one place. Those before `behind`.
  void count_left_out(std::size_t behind, const Point& place) {
    for (std::size_t number = std::exchange(latest_, behind) + 1; number < behind; ++number) {
      checkpoint_.pass();
      const ProgrammedPiece& block = held_.programmed()[number];
      if (block.is_contour && is_touched_from(place, block.piece, required_))
        count_touched(number, walls_.wall_of(block));
    }
  }

  [[nodiscard]] double required_at(std::size_t number) const {
    const double own = held_.rule_of(held_.programmed()[number]).required;
    return number == begin_ ? own
                            : std::min(own, held_.rule_of(held_.programmed()[number - 1]).required);
  }
  [[nodiscard]] double required_of(const PathPiece& path) const {
    if (has_one_rule_) return required_by_rule_;
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
  // Of any piece, before something of it has been found.
  [[nodiscard]] double widest_of_interest() const {
    return std::max(least_ - half_resolution, -allowed_);
  }

  // Path that stands still, beside as many walls as a full circle has, or nearly so.
  [[nodiscard]] bool is_clear_here(const Piece& piece, double margin) const {
    return !piece.is_arc() && clear_ && clear_->required >= required_ && clear_->margin >= margin &&
           (piece.start - clear_->place).squaredNorm() <= slack * slack &&
           (piece.end - clear_->place).squaredNorm() <= slack * slack;
  }

  // `margin`: what is of interest.
  void search(std::size_t number, const PathPiece& path, const ProgrammedPiece& own,
              double margin) {
    is_near_ = false;
    // Before anything has been found, all walls are near.
    if (!report_.worst && is_whole_wall(own)) compare(path, own, own.piece, own.number);
    if (!near_.are_known() && report_.worst) find_near();
    if (near_.are_worth_it())
      search_near(path, number);
    else
      search_all(path);
    if (!is_near_) clear_ = {.place = path.piece.start, .margin = margin, .required = required_};
  }

  [[nodiscard]] bool is_whole_wall(const ProgrammedPiece& block) const {
    return block.is_contour && tree_.is_whole(block.number);
  }

  void find_near() {
    near_.find(group_.first, group_.behind, group_.required + widest_of_interest() + slack);
    report_.steps += near_.leaves();
  }

  void search_near(const PathPiece& path, std::size_t number) {
    near_.for_each_near(
        number, path, [this] { return required_ + margin_of_interest() + slack; },
        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
          compare(path, block, wall, first);
        });
  }

  void search_all(const PathPiece& path) {
    const auto parts =
        static_cast<int>(std::max(1.0, std::ceil(std::abs(path.piece.sweep) / longest_probe)));
    for (int part = 0; part < parts; ++part) search_all(path, part_of(path.piece, part, parts));
  }

  void search_all(const PathPiece& path, const Piece& part) {
    const Disk disk = disk_of(part);
    const Compared compared(path.piece);
    tree_.for_each_near(
        tree_.probe(part),
        [this](double required) {
          checkpoint_.pass();
          ++report_.steps;
          return std::min(required_, required) + margin_of_interest() + slack;
        },
        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
          const double reach = required_ + margin_of_interest() + slack;
          if (least_gap(disk, disk_of(wall)) < reach && !compared.is_apart_from(wall, reach))
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
    if (is_fine_step(block) || is_beside_fine_step(path.programmed))
      touch = std::max(touch, shortest_step());
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

  // mm. A line no longer than that is as short as rounding leaves it where nothing was meant.
  [[nodiscard]] double shortest_step() const {
    return 1.5 * std::min(input_resolution_, 0.01 * required_);
  }
  // Such a line has no side (D-44).
  [[nodiscard]] bool is_hardly_there(const Piece& own) const {
    return !own.is_arc() && (own.end - own.start).norm() <= shortest_step();
  }
  // Lines that rounding has bent so that a corner takes more than there is of them may be joined
  // within that distance (D-44).
  [[nodiscard]] bool is_fine_step(const ProgrammedPiece& block) const {
    if (block.piece.is_arc() || !held_.rule_of(block).joins_fine_steps) return false;
    const double longest = 2.5 * required_ * std::min(input_resolution_, 0.01 * required_);  // mm²
    return (block.piece.end - block.piece.start).squaredNorm() <= longest;
  }

  // With it a line before or behind one is turned.
  [[nodiscard]] bool is_beside_fine_step(std::size_t place) const {
    const auto& blocks = held_.programmed();
    return is_fine_step(blocks[place]) ||
           (place > blocks.begin() && is_fine_step(blocks[place - 1])) ||
           (place + 1 < blocks.end() && is_fine_step(blocks[place + 1]));
  }

  // Whether the middle of the path lies on the side of its own block that the program asks for.
  void check_side(const PathPiece& path, const ProgrammedPiece& own) {
    const Rule& rule = held_.rule_of(own);
    if (!rule.follows || is_hardly_there(own.piece)) return;
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
            .contour = near.wall};
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
  std::size_t latest_;  // programmed piece whose path has been measured; `end_`: all that have one
  Point place_ = Point::Zero();  // where that path ends
  double allowed_;
  double input_resolution_;
  const std::function<void(std::size_t, std::size_t)>& progress_;
  Checkpoint& checkpoint_;
  const SelectionWalls& walls_;
  const SidedWalls& sides_;
  const WallTree& tree_;
  bool is_plain_;
  bool has_one_rule_ = false;
  double required_by_rule_ = 0;  // then, mm
  ClearanceReport report_;
  double least_ = std::numeric_limits<double>::infinity();        // margin that was seen, mm
  double least_gouge_ = std::numeric_limits<double>::infinity();  // of a gouge, mm
  std::vector<std::vector<Stretch>> touched_;  // of each programmed piece, where that is asked for
  // Pieces that are measured one after the other.
  struct Group {
    std::size_t first = 0;
    std::size_t behind = 0;
    double required = 0;
  };
  Group group_{};
  // Numbers of pieces of path that were clear, by slot_of(); empty: there are no laps.
  std::vector<std::size_t> clear_before_;
  std::size_t slot_ = 0;  // of the piece that is being measured
  NearWalls near_;        // to the group
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

// Behind the last piece of the selection that begins there: rules count upwards.
std::size_t end_of_selection(const HeldPath& held, std::size_t begin, std::size_t end) {
  const auto selection_of = [&](std::size_t number) {
    return held.rule_of(held.programmed()[number]).selection;
  };
  const std::uint32_t selection = selection_of(begin);
  std::size_t behind = end;
  while (begin + 1 < behind) {
    const std::size_t middle = begin + (behind - begin) / 2;
    (selection_of(middle) == selection ? begin : behind) = middle;
  }
  return behind;
}

}  // namespace

void ClearanceReport::add(const ClearanceReport& other) {
  checked += other.checked;
  walls += other.walls;
  gouging += other.gouging;
  wall_length += other.wall_length;
  touched_length += other.touched_length;
  steps += other.steps;
  if (other.worst && (!worst || other.worst->margin() < worst->margin())) worst = other.worst;
  if (other.gouge && (!gouge || other.gouge->margin() < gouge->margin())) gouge = other.gouge;
}

ClearanceReport measure_clearance(const HeldPath& held, std::size_t end,
                                  const ClearanceSettings& settings, Checkpoint& checkpoint) {
  ClearanceReport report;
  const std::size_t all = held.path().end() - held.path().begin();
  if (settings.progress) settings.progress(0, all);
  std::size_t next = held.path().begin();
  for (std::size_t begin = held.programmed().begin(); begin < end;) {
    const std::size_t behind = end_of_selection(held, begin, end);
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
  if (settings.progress) settings.progress(all, all);
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
