#include "tests/support/slow_masking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/slow_shapes.h"

namespace trc::support {
namespace {

constexpr Extended pi = std::numbers::pi_v<Extended>;
// In parts of the size of the drawing: what extended precision leaves of a touch,
// what the rounded corners of a contour leave of a tangential joint, and how near a
// limit is to the block it belongs to.
constexpr Extended touch = 1e-17L;
constexpr Extended joint = 1e-10L;
constexpr Extended on_limit = 1e-9L;
// What the rounded corners of a contour leave of a distance.
constexpr Extended exact = 1e-13L;
constexpr Extended reversal_angle = 1e-7L;  // rad
// D-44, mm: the kink of a seam, and what a coordinate is rounded to.
constexpr Extended no_gouge = 1e-4L;
constexpr Extended input_resolution = 1e-3L;

// A whole equidistant or an inserted arc.
struct Element {
  Shape shape{};
  std::size_t block = 0;  // an arc: the one after the corner
  bool inserted = false;
};

// One kept piece of an element.
struct Piece {
  Extended from = 0;
  Extended to = 0;
  std::size_t element = 0;
  std::size_t part = 0;  // counts all pieces of the element, the dropped ones too
  ExtendedPoint start{};
  ExtendedPoint end{};
};

class Masking {
 public:
  Masking(const Contour& contour, const TrcMode& mode, const MaskingScale& scale)
      : radius_(mode.tool_radius),
        shift_(mode.side == Side::left ? radius_ : -radius_),
        mitres_(mode.transition == Transition::linear),
        longest_leg_(static_cast<Extended>(mode.options.stretch_factor) * radius_),
        scale_(scale) {
    for (std::size_t k = 0; k < contour.blocks.size(); ++k) {
      const Shape block = shape_of(contour.blocks[k]);
      if (block.extent == 0) continue;
      blocks_.push_back(block);
      ordinals_.push_back(k + 1);
      size_ = std::max({size_, length(block.start), length(block.end),
                        length(block.carrier.point) + block.carrier.radius});
    }
    size_ += radius_;
  }

  SlowMasking result() {
    SlowMasking found;
    if (blocks_.empty()) return found;
    lay_elements();
    draw_limits();
    for (std::size_t k = 0; k < elements_.size(); ++k) cut(k);
    const bool reached = reach_the_end();
    found.tied = tied_;
    found.shallow = shallow_;
    found.rounded = has_tiny_block() || has_kinked_seam();
    if (!reached || goes_nowhere()) return found;
    for (std::size_t at = 0; at < way_.size(); ++at)
      if (const std::size_t parts = whole_arc(at); parts == 0 || !add_mitre(at, found)) {
        add_piece(pieces_[way_[at]], found);
      } else {
        at += parts - 1;
      }
    return found;
  }

 private:
  static Shape beside(const Shape& block, Extended shift) {
    const auto move = [&](Extended way) {
      return block.at(way) + shift * left_normal(block.heading(way));
    };
    if (!block.carrier.round) return line_shape(move(0), move(block.extent));
    return arc_shape(block.carrier.point, move(0), block.sweep);
  }

  // Whether two blocks that reverse in one point leave a slit on the tool side: no tip to go round
  // (D-05 as this project reads it, D-44). The first gap that counts decides.
  [[nodiscard]] bool leaves_slit(const Shape& before, const Shape& after) const {
    Extended reach = std::min(before.extent, after.extent);
    for (const Shape* block : {&before, &after})
      if (block->carrier.round) reach = std::min(reach, block->carrier.radius);
    constexpr int steps = 1000;
    for (int step = 1; step <= steps; ++step) {
      const Extended way = reach * step / steps;
      const ExtendedPoint back = before.at(before.extent - way);
      // A tool left of the contour is to the left of the way there.
      const Extended gap = (shift_ > 0 ? -1 : 1) * cross(after.heading(0), after.at(way) - back);
      if (std::abs(gap) > 1e-3L) return gap > 0;
    }
    return false;
  }

