#include "tests/wire/samples.h"

#include <cstring>
#include <memory>
#include <numbers>
#include <random>

#include "core/geometry/segment.h"

namespace trc::wire {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_bits(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
}

bool same_bits(const Point& a, const Point& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y());
}

bool same_bits(const Segment& a, const Segment& b) {
  if (a.index() != b.index() || !same_bits(start_of(a), start_of(b)) ||
      !same_bits(end_of(a), end_of(b)))
    return false;
  if (!is_arc(a)) return true;
  const Arc& arc_a = std::get<Arc>(a);
  const Arc& arc_b = std::get<Arc>(b);
  return same_bits(arc_a.center, arc_b.center) && same_bits(arc_a.sweep, arc_b.sweep);
}

bool same_bits(const AxisTravel& a, const AxisTravel& b) {
  return same_bits(a.from, b.from) && same_bits(a.to, b.to);
}

template <class Values>
bool all_same_bits(const Values& a, const Values& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same_bits(a[i], b[i])) return false;
  return true;
}

AssertionResult differs(const char* field) { return AssertionFailure() << field << " differs"; }

AssertionResult same_move(const MoveRequest& a, const MoveRequest& b) {
  if (a.source != b.source) return differs("source");
  if (a.kind != b.kind) return differs("kind");
  if (!all_same_bits(a.end, b.end)) return differs("end");
  if (!all_same_bits(a.center, b.center)) return differs("center");
  if (!same_bits(a.radius, b.radius)) return differs("radius");
  if (a.incremental != b.incremental) return differs("incremental");
  if (!all_same_bits(a.tracking, b.tracking)) return differs("tracking");
  if (!same_bits(a.feed, b.feed)) return differs("feed");
  if (a.role != b.role) return differs("role");
  return AssertionSuccess();
}

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  bool chance(unsigned percent) { return random_() % 100 < percent; }
  std::size_t below(std::size_t bound) { return random_() % bound; }
  double coordinate() { return std::uniform_real_distribution(-1e3, 1e3)(random_); }
  double feed() { return 100.0 * static_cast<double>(1 + below(3)); }
  std::array<std::optional<double>, 3> position(unsigned percent) {
    std::array<std::optional<double>, 3> position;
    for (auto& coordinate_of_axis : position)
      if (chance(percent)) coordinate_of_axis = coordinate();
    return position;
  }

 private:
  std::mt19937_64 random_;
};

MoveRequest random_move(Numbers& numbers) {
  MoveRequest move;
  move.kind = static_cast<MotionKind>(numbers.below(4));
  move.end = numbers.position(70);
  const bool circular =
      move.kind == MotionKind::clockwise || move.kind == MotionKind::counter_clockwise;
  if (circular && numbers.chance(20))
    move.radius = 5;
  else if (circular)
    move.center = numbers.position(60);
  if (numbers.chance(15)) {
    move.tracking.resize(2);
    move.tracking[numbers.below(2)] = numbers.coordinate();
  }
  if (numbers.chance(10)) move.role = numbers.chance(50) ? ContourRole::lead : ContourRole::wall;
  return move;
}

}  // namespace

