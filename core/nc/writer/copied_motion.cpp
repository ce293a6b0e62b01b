#include <algorithm>
#include <cmath>

#include "core/base/length_unit.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"
#include "core/nc/writer/nc_writer.h"
#include "core/nc/writer/written_block.h"

// The lines that still make the motion of their block and are copied.

namespace trc {
namespace {

// mm; a reader takes the start of a copied arc for the programmed one.
constexpr double same_start = 1e-9;

// Whether the block runs the whole programmed path, under a radius of 0 (D-119).
bool is_programmed_path(const NcWriter::Meaning& meaning, const CompensatedBlock& block) {
  const bool may_be = block.origin == Origin::programmed || block.origin == Origin::approach ||
                      block.origin == Origin::retract;
  return meaning.keeps_place && may_be &&
         (end_of(block.path) - to_plane(block.plane, meaning.end)).norm() <= same_start;
}

// Angles may count from the angle of a line that is rewritten.
bool has_polar_words(const ProgramLine& line) {
  return std::ranges::any_of(line.words, [&](const WordRange& word) {
    return word.role == WordRole::coordinate && is_polar(line, word);
  });
}

// Whether X, Y and Z of the line of Klartext are numbers, and equal the end of the block.
bool names_end(const ProgramLine& line, const CompensatedBlock& block) {
  const Position end = from_plane(block.plane, end_of(block.path), block.normal.to);
  return std::ranges::all_of(line.words, [&](const WordRange& range) {
    if (range.role != WordRole::coordinate) return true;
    const std::string_view word = line.word(range);
    const std::size_t axis = std::string_view("XYZ").find(upper(word.front()));
    if (axis == std::string_view::npos) return false;
    double value = 0;
    const std::string_view number = without_blanks_in_front(word.substr(1));
    return read_klartext_number(number, value) == number.size() &&
           std::abs(value * mm_of(line.unit) - end.at(axis)) <= same_start;
  });
}

// In Klartext a block may end where the next line rounds its corner, and arcs and polar words
// depend on lines that are rewritten. Only a straight line to a position of its own words is
// independent.
bool stands_for_itself(const ProgramLine& line, const CompensatedBlock& block) {
  if (!line.klartext) return true;
  const auto name = std::ranges::find(line.words, WordRole::motion, &WordRange::role);
  return name != line.words.end() && in_upper_case(line.word(*name)) == "L" &&
         line.klartext->increments == 0 && names_end(line, block);
}

}  // namespace

bool NcWriter::copy_motion(const WaitingLine& own, const CompensatedBlock& block,
                           std::string& out) {
  const ProgramLine& line = *own.line;
  const bool stays_in_contour = is_programmed_path(own.meaning, block) && !has_polar_words(line) &&
                                stands_for_itself(line, block);
  if (block.origin != Origin::uncompensated && !stays_in_contour) return false;
  if (line.has_trc_words || !line.is_motion) return false;
  if (line.motion != kind_of(block)) return false;
  if (!own.line->has(WordRole::motion) && line.motion != state_.motion) return false;
  if (is_arc(block.path) && line.plane != block.plane) return false;
  if (!block.rapid && block.feed > 0 && !own.line->has(WordRole::feed) && !has_feed(block))
    return false;
  if (!own.line->has(WordRole::feed) && lacks_open_feed(block)) return false;
  if (line.klartext && !has_what_it_counts_on(line, block)) return false;
  after_.position = state_.position;
  after_.tracking = state_.tracking;
  if (!reads_as(own, block, after_)) return false;

  enter_modes(own);
  if (line.klartext) {
    const Point pole(line.klartext->pole_x, line.klartext->pole_y);
    if (line.klartext->needs_pole && state_.pole_written) write_pole(pole, block.plane, out);
    enter_klartext(line, LineForm::copied);
    state_.pole_written &= !line.klartext->needs_pole;
  }
  copied_index_ = line.source.index;
  state_.position = after_.position;
  state_.tracking = after_.tracking;
  if (own.line->has(WordRole::feed)) enter_feed(line);
  state_.motion = line.motion;
  write_line(line, out);
  own_ = nullptr;
  return true;
}

bool NcWriter::reads_as(const WaitingLine& own, const CompensatedBlock& block,
                        WrittenState& after) const {
  const ProgramLine& line = *own.line;
  const AxisSet named = axes_named_in(line);
  const AxisSet in_plane = plane_axes(block.plane);
  const bool flat = moves_in_plane(block);
  const Position start = from_plane(block.plane, start_of(block.path), block.normal.from);
  const Position end = from_plane(block.plane, end_of(block.path), block.normal.to);
  for (std::size_t axis = 0; axis < end.size(); ++axis) {
    const AxisSet bit = axis_bit(axis);
    double& position = after.position[axis];
    // The centre may count from the start, so an arc must begin exactly there.
    if (is_arc(block.path) && (in_plane & bit) != 0 &&
        !(std::abs(position - start[axis]) <= same_start))
      return false;
    // Without motion in the plane the block stays where TRC has put it, and the words of the line
    // name the programmed position.
    if (!flat && (in_plane & named & bit) != 0 &&
        !motions_.reaches(end[axis], own.meaning.end[axis], line.unit))
      return false;
    if ((named & bit) != 0)
      position = line.incremental || (line.klartext && (line.klartext->increments & bit) != 0)
                     ? position + (end[axis] - start[axis])
                     : end[axis];
    if (!motions_.reaches(end[axis], position, line.unit)) return false;
  }
  for (std::size_t axis = 0; axis < block.tracking.size(); ++axis) {
    const AxisTravel& travel = block.tracking[axis];
    double& position = after.tracking[axis];
    if ((named & axis_bit(end.size() + axis)) != 0)
      position = line.incremental ? position + (travel.to - travel.from) : travel.to;
    if (!motions_.reaches_tracking(axis, travel.to, position, line.unit)) return false;
  }
  return true;
}

bool NcWriter::has_what_it_counts_on(const ProgramLine& line, const CompensatedBlock& block) const {
  const KlartextLine& says = *line.klartext;
  if (says.needs_tangent && state_.other_tangent) return false;
  if (says.needs_polar_radius && state_.other_radius) return false;
  if (!says.counts_from_start) return true;
  const Position start = from_plane(block.plane, start_of(block.path), block.normal.from);
  return std::ranges::equal(state_.position, start,
                            [](double a, double b) { return std::abs(a - b) <= same_start; });
}

}  // namespace trc
