#include "tests/support/slow_masking.h"

#include <algorithm>
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

// A whole equidistant or an inserted arc.
struct Element {
  Shape shape{};
  std::size_t ordinal = 0;
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
    if (!reached || goes_nowhere()) return found;
    for (const std::size_t at : way_) {
      const Piece& piece = pieces_[at];
      const Element& element = elements_[piece.element];
      Shape shape = element.shape;
      shape.start = piece.start;
      shape.end = piece.end;
      shape.extent = piece.to - piece.from;
      if (shape.carrier.round)
        shape.sweep *= element.shape.extent > 0 ? shape.extent / element.shape.extent : 0;
      found.path.push_back(
          {.path = segment_of(shape), .ordinal = element.ordinal, .inserted = element.inserted});
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

  // Whether two blocks that reverse in one point bend apart on the tool side: no tip
  // to go round (D-05 as this project reads it).
  [[nodiscard]] bool leaves_slit(const Shape& before, const Shape& after) const {
    Extended opening = 0;
    Extended reach = std::min(before.extent, after.extent);
    for (const Shape* block : {&before, &after}) {
      if (!block->carrier.round) continue;
      opening += (block->sweep > 0 ? 1 : -1) / block->carrier.radius;
      reach = std::min(reach, block->carrier.radius);
    }
    return opening * shift_ < 0 && std::abs(opening) * reach * reach / 2 > 1e-3L;
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
        if (std::abs(std::abs(turn) - pi) < reversal_angle)  // D-05
          turn = leaves_slit(blocks_[k - 1], block) ? 0 : pi;
        if (turn > 0 && mitres_) {
          lay_mitre(k, before, after, turn);
        } else if (turn > 0) {
          const ExtendedPoint corner = block.start;
          const Shape arc =
              arc_shape(corner, corner + shift_ * left_normal(before), shift_ > 0 ? -turn : turn);
          elements_.push_back({arc, ordinals_[k - 1], true});
        }
      }
      const bool bends_in = block.carrier.round && (block.sweep > 0) == (shift_ > 0);
      if (bends_in && block.carrier.radius < radius_ - exact * size_) {
        judge(clearance(beside(block, shift_).start));
        judge(clearance(beside(block, shift_).end));
        continue;
      }
      elements_.push_back({beside(block, shift_), ordinals_[k], false});
    }
    first_ = blocks_.front().start + shift_ * left_normal(blocks_.front().heading(0));
    last_ =
        blocks_.back().end + shift_ * left_normal(blocks_.back().heading(blocks_.back().extent));
  }

  // G25 between block k - 1 and block k: lines go on as themselves, arcs in tangents, up to where
  // they meet or STRETCH_FACTOR ends them (rule 4.2, 4.3).
  void lay_mitre(std::size_t k, const ExtendedPoint& before, const ExtendedPoint& after,
                 Extended turn) {
    const ExtendedPoint& corner = blocks_[k].start;
    const ExtendedPoint end = corner + shift_ * left_normal(before);
    const ExtendedPoint start = corner + shift_ * left_normal(after);
    const bool reversal = std::abs(turn - pi) < reversal_angle;
    const Extended to_tip = reversal ? 2 * longest_leg_ : radius_ * std::tan(turn / 2);
    const Extended leg = std::min(to_tip, longest_leg_);
    const ExtendedPoint far_end = end + leg * before;
    const ExtendedPoint far_start = start - leg * after;
    const bool round_after = blocks_[k].carrier.round;
    elements_.push_back({line_shape(end, far_end), ordinals_[k - 1], blocks_[k - 1].carrier.round});
    if (to_tip > longest_leg_)
      elements_.push_back({line_shape(far_end, far_start), ordinals_[k - 1], true});
    elements_.push_back(
        {line_shape(far_start, start), ordinals_[round_after ? k - 1 : k], round_after});
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
    // A mitre reaches out of the tool radius: two of them cross where nothing is near.
    if (mitres_)
      for (std::size_t other = 0; other < elements_.size(); ++other)
        if (other != index) cut_by(elements_[other].shape, shape, ways);
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

  void cut_by(const Shape& other, const Shape& shape, std::vector<Extended>& ways) const {
    for (const ExtendedPoint& point : common_points(shape.carrier, other.carrier, touch * size_)) {
      const Extended way = shape.way_to(point);
      const Extended there = other.way_to(point);
      const Extended slack = touch * size_;
      if (way > slack && way < shape.extent - slack && there >= -slack &&
          there <= other.extent + slack)
        ways.push_back(way);
    }
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
