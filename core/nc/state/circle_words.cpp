#include "core/nc/state/circle_words.h"

#include <array>

#include "core/nc/text/number_format.h"

namespace trc {
namespace {

using AxisLetters = std::array<char, 3>;

// "X0 Y40", "I25 J0"
std::string words_of(const AxisLetters& letters, const Point& point, const CircleWords& words) {
  const PlaneAxes axes = axes_of(words.plane);
  const int decimals = words.unit == LengthUnit::inch ? 4 : 3;
  const double unit = mm_of(words.unit);
  std::string text(1, letters[axes.first]);
  append_units(text, to_units(point.x() / unit, decimals), decimals);
  text.append(1, ' ').append(1, letters[axes.second]);
  append_units(text, to_units(point.y() / unit, decimals), decimals);
  return text;
}

}  // namespace

std::string told_circle(const CircleEnds& ends, const std::optional<Point>& center,
                        const CircleWords& words) {
  constexpr AxisLetters of_ends{'X', 'Y', 'Z'};
  constexpr AxisLetters of_center{'I', 'J', 'K'};
  std::string way =
      words_of(of_ends, ends.start, words) + " → " + words_of(of_ends, ends.end, words);
  if (!center) return way;
  if (words.klartext) return "CC " + words_of(of_ends, *center, words) + ", " + way;
  const Point base = words.absolute_center ? Point(Point::Zero()) : ends.start;
  return words_of(of_center, *center - base, words) + ", " + way;
}

}  // namespace trc