  // On the tool side, the equidistant of a block; nothing where the arc would turn
  // inside out, a point where it just vanishes.
  void lay_elements() {
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Shape& block = blocks_[k];
      if (k > 0) {
        const ExtendedPoint before = blocks_[k - 1].heading(blocks_[k - 1].extent);
        const ExtendedPoint after = block.heading(0);
        // Away from the tool, in rad.
        Extended turn = std::atan2(cross(before, after), dot(before, after));
        if (shift_ > 0) turn = -turn;
        if (dot(before, after) < 0 && std::abs(cross(before, after)) <= 0.1L)
          turn = leaves_slit(blocks_[k - 1], block) ? 0 : turn > 0 ? turn : turn + 2 * pi;
        if (turn > 0) {
          const ExtendedPoint corner = block.start;
          const Shape arc =
              arc_shape(corner, corner + shift_ * left_normal(before), shift_ > 0 ? -turn : turn);
          elements_.push_back({arc, k, true});
        }
      }
      const bool bends_in = block.carrier.round && (block.sweep > 0) == (shift_ > 0);
      if (bends_in && block.carrier.radius < radius_ - exact * size_) {
        judge(clearance(beside(block, shift_).start));
        judge(clearance(beside(block, shift_).end));
        continue;
      }
      elements_.push_back({beside(block, shift_), k, false});
    }
    first_ = blocks_.front().start + shift_ * left_normal(blocks_.front().heading(0));
    last_ =
        blocks_.back().end + shift_ * left_normal(blocks_.back().heading(blocks_.back().extent));
  }

  void add_piece(const Piece& piece, SlowMasking& found) const {
    const Element& element = elements_[piece.element];
    Shape shape = element.shape;
    shape.start = piece.start;
    shape.end = piece.end;
    shape.extent = piece.to - piece.from;
    if (shape.carrier.round)
      shape.sweep *= element.shape.extent > 0 ? shape.extent / element.shape.extent : 0;
    found.path.push_back({.path = segment_of(shape),
                          .ordinal = ordinals_[element.block - (element.inserted ? 1 : 0)],
                          .inserted = element.inserted});
  }

  // How many pieces from this one on are all of an inserted arc, between the end of the block
  // before it and the start of the one after it.
  [[nodiscard]] std::size_t whole_arc(std::size_t at) const {
    const Piece& first = pieces_[way_[at]];
    const Element& arc = elements_[first.element];
    if (!mitres_ || !arc.inserted || first.from > 0) return 0;
    std::size_t behind = at;
    while (behind < way_.size() && pieces_[way_[behind]].element == first.element) ++behind;
    // A last piece that is next to nothing is none.
    const auto ends = [&](std::size_t piece) {
      return together(pieces_[piece].end, elements_[pieces_[piece].element].shape.end);
    };
    if (behind == way_.size() || !ends(way_[behind - 1])) return 0;
    // Where nothing is left of a neighbour, it may count as travelled or not.
    if (scale_.lenient) return behind - at;
    if (at == 0) return 0;
    const Element& block_before = elements_[pieces_[way_[at - 1]].element];
    const Piece& after = pieces_[way_[behind]];
    const Element& block_after = elements_[after.element];
    const bool beside = !block_before.inserted && block_before.block + 1 == arc.block &&
                        ends(way_[at - 1]) && !block_after.inserted &&
                        block_after.block == arc.block && after.from == 0;
    return beside ? behind - at : 0;
  }

  // D-45. G25 in place of the arc: lines go on as themselves, arcs in tangents, up to where they
  // meet or STRETCH_FACTOR ends them (rules 4.2 and 4.3); where that keeps clear.
  [[nodiscard]] bool add_mitre(std::size_t at, SlowMasking& found) {
    const Element& arc = elements_[pieces_[way_[at]].element];
    const std::size_t k = arc.block;
    const ExtendedPoint before = blocks_[k - 1].heading(blocks_[k - 1].extent);
    const ExtendedPoint after = blocks_[k].heading(0);
    const Extended turn = std::abs(arc.shape.sweep);
    const ExtendedPoint& corner = blocks_[k].start;
    const ExtendedPoint end = corner + shift_ * left_normal(before);
    const ExtendedPoint start = corner + shift_ * left_normal(after);
    const bool reversal = turn > pi - reversal_angle;
    const Extended to_tip = reversal ? 2 * longest_leg_ : radius_ * std::tan(turn / 2);
    const Extended leg = std::min(to_tip, longest_leg_);
    const ExtendedPoint far_end = end + leg * before;
    const ExtendedPoint far_start = start - leg * after;
    const Shape lines[] = {line_shape(end, far_end), line_shape(far_end, far_start),
                           line_shape(far_start, start)};
    for (const Shape& line : lines)
      for (const Shape& block : blocks_)
        if (distance(line, block) < radius_ - 1e-6L * std::max(radius_, 1.0L)) return false;
    for (const ExtendedPoint& point : {first_, last_})
      if (is_between(point, corner, {end, far_end, far_start, start})) return false;
    const bool round[] = {blocks_[k - 1].carrier.round, true, blocks_[k].carrier.round};
    const std::size_t ordinals[] = {ordinals_[k - 1], ordinals_[k - 1],
                                    ordinals_[round[2] ? k - 1 : k]};
    for (std::size_t number = 0; number < 3; ++number)
      if (number != 1 || to_tip > longest_leg_)
        found.path.push_back({.path = segment_of(lines[number]),
                              .ordinal = ordinals[number],
                              .inserted = round[number]});
    return true;
  }

