#include "core/verify/measure_selection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/verify/clear_before.h"
#include "core/verify/coverage.h"
#include "core/verify/disk.h"
#include "core/verify/fine_steps.h"
#include "core/verify/margins.h"
#include "core/verify/near_walls.h"
#include "core/verify/nearest.h"
#include "core/verify/own_side.h"
#include "core/verify/shape.h"
#include "core/verify/touched_walls.h"
#include "core/verify/wall_tree.h"

namespace trc::verify {
namespace {

// Longer arcs are compared part by part: their boxes would be near to too much.
constexpr double longest_probe = 2;  // rad

// A group of long pieces has fewer of them: otherwise most of the contour would be near to the
// group.
constexpr std::size_t few_of_group = 20;
constexpr double reach_of_group = 8;  // times the tool radius

// Pieces of path within this distance of a clear one need not be searched again.
constexpr double slack = half_resolution / 2;  // mm

// Measures the path of one selection.
class Selection {
 public:
  Selection(const SelectionPieces& what, const ClearanceSettings& settings, Checkpoint& checkpoint)
      : held_(what.held),
        begin_(what.begin),
        end_(what.end),
        latest_(what.begin),
        progress_(settings.progress),
        checkpoint_(checkpoint),
        walls_(what.walls),
        sides_(walls_.sides()),
        tree_(walls_.tree()),
        is_plain_(walls_.are_plain()),
        margins_(what.held, settings.allowed),
        touched_(what.held, what.walls, {what.begin, what.end}, settings.uncut != nullptr),
        near_(held_, tree_, checkpoint_),
        fine_steps_(held_, settings.leads.input_resolution),
        clear_before_(what.walls, what.end - what.begin) {
    // Rule numbers only rise.
    const ProgrammedPiece& first = held_.programmed()[begin_];
    has_one_rule_ = first.rule == held_.programmed()[end_ - 1].rule;
    required_by_rule_ = held_.rule_of(first).required;
    report_.walls = walls_.count();
    report_.wall_length = walls_.length();
  }

  // Measures the pieces from `next` on that stem from this selection. Returns the one after them.
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
    report_.touched_length = touched_.length();
    report_.worst = margins_.worst();
    report_.gouge = margins_.gouge();
    return next;
  }

  [[nodiscard]] const ClearanceReport& report() const { return report_; }
  void tell_uncut(const UncutSink& uncut) { touched_.tell_uncut(uncut, checkpoint_); }