std::vector<PathInput> every_path_input() {
  TrcOptionChanges options{.conv_cir_to_lin = true,
                           .kerf_masking = false,
                           .reverse = true,
                           .ignore_cont_damage = false,
                           .remove_masked_blocks = true,
                           .ext_angle_block_intersection = false,
                           .g236_lin = true,
                           .stretch_factor = 2.5,
                           .tangential_limit = 0.5,
                           .perpendicular_radius_change = true,
                           .gen_cir_block_in_corner = false,
                           .suppress_trc = true,
                           .inverse = false,
                           .split = SplitOption{.where = SplitOption::Where::combined,
                                                .along_path = false,
                                                .axis = 1,
                                                .distance_1 = 5,
                                                .feed_1 = 200,
                                                .distance_2 = 2,
                                                .feed_2 = 100}};
  std::vector<PathInput> items{
      MoveRequest{.kind = MotionKind::rapid, .end = {0.0, -0.0, std::nullopt}},
      MoveRequest{.kind = MotionKind::linear, .end = {std::nullopt, 0.1, 1e6}, .feed = 1000},
      MoveRequest{.kind = MotionKind::clockwise,
                  .end = {10, 20, -1},
                  .center = {5, std::nullopt, 0},
                  .feed = 1000},
      MoveRequest{.kind = MotionKind::counter_clockwise,
                  .center = {},
                  .feed = 500,
                  .role = ContourRole::lead},
      MoveRequest{.kind = MotionKind::clockwise, .end = {1, 2, {}}, .radius = -7.5, .feed = 500},
      MoveRequest{.kind = MotionKind::linear,
                  .end = {3, {}, {}},
                  .tracking = {std::nullopt, 90.0},
                  .feed = 500},
      Passthrough{.text = "M8 (Kühlung ein)"},
      TrcCommand{.side = Side::left,
                 .tangential = true,
                 .selection = Selection::on_path,
                 .transition = Transition::circular,
                 .masking = Masking::on,
                 .feed_adaptation = FeedAdaptation::on,
                 .tangfeed_minimum = 3,
                 .tool_radius = -10,
                 .options = options,
                 .plane = Plane::zx,
                 .absolute_center = true,
                 .correct_center = false},
      TrcCommand{.side = Side::off},
      TrcCommand{.options = TrcOptionChanges{.split = SplitOption{}}},
      TrcCommand{},
  };
  for (std::size_t i = 0; i < items.size(); ++i)
    std::visit(
        [i](auto& item) {
          item.source.index = i;
          item.source.number = i % 3 == 0 ? Source::no_number : static_cast<std::int64_t>(10 * i);
        },
        items[i]);
  return items;
}

std::vector<PathInput> random_path_inputs(std::uint64_t seed, std::size_t count) {
  Numbers numbers(seed);
  std::vector<PathInput> items;
  double feed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Source source{.index = i};
    if (numbers.chance(50)) source.number = static_cast<std::int64_t>(i);
    if (numbers.chance(10)) {
      items.emplace_back(Passthrough{.source = source, .text = "M" + std::to_string(i)});
    } else if (numbers.chance(10)) {
      items.emplace_back(TrcCommand{.source = source, .tool_radius = numbers.coordinate()});
    } else {
      MoveRequest move = random_move(numbers);
      if (numbers.chance(20)) feed = numbers.feed();
      move.source = source;
      move.feed = feed;
      items.emplace_back(std::move(move));
    }
  }
  return items;
}

std::vector<CompensatedBlock> every_compensated_block() {
  constexpr double pi = std::numbers::pi;
  const auto inverse = std::make_shared<const Segment>(
      Arc{.start = {30, 20}, .end = {40, 30}, .center = {30, 30}, .sweep = pi / 2});
  std::vector<CompensatedBlock> blocks{
      {.source = {.index = 0, .number = 10, .line = 1},
       .origin = Origin::uncompensated,
       .rapid = true,
       .path = Line{.start = {0, 0}, .end = {-0.0, 0.1}},
       .normal = {.from = 0, .to = 5}},
      {.source = {.index = 1, .number = Source::no_number},
       .origin = Origin::passthrough,
       .path = Line{.start = {-0.0, 0.1}, .end = {-0.0, 0.1}},
       .normal = {.from = 5, .to = 5},
       .text = "M8"},
      {.source = {.index = 2, .number = 0, .line = 3},
       .origin = Origin::approach,
       .tangential = true,
       .path = Line{.start = {-0.0, 0.1}, .end = {30, 30}},
       .normal = {.from = 5, .to = 5},
       .feed = 1000},
      {.source = {.index = 2, .number = 0, .line = 3},
       .origin = Origin::transition,
       .path = Arc{.start = {30, 30}, .end = {40, 20}, .center = {30, 20}, .sweep = -pi / 2},
       .normal = {.from = 5, .to = 5},
       .feed = 1000,
       .inverse = inverse},
      {.source = {.index = 3},
       .origin = Origin::programmed,
       .path = Arc{.start = {40, 20}, .end = {40, 20}, .center = {45, 20}, .sweep = 2 * pi},
       .normal = {.from = 5, .to = -5},
       .feed = 500,
       .tracking = {{.from = 0, .to = 360}, {.from = 1, .to = 1}}},
      {.source = {.index = 4},
       .origin = Origin::masked,
       .path = Line{.start = {40, 20}, .end = {40, 20}},
       .normal = {.from = -5, .to = -5},
       .feed = 500,
       .tracking = {{.from = 360, .to = 400}, {.from = 1, .to = 1}}},
      {.source = {.index = 5},
       .origin = Origin::passthrough,
       .path = Line{.start = {40, 20}, .end = {40, 20}},
       .normal = {.from = -5, .to = -5},
       .tracking = {{.from = 400, .to = 400}, {.from = 1, .to = 1}},
       .text = "M9"},
  };
  for (const Origin origin :
       {Origin::retract, Origin::radius_change, Origin::kerf, Origin::converted_circle})
    blocks.push_back({.source = {.index = 6},
                      .origin = origin,
                      .plane = Plane::zx,
                      .path = Line{.start = {-5, 40}, .end = {-5, 40}},
                      .normal = {.from = 20, .to = 20},
                      .feed = 0.1,
                      .tracking = {{.from = 400, .to = 400}, {.from = 1, .to = 1}}});
  return blocks;
}

