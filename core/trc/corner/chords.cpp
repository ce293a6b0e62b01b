#include "core/trc/corner/chords.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace trc {
namespace {

// How a corner divides its cut: the shares of both paths are 1 + y and 1 - y of its half. The two
// paths meet where both have bent as far from their tangents, so that
// y = a·(1 + y)² - b·(1 - y)² with the bends a and b.
double unevenness(double before, double after) {
  const double difference = before - after;
  const double linear = 1 - 2 * (before + after);
  const double square = linear * linear - 4 * difference * difference;
  if (linear <= 0 || square < 0) return std::copysign(1, difference);
  return std::clamp(2 * difference / (linear + std::sqrt(square)), -1.0, 1.0);
}

// A chord of its kind: an arc that stays, or a line for so many blocks.
constexpr std::size_t kinds = most_joined_blocks + 1;
std::size_t kind_of(const Chord& chord) {
  return chord.count == 1 && !chord.straight ? 0 : chord.count;
}

class Division {
 public:
  Division(const std::vector<ChordChoice>& choices, std::size_t blocks, double shift)
      : endings_(blocks + 1), shift_(shift) {
    for (const ChordChoice& choice : choices)
      if (choice.chord.count <= most_joined_blocks)
        endings_[choice.chord.first + choice.chord.count][kind_of(choice.chord)].choice = &choice;
  }

  [[nodiscard]] std::vector<Chord> cheapest(const std::optional<ChordCourse>& before,
                                            const std::optional<ChordCourse>& behind) {
    for (std::array<Ending, kinds>& kinds_here : endings_)
      for (Ending& ending : kinds_here)
        if (ending.choice != nullptr) reach(ending, before);
    return back_from(cheapest_end(behind));
  }

 private:
  // The way that leads to a chord, for each kind of the chord before it.
  struct Way {
    double cost = INFINITY;
    double cut = 0;  // from the chord, at its start, mm
    std::size_t two_before = kinds;
  };
  // No chord comes before the first one, which is a kind too.
  struct Ending {
    const ChordChoice* choice = nullptr;
    std::array<Way, kinds + 1> ways{};
  };
  struct Place {
    std::size_t end = 0;
    std::size_t kind = kinds;
    std::size_t before = kinds;
  };

  void reach(Ending& ending, const std::optional<ChordCourse>& before) {
    const ChordChoice& choice = *ending.choice;
    if (choice.chord.first == 0) {
      const ChordCut cut = before ? cut_by_rounding(*before, choice.course, shift_) : ChordCut{};
      if (!before || cut.before <= before->room)
        ending.ways[kinds] = {.cost = choice.cost, .cut = cut.after};
      return;
    }
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const Ending& other = endings_[choice.chord.first][kind];
      if (other.choice == nullptr) continue;
      const ChordCut cut = cut_by_rounding(other.choice->course, choice.course, shift_);
      for (std::size_t two_before = 0; two_before <= kinds; ++two_before) {
        const Way& way = other.ways[two_before];
        const double cost = way.cost + choice.cost;
        if (cost < ending.ways[kind].cost && way.cut + cut.before <= other.choice->course.room)
          ending.ways[kind] = {.cost = cost, .cut = cut.after, .two_before = two_before};
      }
    }
  }

  [[nodiscard]] Place cheapest_end(const std::optional<ChordCourse>& behind) const {
    Place place{.end = endings_.size() - 1};
    double cost = INFINITY;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const Ending& ending = endings_.back()[kind];
      if (ending.choice == nullptr) continue;
      const ChordCourse& course = ending.choice->course;
      const double cut = behind ? cut_by_rounding(course, *behind, shift_).before : 0;
      for (std::size_t before = 0; before <= kinds; ++before) {
        const Way& way = ending.ways[before];
        if (way.cost >= cost || (behind && way.cut + cut > course.room)) continue;
        cost = way.cost;
        place.kind = kind;
        place.before = before;
      }
    }
    return place;
  }

  [[nodiscard]] std::vector<Chord> back_from(Place place) const {
    std::vector<Chord> chords;
    while (place.kind < kinds) {
      const Ending& ending = endings_[place.end][place.kind];
      chords.push_back(ending.choice->chord);
      place = {.end = ending.choice->chord.first,
               .kind = place.before,
               .before = ending.ways[place.before].two_before};
    }
    std::ranges::reverse(chords);
    return chords;
  }

  std::vector<std::array<Ending, kinds>> endings_;
  double shift_;
};

}  // namespace

ChordCourse course_of(const Segment& path, double shift) {
  const auto* arc = std::get_if<Arc>(&path);
  if (arc == nullptr) {
    const Line& line = std::get<Line>(path);
    const auto [direction, length] = directed(line.end - line.start);
    return {.at_start = direction, .at_end = direction, .room = length};
  }
  // Where the tool does not fit next to nothing is left. This share of what is bent away keeps the
  // bend finite: beside a line, such an arc gives a sixteenth of its half to the corner.
  constexpr double least_room = 1e-3;
  const double bent = shift * arc->sweep;
  const double room = length_of(*arc) - bent;
  return {.at_start = tangent_at(arc->start, *arc),
          .at_end = tangent_at(arc->end, *arc),
          .room = room,
          .bend = -bent / (4 * std::max(room, least_room * std::abs(bent)))};
}

ChordCut cut_between(const ChordCourse& before, const ChordCourse& after, double shift) {
  const double sine = cross(before.at_end, after.at_start);
  const double cosine = before.at_end.dot(after.at_start);
  if (cosine < 0) {
    const double all = sine * shift > 0 ? std::abs(shift) : 0;
    return {.before = all, .after = all};
  }
  const double half = std::max(shift * sine / (1 + cosine), 0.0);  // R·tan(β/2)
  if (before.bend == after.bend) return {.before = half, .after = half};
  const double uneven = unevenness(before.bend, after.bend);
  return {.before = half * (1 + uneven), .after = half * (1 - uneven)};
}

ChordCut cut_by_rounding(const ChordCourse& before, const ChordCourse& after, double shift) {
  if (before.at_end.dot(after.at_start) <= 0) return {};
  return cut_between(before, after, shift);
}

std::vector<Chord> cheapest_division(const std::vector<ChordChoice>& choices, std::size_t blocks,
                                     const std::optional<ChordCourse>& before,
                                     const std::optional<ChordCourse>& behind, double shift) {
  return Division(choices, blocks, shift).cheapest(before, behind);
}

}  // namespace trc