 private:
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
      const MeasuredPiece& path = pieces.next();
      if (path.programmed >= end_) break;
      group_.required = std::max(group_.required, required_of(path));
      const double most = reach_of_group * group_.required;
      if (!near_.path_winds() && group_.behind >= first + few_of_group &&
          (path.piece.end - start).squaredNorm() > most * most)
        break;
    }
  }

  void measure(std::size_t number, const MeasuredPiece& path) {
    if (walls_.count() == 0) return;
    const ProgrammedPiece& own = held_.programmed()[path.programmed];
    // SUPPRESS_TRC: a path without compensation says nothing about the tool that cuts.
    if (const Rule& rule = held_.rule_of(own); !rule.follows && rule.radius > 0) return;
    ++report_.checked;
    required_ = required_of(path);
    margins_.begin_piece();
    if (path.on_contour) check_side(path, own);
    if (!path.inserted && own.is_contour)
      touched_.add(path.programmed, touched(own.piece, walls_.wall_of(own), path.piece, required_));
    // Over the seam of a closed contour the path comes back to the first blocks.
    count_left_out(path.programmed < latest_ ? end_ : path.programmed, path.piece.start);
    place_ = path.piece.end;
    const double margin = margins_.of_interest();
    if (!is_clear_here(path.piece, margin) && !was_clear(path)) {
      search(number, path, own, margin);
      // A piece that gouges has been compared only with walls nearer than the gouge.
      if (!is_near_ && !margins_.gouges()) clear_before_.keep(number);
    }
    if (!margins_.gouges()) return;
    ++report_.gouging;
  }

  // Whether the same piece was clear in an earlier lap, with at least the same required clearance.
  [[nodiscard]] bool was_clear(const MeasuredPiece& path) {
    const auto known = clear_before_.find(path.piece);
    if (!known) return false;
    const MeasuredPiece& other = held_.path()[*known];
    return other.programmed <= path.programmed && other.piece == path.piece &&
           required_of(other) >= required_;
  }

  // Adds the walls before `behind` that have no path: along an arc as large as the tool, or a block
  // smaller than the input resolution, the tool stays in one place.
  void count_left_out(std::size_t behind, const Point& place) {
    for (std::size_t number = std::exchange(latest_, behind) + 1; number < behind; ++number) {
      checkpoint_.pass();
      const ProgrammedPiece& block = held_.programmed()[number];
      if (block.is_contour && is_touched_from(place, block.piece, required_))
        touched_.add(number, walls_.wall_of(block));
    }
  }

  [[nodiscard]] double required_at(std::size_t number) const {
    const double own = held_.rule_of(held_.programmed()[number]).required;
    return number == begin_ ? own
                            : std::min(own, held_.rule_of(held_.programmed()[number - 1]).required);
  }
  [[nodiscard]] double required_of(const MeasuredPiece& path) const {
    if (has_one_rule_) return required_by_rule_;
    const double own = required_at(path.programmed);
    const bool has_next = path.inserted && path.programmed + 1 < end_;
    return has_next ? std::min(own, required_at(path.programmed + 1)) : own;
  }

  // A path meets the next wall at the radius of that wall, where it is the smaller one (D-159).
  // Blocks with SUPPRESS_TRC ask for nothing.
  [[nodiscard]] double required_beside(const ProgrammedPiece& wall,
                                       const MeasuredPiece& path) const {
    if (has_one_rule_) return required_;
    const double of_wall = held_.rule_of(wall).required;
    const std::size_t own = held_.programmed()[path.programmed].number;
    const bool is_next = wall.number == own || wall.number == own + 1;
    return is_next || of_wall == 0 ? std::min(required_, of_wall) : required_;
  }

  // Whether the piece hardly moves and lies where an earlier one was clear: it may have as many
  // walls around it as a full circle.
  [[nodiscard]] bool is_clear_here(const Piece& piece, double margin) const {
    return !piece.is_arc() && clear_ && clear_->required >= required_ && clear_->margin >= margin &&
           (piece.start - clear_->place).squaredNorm() <= slack * slack &&
           (piece.end - clear_->place).squaredNorm() <= slack * slack;
  }

  // `margin`: the largest margin of interest.
  void search(std::size_t number, const MeasuredPiece& path, const ProgrammedPiece& own,
              double margin) {
    is_near_ = false;
    // Before anything has been found, all walls are near.
    if (!margins_.worst() && is_whole_wall(own)) compare(path, own, own.piece, own.number);
    if (!near_.are_known() && margins_.worst()) find_near();
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
    near_.find(group_.first, group_.behind,
               group_.required + margins_.widest_of_interest() + slack);
    report_.steps += near_.leaves();
  }

  void search_near(const MeasuredPiece& path, std::size_t number) {
    near_.for_each_near(
        number, path, [this] { return required_ + margins_.of_interest() + slack; },
        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
          compare(path, block, wall, first);
        });
  }

  void search_all(const MeasuredPiece& path) {
    const auto parts =
        static_cast<int>(std::max(1.0, std::ceil(std::abs(path.piece.sweep) / longest_probe)));
    for (int part = 0; part < parts; ++part) search_all(path, part_of(path.piece, part, parts));
  }

  void search_all(const MeasuredPiece& path, const Piece& part) {
    const Disk disk = disk_of(part);
    const Compared compared(path.piece);
    tree_.for_each_near(
        tree_.probe(part),
        [this](double required) {
          checkpoint_.pass();
          ++report_.steps;
          return (required > 0 ? required_ : 0) + margins_.of_interest() + slack;
        },
        [&](const ProgrammedPiece& block, const Piece& wall, std::size_t first) {
          const double reach = required_ + margins_.of_interest() + slack;
          if (least_gap(disk, disk_of(wall)) < reach && !compared.is_apart_from(wall, reach))
            compare(path, block, wall, first);
        });
  }

  // `first`: the first of the contour blocks that equal this one.
  void compare(const MeasuredPiece& path, const ProgrammedPiece& block, const Piece& wall,
               std::size_t first) {
    ++report_.steps;
    checkpoint_.pass();
    const double required = required_beside(block, path);
    const double limit = required + margins_.of_interest() + slack;
    const Gap gap = gap_between(path.piece, wall, limit);
    if (gap.distance >= limit) return;
    // Only for a near block it matters whether it is a wall, and how near the path may come to it.
    double touch = 0;
    if (!is_plain_) {
      const std::size_t own = held_.programmed()[path.programmed].number;
      if (!sides_.is_wall_for(block.number, own)) return;
      touch = first == block.number ? sides_.touch_between(block.number, own)
                                    : touch_of_laps(block.number, first, own);
    }
    is_near_ = true;
    if (fine_steps_.are_beside(block, path.programmed, required_))
      touch = std::max(touch, fine_steps_.shortest(required_));
    margins_.note(path, {.distance = gap.distance,
                         .required = required,
                         .touch = touch,
                         .point = gap.on_a,
                         .wall = block.source});
  }

  // One of the equal walls lies in the lap of the path, as far after its beginning as `last` after
  // that of its own lap.
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
  void check_side(const MeasuredPiece& path, const ProgrammedPiece& own) {
    const Rule& rule = held_.rule_of(own);
    if (!rule.follows || fine_steps_.is_hardly_there(own.piece, required_)) return;
    const auto wrong = on_wrong_side(path.piece, own.piece, rule.side);
    if (!wrong) return;
    margins_.note(path, {.distance = -wrong->apart,
                         .required = required_,
                         .point = wrong->middle,
                         .wall = own.source});
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

  const MeasuredPath& held_;
  std::size_t begin_;
  std::size_t end_;
  std::size_t latest_;  // latest piece whose path has been measured; `end_`: all that have one
  Point place_ = Point::Zero();  // where that path ends
  const std::function<void(std::size_t, std::size_t)>& progress_;
  Checkpoint& checkpoint_;
  const SelectionWalls& walls_;
  const SidedWalls& sides_;
  const WallTree& tree_;
  bool is_plain_;
  bool has_one_rule_ = false;
  double required_by_rule_ = 0;  // then, mm
  ClearanceReport report_;
  Margins margins_;
  TouchedWalls touched_;
  // Pieces that are measured one after the other.
  struct Group {
    std::size_t first = 0;
    std::size_t behind = 0;
    double required = 0;
  };
  Group group_{};
  NearWalls near_;  // to the group
  FineSteps fine_steps_;
  ClearBefore clear_before_;
  // A place of the path that is clear with `slack` to spare.
  struct Clear {
    Point place = Point::Zero();
    double margin = 0;
    double required = 0;
  };
  std::optional<Clear> clear_;
  // For the piece that is being measured.
  double required_ = 0;
  bool is_near_ = false;
};

}  // namespace

ClearanceReport measure_selection(const SelectionPieces& selection, std::size_t& next,
                                  const ClearanceSettings& settings, Checkpoint& checkpoint) {
  Selection measured(selection, settings, checkpoint);
  next = measured.measure_from(next);
  if (settings.uncut) measured.tell_uncut(settings.uncut);
  return measured.report();
}

}  // namespace trc::verify