std::vector<CompensatedBlock> random_compensated_blocks(std::uint64_t seed, std::size_t count) {
  Numbers numbers(seed);
  std::vector<CompensatedBlock> blocks;
  Point here = Point::Zero();
  double height = 0;
  TrackingTravel tracking;
  for (std::size_t i = 0; i < count; ++i) {
    CompensatedBlock block{.source = {.index = i}, .tracking = tracking};
    if (numbers.chance(60)) block.source.number = static_cast<std::int64_t>(i);
    if (numbers.chance(10)) {
      block.origin = Origin::passthrough;
      block.path = Line{.start = here, .end = here};
      block.normal = {.from = height, .to = height};
      block.text = "M" + std::to_string(i);
      blocks.push_back(block);
      continue;
    }
    const Point end{numbers.coordinate(), numbers.coordinate()};
    const double to = numbers.chance(20) ? numbers.coordinate() : height;
    block.origin = numbers.chance(30) ? Origin::transition : Origin::programmed;
    if (numbers.chance(40))
      block.path = Arc{.start = here,
                       .end = end,
                       .center = {numbers.coordinate(), numbers.coordinate()},
                       .sweep = numbers.coordinate() / 1e3};
    else
      block.path = Line{.start = here, .end = end};
    block.rapid = !is_arc(block.path) && numbers.chance(10);
    block.tangential = numbers.chance(20);
    block.normal = {.from = height, .to = to};
    if (numbers.chance(80)) block.feed = numbers.feed();
    if (block.tracking.empty() && i > count / 3) block.tracking = {{}, {}};
    if (!block.tracking.empty() && numbers.chance(30)) block.tracking[1].to = numbers.coordinate();
    blocks.push_back(block);
    here = end;
    height = to;
    tracking = block.tracking;
    for (AxisTravel& axis : tracking) axis.from = axis.to;
  }
  return blocks;
}

AssertionResult same(const PathInput& a, const PathInput& b) {
  if (a.index() != b.index()) return differs("sort");
  if (const auto* move = std::get_if<MoveRequest>(&a))
    return same_move(*move, std::get<MoveRequest>(b));
  if (const auto* command = std::get_if<TrcCommand>(&a))
    return *command == std::get<TrcCommand>(b) ? AssertionSuccess() : differs("command");
  return std::get<Passthrough>(a) == std::get<Passthrough>(b) ? AssertionSuccess()
                                                              : differs("passthrough");
}

AssertionResult same(const CompensatedBlock& a, const CompensatedBlock& b) {
  if (a.source != b.source) return differs("source");
  if (a.origin != b.origin) return differs("origin");
  if (a.plane != b.plane) return differs("plane");
  if (a.rapid != b.rapid) return differs("rapid");
  if (a.tangential != b.tangential) return differs("tangential");
  if (!same_bits(a.path, b.path)) return differs("path");
  if (!same_bits(a.normal, b.normal)) return differs("normal");
  if (!same_bits(a.feed, b.feed)) return differs("feed");
  if (!all_same_bits(a.tracking, b.tracking)) return differs("tracking");
  if (a.text != b.text) return differs("text");
  if ((a.inverse == nullptr) != (b.inverse == nullptr)) return differs("inverse");
  if (a.inverse && !same_bits(*a.inverse, *b.inverse)) return differs("inverse");
  return AssertionSuccess();
}

}  // namespace trc::wire
