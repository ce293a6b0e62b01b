#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "core/base/numbered_queue.h"
#include "core/geometry/four_boxes.h"
#include "core/geometry/segment.h"

namespace trc {

[[nodiscard]] inline Box bounding_box(const Point& start, const Point& end) {
  return {start.cwiseMin(end), start.cwiseMax(end)};
}
[[nodiscard]] Box bounding_box(const Arc& arc);
[[nodiscard]] inline Box bounding_box(const Line& line) {
  return bounding_box(line.start, line.end);
}
[[nodiscard]] inline Box bounding_box(const Segment& segment) {
  const auto* arc = std::get_if<Arc>(&segment);
  return arc != nullptr ? bounding_box(*arc) : bounding_box(std::get<Line>(segment));
}

// Finds the near ones of many boxes. They stay in the order of a path: neighbours
// on the path are neighbours in space, so the tree needs no sorting, can grow at
// its end and be dropped from its start. A query costs O(log n + hits) on
// contours.
//
//     [    0 1 2 3     ] [    4 5 6 7     ]        Four boxes in a row have one about
//     [0] [1] [2] [3]    [4] [5] [6] [7]   [8]     them, four of those too, and so on,
//                                                  as soon as there are four.
class BoxTree {
 public:
  // Numbers from first to last; none if last < first.
  struct Range {
    std::size_t first = 1;
    std::size_t last = 0;
  };

  // The first box will have the number `first`.
  explicit BoxTree(std::size_t first = 0) : begin_(first) { levels_.emplace_back(first); }

  void append(const Box& box);
  // Forgets the boxes from `number` on.
  void truncate(std::size_t number);
  // Forgets the boxes before `number`.
  void drop_before(std::size_t number);
  // Forgets all; the next box has the number `first`.
  void clear(std::size_t first = 0);

  // A box; what is kept of it may be larger by the rounding of a float.
  [[nodiscard]] KeptBox operator[](std::size_t number) const {
    return levels_.front().fours[number / FourBoxes::count][number % FourBoxes::count];
  }

  // Calls visit(four) with every box not farther than `reach` mm from `area`, those in `skipped`
  // left out, and maybe some that are a little farther; in ascending order. More may be skipped
  // while it goes on.
  template <class Visit>
  void for_each_four_near(const Box& area, double reach, const Range& skipped, Visit visit) const {
    const Search<Visit> search{{area, reach}, skipped, visit};
    // On each level, the boxes not yet within a box of the next level.
    for (std::size_t level = levels_.size(); level-- > 0;) {
      const auto& [fours, end] = levels_[level];
      if (end % FourBoxes::count != 0 && !fours.empty())
        descend(search, level, end / FourBoxes::count);
    }
  }
  // Calls visit(number) for every box not farther than `reach` mm from `area`, in
  // ascending order, those in `skipped` left out.
  template <class Visit>
  void for_each_near(const Box& area, double reach, const Range& skipped, Visit visit) const {
    for_each_four_near(area, reach, skipped, [&](const NearFour& four) {
      four.for_each([&](std::size_t number, std::size_t place) {
        if (squared_distance(widened((*four.boxes)[place]), area) <= reach * reach) visit(number);
      });
    });
  }
  template <class Visit>
  void for_each_near(const Box& area, double reach, Visit visit) const {
    for_each_near(area, reach, Range{}, visit);
  }

 private:
  static constexpr std::size_t bits_of_width = 2;
  static_assert(FourBoxes::count == 1U << bits_of_width);

  struct Level {
    explicit Level(std::size_t first) : fours(first / FourBoxes::count), end(first) {}

    // Returns whether there are four in a row now.
    bool add(const KeptBox& box) {
      const std::size_t place = end++ % FourBoxes::count;
      if (place == 0 || fours.empty()) fours.push_back({});
      fours.back().set(place, box);
      return place + 1 == FourBoxes::count;
    }

    NumberedQueue<FourBoxes> fours;
    std::size_t end;  // of the boxes
  };
  template <class Visit>
  struct Search {
    FourBoxes::Surroundings surroundings;
    const Range& skipped;
    Visit& visit;
  };

  // The last four boxes have one about them.
  void add_above();

  // The boxes of level 0 under one of `level`, as a shift.
  [[nodiscard]] static std::size_t span_bits(std::size_t level) { return bits_of_width * level; }

  template <class Visit>
  void descend(const Search<Visit>& search, std::size_t level, std::size_t four) const {
    const FourBoxes& boxes = levels_[level].fours[four];
    FourBoxes::Bits near = boxes.near(search.surroundings);
    if (level == 0) {
      NearFour found{&boxes, four * FourBoxes::count, near};
      found.drop(0, begin_);
      found.drop(search.skipped.first, search.skipped.last + 1);
      if (found.bits != 0) search.visit(found);
      return;
    }
    for (; near != 0; near &= near - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(near));
      const std::size_t number = four * FourBoxes::count + place;
      const std::size_t first = number << span_bits(level);
      const std::size_t last = first + (std::size_t{1} << span_bits(level)) - 1;
      if (last < begin_ || (first >= search.skipped.first && last <= search.skipped.last)) continue;
      descend(search, level - 1, number);
    }
  }

  std::size_t begin_;
  std::vector<Level> levels_;  // 0: the boxes
};

}  // namespace trc
