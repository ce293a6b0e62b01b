#include "tests/fuzz/fuzzed_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/geometry/plane.h"
#include "tests/fuzz/choices.h"

namespace trc::fuzz {
namespace {

constexpr std::array radii{1.0, 0.0, 0.001, 0.5, 2.0, 2.5, 4.0, 10.0, 100.0, -1.0, -3.0, 2e5};
constexpr std::array windows{0U, 0U, 1U, 2U, 3U, 5U, 8U, 20U};
constexpr std::array passive_blocks{100U, 1U, 3U};

class Decoder {
 public:
  explicit Decoder(std::span<const std::uint8_t> bytes) : choices_(bytes) {}

  FuzzedPath path() {
    FuzzedPath path;
    path.cut = 1 + choices_.below(64);
    path.settings = settings();
    at_ = path.settings.session.program.start;
    if (choices_.flag())
      path.items.emplace_back(wire::TrcCommand{.source = next_source(), .side = selected_side()});
    while (!choices_.used_up()) path.items.push_back(item());
    return path;
  }

 private:
  wire::PathSettings settings() {
    wire::PathSettings settings;
    ProgramSetup& program = settings.session.program;
    CompensatorSetup& compensator = settings.session.compensator;
    const unsigned flags = choices_.byte();
    program.mode = mode();
    program.start = {choices_.number(), choices_.number(), 0};
    program.absolute_center = (flags & 1U) != 0;
    program.circle.correct_center = (flags & 2U) == 0;
    absolute_center_ = program.absolute_center;
    plane_ = program.mode.plane;
    compensator.implicit_contour_masking = (flags & 4U) != 0;
    compensator.circular_kerf_masking = (flags & 8U) == 0;
    compensator.inverse_path = (flags & 16U) != 0;
    settings.response_layout = (flags & 32U) != 0 ? wire::Layout::columns : wire::Layout::blocks;
    settings.want_resume_tokens = (flags & 64U) != 0;
    compensator.limits.look_ahead_blocks = choices_.of(windows);
    compensator.limits.passive_blocks = choices_.of(passive_blocks);
    return settings;
  }

  TrcMode mode() {
    TrcMode mode;
    const unsigned words = choices_.byte();
    mode.plane = static_cast<Plane>(words % 3);
    mode.selection = static_cast<Selection>(words / 3 % 6);
    mode.transition = static_cast<Transition>(words / 18 % 2);
    mode.masking = static_cast<Masking>(words / 36 % 2);
    mode.feed_adaptation = static_cast<FeedAdaptation>(words / 72 % 2);
    mode.tool_radius = radius();
    mode.options = wire::changed({}, option_changes());
    // Beyond its range it is refused in a setup, while a command gets a warning.
    mode.options.stretch_factor = std::clamp(mode.options.stretch_factor, 1.0, 9.0);
    return mode;
  }

  double radius() {
    const unsigned choice = choices_.byte();
    return choice < 4 * radii.size() ? radii[choice / 4] : choices_.number();
  }

  wire::TrcOptionChanges option_changes() {
    const unsigned low = choices_.byte();
    const unsigned high = choices_.byte();
    const auto bit = [](unsigned bits, unsigned n) -> std::optional<bool> {
      return ((bits >> n) & 1U) != 0 ? std::optional(true) : std::nullopt;
    };
    wire::TrcOptionChanges changes{.conv_cir_to_lin = bit(low, 0),
                                   .kerf_masking = bit(low, 1),
                                   .reverse = bit(low, 2),
                                   .ignore_cont_damage = bit(low, 3),
                                   .remove_masked_blocks = bit(low, 4),
                                   .ext_angle_block_intersection = bit(low, 5),
                                   .g236_lin = bit(low, 6),
                                   .perpendicular_radius_change = bit(low, 7),
                                   .gen_cir_block_in_corner = bit(high, 0),
                                   .suppress_trc = bit(high, 1),
                                   .inverse = bit(high, 2)};
    if (bit(high, 3)) changes.stretch_factor = choices_.number();
    if (bit(high, 4)) changes.tangential_limit = 0.1 + 0.1 * choices_.below(30);
    if (bit(high, 5)) changes.split = split();
    // The opposite of everything, for commands in the middle of a path.
    if (bit(high, 6))
      for (auto* option : {&changes.kerf_masking, &changes.remove_masked_blocks,
                           &changes.ignore_cont_damage, &changes.suppress_trc})
        if (*option) *option = false;
    return changes;
  }

  SplitOption split() {
    SplitOption split;
    split.where = static_cast<SplitOption::Where>(choices_.below(4));
    split.along_path = choices_.flag();
    split.axis = static_cast<std::uint8_t>(choices_.below(3));
    split.distance_1 = std::abs(choices_.number());
    split.feed_1 = 100;
    split.distance_2 = std::abs(choices_.number());
    split.feed_2 = 50;
    return split;
  }

