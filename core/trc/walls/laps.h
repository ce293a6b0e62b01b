#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/trc/walls/rings.h"

namespace trc {

// Decides which rings of a contour are laps and which lead from one lap to the next (D-38, D-57). A
// ring has the number of the visit that it ends with, from 1 on.
class Laps {
 public:
  Laps(const ContourView& contour, const Closing& closing, double tolerance,
       std::pmr::memory_resource* memory);

  [[nodiscard]] std::span<const Visit> visits() const { return visits_; }
  // Lead-out, step, lead-in: few blocks, shorter than a quarter of the longest ring, and between
  // two equal laps or not round the material beyond the walls. Between two such laps a longer ring
  // is a lead too, where it goes round something on the side of the tool.
  [[nodiscard]] bool is_lead(std::size_t ring) const { return are_leads_[ring]; }
  // If not, the contour goes round several parts that touch in one point.
  [[nodiscard]] bool go_over_one_another() const { return go_over_one_another_; }
  // Whether the last lap finishes what the others have roughed: it is deeper everywhere (D-100).
  [[nodiscard]] bool last_one_finishes() const { return last_one_finishes_; }

 private:
  // The nearest rings before and after a ring that are not short, and whether the one after goes
  // over the one before; 0 and the number of visits where there are none.
  struct Neighbours {
    std::size_t before = 0;
    std::size_t behind = 0;
    bool are_one_lap = false;
  };

  // `about`: in, the neighbours of the ring before.
  void find_neighbours(std::size_t ring, Neighbours& about) const;
  [[nodiscard]] bool leads_on(std::size_t ring, const Neighbours& about) const;
  [[nodiscard]] bool is_short(std::size_t ring) const;
  // Above 0: the ring goes round the material on the tool side of a lap; below 0: round something
  // else; 0: round nothing, or the side of the tool is unknown.
  [[nodiscard]] int side_of(std::size_t ring, std::size_t lap) const;
  // The place at `way` mm from the start of the contour, at `from` or after it.
  [[nodiscard]] ContourPlace place_at(double way, const Visit& from) const;
  // Whether at least half of a ring lies on another one.
  [[nodiscard]] bool goes_over(std::size_t ring, std::size_t earlier) const;
  // Whether a ring goes round the same part as an earlier one, which leaves material all round.
  [[nodiscard]] bool finishes(std::size_t ring, std::size_t earlier) const;
  // `guess`: the block most likely to come by.
  [[nodiscard]] bool comes_by(std::size_t ring, const Point& point, std::size_t guess) const;
  [[nodiscard]] double length_of_ring(std::size_t ring) const {
    return visits_[ring].way - visits_[ring - 1].way;
  }

  const ContourView& contour_;
  double near_;
  Visits visits_;
  double longest_ = 0;
  std::pmr::vector<bool> are_leads_;
  bool go_over_one_another_ = true;
  bool last_one_finishes_ = false;
};

}  // namespace trc