  // Whether the point lies within the corners, which are in order, but out of the tool radius.
  [[nodiscard]] bool is_between(const ExtendedPoint& point, const ExtendedPoint& center,
                                const std::array<ExtendedPoint, 4>& corners) const {
    if (length(point - center) <= radius_ + 1e-6L) return false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const ExtendedPoint side = corners[(k + 1) % corners.size()] - corners[k];
      // Left of the contour they go round clockwise.
      const Extended inside = (shift_ > 0 ? -1 : 1) * cross(side, point - corners[k]);
      if (length(side) > 0 && inside <= 1e-6L * length(side)) return false;
    }
    return true;
  }

  // Everything that is at the distance of the radius to a block: both its
  // equidistants and the circles about its ends.
  void draw_limits() {
    const auto circle = [](const ExtendedPoint& center, Extended radius) {
      return Carrier{.round = true, .point = center, .along = {}, .radius = radius};
    };
    limits_of_.resize(blocks_.size());
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Shape& block = blocks_[k];
      auto& limits = limits_of_[k];
      if (block.carrier.round) {
        limits.push_back(circle(block.carrier.point, block.carrier.radius + radius_));
        limits.push_back(circle(block.carrier.point, std::abs(block.carrier.radius - radius_)));
      } else {
        limits.push_back(beside(block, radius_).carrier);
        limits.push_back(beside(block, -radius_).carrier);
      }
      limits.push_back(circle(block.start, radius_));
      limits.push_back(circle(block.end, radius_));
    }
  }

  [[nodiscard]] Extended clearance(const ExtendedPoint& point) const {
    Extended least = std::numeric_limits<Extended>::infinity();
    for (const Shape& block : blocks_) least = std::min(least, block.distance_to(point));
    return least;
  }

  // Whether it is enough.
  bool judge(Extended clearance) {
    const Extended spare = clearance - radius_;
    if (spare < -exact * size_ && spare > -2e-6L * std::max(radius_, 1.0L)) shallow_ = true;
    return spare >= (scale_.lenient ? -1e-6L * std::max(radius_, 1.0L) : -exact * size_);
  }

  // One that is nothing, or a short one whose neighbours nearly meet beside it: a bow tie.
  [[nodiscard]] bool has_tiny_block() const {
    const Extended largest = std::min(input_resolution, 0.01L * radius_);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Shape& block = blocks_[k];
      if (block.extent <= input_resolution) return true;
      if (k == 0 || k + 1 == blocks_.size() || block.extent > 16 * largest) continue;
      if (std::min(blocks_[k + 1].distance_to(block.start),
                   blocks_[k - 1].distance_to(block.end)) <= largest)
        return true;
    }
    return false;
  }

  [[nodiscard]] bool has_kinked_seam() const {
    if (length(blocks_.back().end - blocks_.front().start) > input_resolution) return false;
    const Extended least = std::min(clearance(first_), clearance(last_));
    return least < radius_ - exact * size_ &&
           least >= radius_ - std::min(no_gouge, 0.01L * radius_);
  }

  void cut(std::size_t index) {
    const Shape& shape = elements_[index].shape;
    std::vector<Extended> ways{0, shape.extent};
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      for (const Carrier& limit : limits_of_[k])
        for (const ExtendedPoint& point : common_points(shape.carrier, limit, touch * size_)) {
          const Extended way = shape.way_to(point);
          if (way <= 0 || way >= shape.extent) continue;
          if (std::abs(blocks_[k].distance_to(point) - radius_) < on_limit * size_)
            ways.push_back(way);
        }
    // Side by side nothing crosses, but the path may go over there.
    for (const Element& other : elements_)
      for (const ExtendedPoint& point : {other.shape.start, other.shape.end}) {
        const Extended way = shape.way_to(point);
        if (way > 0 && way < shape.extent && shape.distance_to(point) < scale_.joint)
          ways.push_back(way);
      }
    std::sort(ways.begin(), ways.end());
    std::size_t part = 0;
    Extended from = 0;
    for (std::size_t k = 1; k < ways.size(); ++k) {
      const bool last = k + 1 == ways.size();
      if (ways[k] - from < touch * size_ && !(last && part == 0)) continue;
      const Extended to = last ? shape.extent : ways[k];
      const Extended inside = std::min({clearance(shape.at(from + 0.2L * (to - from))),
                                        clearance(shape.at(from + 0.5L * (to - from))),
                                        clearance(shape.at(from + 0.8L * (to - from)))});
      if (judge(inside)) pieces_.push_back({from, to, index, part, shape.at(from), shape.at(to)});
      ++part;
      from = to;
    }
    parts_.push_back(part);
  }

  [[nodiscard]] bool together(const ExtendedPoint& a, const ExtendedPoint& b) const {
    return length(a - b) <= joint * size_ + scale_.joint;
  }

  // Depth first over the pieces in path order: straight on where that is kept, as
  // the next piece is the first that can begin where one ends, else a later one.
  bool reach_the_end() {
    if (!judge(clearance(first_)) || !judge(clearance(last_))) return false;
    dead_.assign(pieces_.size(), false);
    std::vector<std::size_t> starts;
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (together(pieces_[k].start, first_)) starts.push_back(k);
    if (starts.empty()) return false;
    return take_one(starts);
  }

  bool take_one(const std::vector<std::size_t>& choices) {
    if (choices.size() > 1) tied_ = true;
    return std::any_of(choices.begin(), choices.end(),
                       [this](std::size_t choice) { return follow(choice); });
  }

  bool follow(std::size_t at) {
    if (dead_[at]) return false;
    way_.push_back(at);
    const Piece& piece = pieces_[at];
    const bool ends_together = together(piece.end, last_);
    if (ends_together && piece.element + 1 == elements_.size() &&
        piece.part + 1 == parts_[piece.element])
      return true;
    std::vector<std::size_t> choices;
    for (std::size_t next = at + 1; next < pieces_.size(); ++next)
      if (together(pieces_[next].start, piece.end)) choices.push_back(next);
    if (take_one(choices)) return true;
    // Nothing is left of what follows, and the last point has been reached all the same.
    if (ends_together) {
      tied_ = true;
      return true;
    }
    dead_[at] = true;
    way_.pop_back();
    return false;
  }

  // Round nothing but the first point, which is the last one as well, is no way.
  [[nodiscard]] bool goes_nowhere() const {
    Extended all = 0;
    Extended sum = 0;
    for (const Element& element : elements_) all += element.shape.extent;
    for (const std::size_t at : way_) sum += pieces_[at].to - pieces_[at].from;
    return sum < 1e-7L && all > 1e-6L;
  }

  Extended radius_;
  Extended shift_;
  bool mitres_;
  Extended longest_leg_;
  MaskingScale scale_;
  Extended size_ = 0;
  std::vector<Shape> blocks_{};
  std::vector<std::size_t> ordinals_{};
  std::vector<std::vector<Carrier>> limits_of_{};
  std::vector<Element> elements_{};
  std::vector<std::size_t> parts_{};
  std::vector<Piece> pieces_{};
  ExtendedPoint first_{};
  ExtendedPoint last_{};
  std::vector<bool> dead_{};
  std::vector<std::size_t> way_{};
  bool tied_ = false;
  bool shallow_ = false;
};

}  // namespace

SlowMasking slow_masking(const Contour& contour, const TrcMode& mode, const MaskingScale& scale) {
  return Masking(contour, mode, scale).result();
}

}  // namespace trc::support