  wire::PathInput item() {
    const unsigned choice = choices_.byte();
    switch (choice % 16) {
      case 7:
        return step();
      case 8:
      case 9:
      case 10:
        return arc_about_center(choice);
      case 11:
        return arc_of_radius(choice);
      case 12:
        return command();
      case 13:
        return wire::TrcCommand{.source = next_source(),
                                .side = choice < 128 ? selected_side() : Side::off};
      case 14:
        return wire::Passthrough{.source = next_source(), .text = "M" + std::to_string(items_)};
      case 15:
        return line_with_other_axes();
      default:
        return line(choice);
    }
  }

  MoveRequest line(unsigned choice) {
    MoveRequest move = request(choice >= 240 ? MotionKind::rapid : MotionKind::linear);
    if (choice % 4 != 1) move.end[axes().first] = choices_.number();
    if (choice % 4 != 2) move.end[axes().second] = choices_.number();
    return follow(std::move(move));
  }

  // On from where the path is, often back on itself.
  MoveRequest step() {
    MoveRequest move = request(MotionKind::linear);
    move.end[axes().first] = at_[axes().first] + choices_.number();
    move.end[axes().second] = at_[axes().second] + choices_.number();
    return follow(std::move(move));
  }

  MoveRequest line_with_other_axes() {
    MoveRequest move = line(0);
    if (choices_.flag()) move.end[axes().third] = choices_.number();
    if (choices_.flag()) move.tracking = {choices_.number()};
    return follow(std::move(move));
  }

  MoveRequest arc_about_center(unsigned choice) {
    MoveRequest move =
        request(choice < 128 ? MotionKind::clockwise : MotionKind::counter_clockwise);
    const double i = choices_.number();
    const double j = choices_.number();
    const double x = at_[axes().first];
    const double y = at_[axes().second];
    move.center[axes().first] = absolute_center_ ? x + i : i;
    move.center[axes().second] = absolute_center_ ? y + j : j;
    const unsigned turn = choices_.byte();
    const double angle = std::numbers::pi / 32 * (turn % 64) * (turn < 128 ? 1 : 0.5);
    const bool exact = turn % 16 == 0 && turn < 128;
    const double cosine = exact ? std::round(std::cos(angle)) : std::cos(angle);
    const double sine = exact ? std::round(std::sin(angle)) : std::sin(angle);
    move.end[axes().first] = x + i - i * cosine + j * sine;
    move.end[axes().second] = y + j - i * sine - j * cosine;
    return follow(std::move(move));
  }

  MoveRequest arc_of_radius(unsigned choice) {
    MoveRequest move =
        request(choice < 128 ? MotionKind::clockwise : MotionKind::counter_clockwise);
    move.end[axes().first] = choices_.number();
    move.end[axes().second] = choices_.number();
    const double chord = std::hypot(*move.end[axes().first] - at_[axes().first],
                                    *move.end[axes().second] - at_[axes().second]);
    const double factor = 1 + choices_.below(16) / 4.0;
    move.radius = (choices_.flag() ? factor : -factor) * chord / 2;
    return follow(std::move(move));
  }

  wire::TrcCommand command() {
    wire::TrcCommand command{.source = next_source()};
    switch (choices_.below(10)) {
      case 0:
        command.tool_radius = radius();
        break;
      case 1:
        command.selection = static_cast<Selection>(choices_.below(6));
        break;
      case 2:
        command.transition = static_cast<Transition>(choices_.below(2));
        break;
      case 3:
        command.masking = static_cast<Masking>(choices_.below(2));
        break;
      case 4:
        command.feed_adaptation = static_cast<FeedAdaptation>(choices_.below(2));
        command.tangfeed_minimum = choices_.number();
        break;
      case 5:
        command.plane = plane_ = static_cast<Plane>(choices_.below(3));
        break;
      case 6:
        command.tangential = true;
        command.side = choices_.flag() ? Side::off : selected_side();
        break;
      case 7:
        command.absolute_center = absolute_center_ = choices_.flag();
        command.correct_center = choices_.flag();
        break;
      default:
        command.options = option_changes();
        break;
    }
    return command;
  }

  Side selected_side() { return choices_.flag() ? Side::left : Side::right; }

  [[nodiscard]] PlaneAxes axes() const { return axes_of(plane_); }

  Source next_source() { return {.index = items_, .number = static_cast<std::int64_t>(items_++)}; }

  MoveRequest request(MotionKind kind) {
    return {.source = next_source(), .kind = kind, .feed = 1000};
  }

  MoveRequest follow(MoveRequest move) {
    for (std::size_t axis = 0; axis < at_.size(); ++axis)
      if (move.end[axis]) at_[axis] = *move.end[axis];
    return move;
  }

  Choices choices_;
  Plane plane_ = Plane::xy;
  bool absolute_center_ = false;
  Position at_{};
  std::uint64_t items_ = 0;
};

}  // namespace

FuzzedPath fuzzed_path(std::span<const std::uint8_t> bytes) { return Decoder(bytes).path(); }

}  // namespace trc::fuzz
