#include "core/trc/loops/obstacles.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/geometry/distance.h"
#include "core/trc/walls/sided_walls.h"

namespace trc {
namespace {

// Up to this many neighbours are compared without finding the nearest one first.
constexpr std::size_t few = 4;

// The limit of squared distances from boxes that misses nothing within `distance` of the point.
// Floats put a coordinate off by up to 1.2e-7 of itself, and a squared distance by less than 4e-6.
float squared_with_slack(double distance, const Point& point) {
  const double farthest = distance + 2e-7 * point.lpNorm<1>();
  return rounded_up((1 + 4e-6) * farthest * farthest);
}

}  // namespace

void Obstacles::append(const Certificate::Block& course, Certificate::Begin begin,
                       const Box& area) {
  certificate_.append(course, begin);
  boxes_.append(area);
}

void Obstacles::drop_before(std::size_t number) {
  boxes_.drop_before(number);
  certificate_.drop_before(number);
}

Segment Obstacles::wall(std::size_t number) const {
  return trc::part_of(path_.contour_block(number).programmed, walls_.part_of(number));
}

double Obstacles::wall_length(std::size_t number) const {
  return walls_.is_lead(number) ? 0 : length_of(wall(number));
}

void Obstacles::keep_walls(NearFour& four, std::size_t own) const {
  const NearFour all = four;
  all.for_each([&](std::size_t number, std::size_t /*place*/) {
    if (!walls_.is_wall_for(number, own)) four.drop(number, number + 1);
  });
}

void Obstacles::clear() {
  boxes_.clear();
  certificate_.clear();
  group_query_.first = 0;
  group_query_.end = 0;
  group_query_.area.setEmpty();
  group_query_.near.clear();
  few_.end = few_.first;
}

void Obstacles::rebuild_boxes() {
  boxes_.clear(path_.begin_of_contour());
  for (std::size_t number = path_.begin_of_contour(); number < end_of_contour(); ++number)
    boxes_.append(bounding_box(programmed(number)));
}

BoxTree::Range Obstacles::certified(std::size_t block) const {
  const std::size_t number = path_.number_of(block);
  if (path_.is_unreachable(block)) return {};
  if (path_.is_contour(block))
    return {certificate_.chain_before(number), certificate_.chain_behind(number)};
  // A transition belongs to the blocks on both sides of the corner.
  const std::size_t behind = number + 1;
  if (behind >= end_of_contour() || certificate_.chain_before(behind) > number) return {};
  return {certificate_.chain_before(behind), certificate_.chain_behind(number)};
}

void Obstacles::find_neighbours(std::size_t block, const Box& area, double limit,
                                Among among) const {
  const BoxTree::Range skipped = certified(block);
  const std::size_t own = path_.number_of(block);
  neighbours_.clear();
  // All blocks in the window are certified.
  if (window_ > 0 && skipped.first + window_ <= std::max(own, path_.begin_of_contour() + window_) &&
      skipped.last + 1 >= std::min(own + window_ + 1, end_of_contour()))
    return;
  // Only an arc turned inside out comes too near to its own block.
  const bool sees_own = !path_.is_contour(block) || path_.is_unreachable(block);
  const auto add = [&](NearFour four) {
    checkpoint_.pass();
    four.drop(skipped.first, skipped.last + 1);
    if (!sees_own) four.drop(own, own + 1);
    if (!all_are_walls_) keep_walls(four, own);
    if (window_ > 0) {
      four.drop(0, own - std::min(own, window_));
      four.drop(own + window_ + 1, end_of_contour());
    }
    if (four.bits != 0) neighbours_.push_back(four);
  };
  if (among == Among::all) {
    boxes_.for_each_four_near(area, limit, skipped, add);
    return;
  }
  const FourBoxes::Surroundings surroundings(area, limit);
  const bool is_among_few = block >= few_.first && block < few_.end;
  for (const NearFour& four : is_among_few ? few_.near : group_query_.near)
    if (const NearFour near = four.only(four.boxes->near(surroundings)); near.bits != 0) add(near);
}

bool Obstacles::are_many(const Box& area, double limit) const {
  std::size_t most = 0;
  for (const NearFour& four : neighbours_)
    most += static_cast<std::size_t>(std::popcount(four.bits));
  if (most <= few) return false;
  std::size_t count = 0;
  for (const NearFour& four : neighbours_) {
    four.for_each([&](std::size_t /*number*/, std::size_t place) {
      if (squared_distance(widened((*four.boxes)[place]), area) <= limit * limit) ++count;
    });
    if (count > few) return true;
  }
  return false;
}

bool Obstacles::are_many(const Box& area, const PathPart& part, double limit) const {
  const double farthest = limit + part.half_length();
  const float squared = squared_with_slack(farthest, part.middle());
  std::size_t count = 0;
  for (std::size_t index = 0; index < neighbours_.size(); ++index) {
    const NearFour& four = neighbours_[index];
    four.only(squares_[index].up_to(squared)).for_each([&](std::size_t number, std::size_t place) {
      if (squared_distance(widened((*four.boxes)[place]), area) <= limit * limit &&
          distance(part.middle(), programmed(number)) < farthest)
        ++count;
    });
    if (count > few) return true;
  }
  return false;
}

std::optional<std::size_t> Obstacles::nearest_to(const PathPart& part, double limit) const {
  checkpoint_.pass_many(neighbours_.size());
  // Boxes narrow the choice: a box farther off than the block in the nearest box is ruled out.
  const FourBoxes::Course course = part.course(limit);
  float least_squared = squared_with_slack(limit, part.middle());
  std::optional<std::size_t> in_nearest_box;
  squares_.clear();
  for (const NearFour& four : neighbours_) {
    const auto& squares = squares_.emplace_back(four.boxes->squared_distances(course));
    four.only(squares.up_to(least_squared)).for_each([&](std::size_t number, std::size_t place) {
      if (squares[place] > least_squared) return;
      least_squared = squares[place];
      in_nearest_box = number;
    });
  }
  if (!in_nearest_box) return std::nullopt;
  const auto apart_from = [&](std::size_t number) {
    return distance(part.middle(), programmed(number));
  };
  const float farthest =
      squared_with_slack(std::min(limit, apart_from(*in_nearest_box)), part.middle());
  double least = limit;
  std::optional<std::size_t> nearest;
  for (std::size_t index = 0; index < neighbours_.size(); ++index)
    neighbours_[index]
        .only(squares_[index].up_to(farthest))
        .for_each([&](std::size_t number, std::size_t /*place*/) {
          const double apart = apart_from(number);
          if (apart >= least) return;
          nearest = number;
          least = apart;
        });
  return nearest;
}

std::optional<Obstacles::Onset> Obstacles::onset(std::size_t block, double from, double to,
                                                 Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return std::nullopt;
  const Segment segment = path(block).path;
  const Box area = bounding_box(segment);
  find_neighbours(block, area, limit, near_blocks(block));
  if (neighbours_.empty()) return std::nullopt;
  PathPart part(segment, from, to);
  std::optional<Onset> first;
  const auto compare = [&](std::size_t number) {
    const auto entry = part.first_entry(programmed(number), reach_to(number, block, limit));
    if (!entry) return false;
    first = {*entry, number};
    part = part.until(*entry);
    return true;
  };
  // The path runs into the block nearest to its middle before the middle: the shorter part that is
  // left rules out most of the others.
  bool many = are_many(area, limit);
  while (many && part.half_length() > 0) {
    const std::optional<std::size_t> nearest = nearest_to(part, limit);
    if (!nearest) break;
    many = are_many(area, part, limit);
    if (!compare(*nearest)) break;
  }
  FourBoxes::Course course = part.course(limit);
  for (const NearFour& four : neighbours_)
    four.only(four.boxes->entered_by(course)).for_each([&](std::size_t number, std::size_t) {
      if (compare(number)) course = part.course(limit);
    });
  return first;
}

bool Obstacles::comes_nearer(std::size_t block, double from, double to, Nearness nearness) const {
  const double limit = reach(block, nearness);
  if (!(from < to) || limit <= 0) return false;
  const Segment segment = path(block).path;
  find_neighbours(block, bounding_box(segment), limit, near_blocks(block));
  return !neighbours_.empty() && neighbours_come_nearer(block, PathPart(segment, from, to), limit);
}

// The far end of an arc of half a turn or more may be in the way of a motion along its tangent.
bool Obstacles::own_arc_is_nearer(std::size_t number, const PathPart& part, double limit) const {
  const Segment own = programmed(number);
  const auto* arc = std::get_if<Arc>(&own);
  if (arc == nullptr || std::abs(arc->sweep) < Certificate::widest_arc) return false;
  if (!all_are_walls_ && !walls_.is_wall_for(number, number)) return false;
  return part.comes_nearer(own, reach_to(number, path_.contour_block(number).block, limit));
}

bool Obstacles::comes_nearer(std::size_t block, const Segment& way, Nearness nearness) const {
  const double limit = reach(block, nearness);
  const double length = length_of(way);
  if (length == 0 || limit <= 0) return false;
  const PathPart part(way, 0, length);
  if (path_.is_contour(block) && own_arc_is_nearer(path_.number_of(block), part, limit))
    return true;
  find_neighbours(block, bounding_box(way), limit, Among::all);
  return !neighbours_.empty() && neighbours_come_nearer(block, part, limit);
}

bool Obstacles::neighbours_come_nearer(std::size_t block, const PathPart& part,
                                       double limit) const {
  const FourBoxes::Course course = part.course(limit);
  bool nearer = false;
  for (const NearFour& four : neighbours_) {
    four.only(four.boxes->entered_by(course)).for_each([&](std::size_t number, std::size_t) {
      nearer = nearer || part.comes_nearer(programmed(number), reach_to(number, block, limit));
    });
    if (nearer) return true;
  }
  return false;
}

const std::vector<std::size_t>& Obstacles::at(std::size_t block, const Point& place,
                                              std::size_t obstacle, Nearness nearness) const {
  numbers_.assign(1, obstacle);
  const double limit = reach(block, nearness) + tolerances_.same_point;
  const auto consider = [&](std::size_t number) {
    const HeldPath::ContourBlock other = path_.contour_block(number);
    if (number == obstacle || other.block == block) return;
    if (!all_are_walls_ && !walls_.is_wall_for(number, path_.number_of(block))) return;
    if (distance(place, programmed(number)) <= limit) numbers_.push_back(number);
  };
  const auto consider_four = [&](const NearFour& four) {
    four.for_each([&](std::size_t number, std::size_t /*place*/) { consider(number); });
  };
  // Certified blocks were left out of the query.
  const auto [first, last] = group_query_.skipped;
  constexpr std::size_t short_chain = 16;
  if (!is_in_group(block) || last > first + short_chain) {
    boxes_.for_each_four_near(Box(place), limit, BoxTree::Range{}, consider_four);
    put_first_visits_in_front(block, place, limit);
    return numbers_;
  }
  const FourBoxes::Surroundings surroundings(Box(place), limit);
  for (const NearFour& four : group_query_.near)
    consider_four(four.only(four.boxes->near(surroundings)));
  for (std::size_t number = std::max(first, path_.begin_of_contour()); number <= last; ++number)
    consider(number);
  std::sort(numbers_.begin() + 1, numbers_.end());
  put_first_visits_in_front(block, place, limit);
  return numbers_;
}

// First visits lead on sooner: after an inside corner that the tool does not fit into, the path
// goes on along the beginning of the contour, which is a lead, not a whole round later.
void Obstacles::put_first_visits_in_front(std::size_t block, const Point& place,
                                          double limit) const {
  if (walls_.blocks_per_lap == 0) return;
  const std::size_t own = path_.number_of(block);
  if (own >= walls_.head.end) return;
  const std::size_t known = numbers_.size();
  for (std::size_t index = 0; index < known; ++index) {
    const auto first = first_visit_of(numbers_[index]);
    if (first && *first > own &&
        distance(place, path_.contour_block(*first).programmed) <= limit + walls_.touch)
      numbers_.push_back(*first);
  }
  std::rotate(numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(known),
              numbers_.end());
}

bool Obstacles::is_in_group(std::size_t block) const {
  if (block >= group_query_.first && block < group_query_.end) return true;
  if (group_query_.near.empty() || path_.radius_of_tool(block) > group_query_.radius) return false;
  if (!group_query_.area.contains(bounding_box(path(block).path))) return false;
  const BoxTree::Range own = certified(block);
  return group_query_.skipped.last < group_query_.skipped.first ||
         (own.first <= group_query_.skipped.first && group_query_.skipped.last <= own.last);
}

// Queries many blocks at once: they have nearly the same neighbours, and usually none.
void Obstacles::query_group(std::size_t first) {
  // If the walk leaves blocks out, smaller groups are better, and the more so the more neighbours
  // they have.
  constexpr std::size_t smallest_group = 4;
  constexpr std::size_t largest_group = 32;
  const bool worth_it =
      first == group_query_.end || (4 * asked_for_ >= group_ && group_query_.near.size() <= group_);
  group_ = worth_it ? std::min(2 * group_, largest_group) : std::max(group_ / 2, smallest_group);
  asked_for_ = 0;
  group_query_.first = first;
  group_query_.end = std::min(first + group_, path_.end());
  const HeldPath::Bounds bounds = path_.bounds_of(first, group_query_.end);
  group_query_.area = bounds.area;
  group_query_.radius = bounds.radius;
  group_query_.skipped =
      bounds.reachable ? certified_for_all(first, group_query_.end) : BoxTree::Range{};
  group_query_.near.clear();
  boxes_.for_each_four_near(group_query_.area, group_query_.radius + tolerances_.same_point,
                            group_query_.skipped,
                            [&](const NearFour& four) { group_query_.near.push_back(four); });
  few_.first = few_.end = first;
}

void Obstacles::look_closer() {
  constexpr std::size_t a_few = 4;
  few_.first = few_.end;
  few_.end = std::min(few_.first + a_few, group_query_.end);
  few_.near.clear();
  const HeldPath::Bounds bounds = path_.bounds_of(few_.first, few_.end);
  const BoxTree::Range skipped =
      bounds.reachable ? certified_for_all(few_.first, few_.end) : BoxTree::Range{};
  const FourBoxes::Surroundings surroundings(bounds.area, bounds.radius + tolerances_.same_point);
  for (const NearFour& four : group_query_.near) {
    NearFour near = four.only(four.boxes->near(surroundings));
    near.drop(skipped.first, skipped.last + 1);
    if (near.bits != 0) few_.near.push_back(near);
  }
}

// Chains that begin later end later: the part that the chains of the first and the last block share
// is in the chains of all blocks between.
BoxTree::Range Obstacles::certified_for_all(std::size_t first, std::size_t end) const {
  const std::size_t first_number = path_.number_of(first);
  // The last block may be a transition.
  const std::size_t last_number = path_.number_of(end - 1) + (path_.is_contour(end - 1) ? 0 : 1);
  if (last_number == end_of_contour()) return {};
  const std::size_t common = certificate_.chain_before(last_number);
  if (common > first_number) return {};
  return {common, certificate_.chain_behind(first_number)};
}

}  // namespace trc
