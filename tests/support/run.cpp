#include "tests/support/run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <numbers>
#include <sstream>
#include <utility>

namespace trc::support {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

MoveRequest request_for(const Segment& segment, Plane plane, std::uint64_t index,
                        std::size_t ordinal) {
  const PlaneAxes axes = axes_of(plane);
  MoveRequest request;
  request.source = {.index = index, .number = static_cast<std::int64_t>(ordinal)};
  request.feed = 1000;
  if (const auto* arc = std::get_if<Arc>(&segment)) {
    request.kind = arc->sweep > 0 ? MotionKind::counter_clockwise : MotionKind::clockwise;
    request.center[axes.first] = arc->center.x();
    request.center[axes.second] = arc->center.y();
  }
  const Point end = std::visit([](const auto& shape) { return shape.end; }, segment);
  request.end[axes.first] = end.x();
  request.end[axes.second] = end.y();
  return request;
}

SessionSetup setup_for(const TrcMode& mode, const Point& start,
                       const CompensatorSetup& compensator) {
  SessionSetup setup;
  setup.compensator = compensator;
  setup.program.mode = mode;
  setup.program.mode.side = Side::off;
  setup.program.tool_radius_given = true;
  setup.program.nominal_radius = mode.nominal_radius;
  setup.program.absolute_center = true;
  setup.program.start = from_plane(mode.plane, start, 0);
  return setup;
}

Point first_of(const Segment& segment) {
  return std::visit([](const auto& shape) { return shape.start; }, segment);
}

Point last_of(const Segment& segment) {
  return std::visit([](const auto& shape) { return shape.end; }, segment);
}

double extent_of(const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment)) return (line->end - line->start).norm();
  const auto& arc = std::get<Arc>(segment);
  return std::abs(arc.sweep) * (arc.start - arc.center).norm();
}

// One block of either side of a comparison.
struct Plain {
  bool is_arc = false;
  Point start = Point::Zero();
  Point end = Point::Zero();
  Point center = Point::Zero();
  double sweep = 0;
  Origin origin{};
  std::int64_t number = 0;
};

Plain plain(const CompensatedBlock& block, const Motion& map) {
  const Segment path = map(block.path);
  Plain result{.is_arc = is_arc(path),
               .start = first_of(path),
               .end = last_of(path),
               .origin = block.origin,
               .number = block.source.number};
  if (const auto* arc = std::get_if<Arc>(&path)) {
    result.center = arc->center;
    result.sweep = arc->sweep;
  }
  return result;
}

Plain plain(const SlowBlock& block) {
  return {.is_arc = block.is_arc,
          .start = narrow(block.start),
          .end = narrow(block.end),
          .center = narrow(block.center),
          .sweep = static_cast<double>(block.sweep),
          .origin = block.origin,
          .number = static_cast<std::int64_t>(block.ordinal)};
}

bool has_length(const Plain& block, double shortest) {
  if (!block.is_arc) return (block.end - block.start).norm() > shortest;
  return std::abs(block.sweep) * (block.start - block.center).norm() > shortest;
}

std::string text_of(const Plain& block) {
  std::ostringstream text;
  text << std::setprecision(12) << block.number << ' ' << name_of(block.origin)
       << (block.is_arc ? " arc " : " line ") << block.start.x() << ' ' << block.start.y() << " -> "
       << block.end.x() << ' ' << block.end.y();
  if (block.is_arc)
    text << " center " << block.center.x() << ' ' << block.center.y() << " sweep "
         << block.sweep * degrees;
  return text.str();
}

bool alike(const Plain& a, const Plain& b, double tolerance) {
  if (a.is_arc != b.is_arc || a.origin != b.origin || a.number != b.number) return false;
  if ((a.start - b.start).norm() > tolerance || (a.end - b.end).norm() > tolerance) return false;
  if (!a.is_arc) return true;
  const double radius = (b.start - b.center).norm();
  return (a.center - b.center).norm() <= tolerance &&
         std::abs(a.sweep - b.sweep) * radius <= 4 * tolerance;
}

std::string difference(std::vector<Plain> actual, std::vector<Plain> expected, double tolerance) {
  const auto drop = [&](std::vector<Plain>& blocks) {
    std::erase_if(blocks, [&](const Plain& block) { return !has_length(block, 2 * tolerance); });
  };
  drop(actual);
  drop(expected);
  const std::size_t common = std::min(actual.size(), expected.size());
  for (std::size_t k = 0; k < common; ++k)
    if (!alike(actual[k], expected[k], tolerance))
      return "block " + std::to_string(k) + " is\n  " + text_of(actual[k]) + "\nexpected\n  " +
             text_of(expected[k]);
  if (actual.size() > common) return "too many blocks, first\n  " + text_of(actual[common]);
  if (expected.size() > common) return "missing\n  " + text_of(expected[common]);
  return {};
}

}  // namespace

CompensatorSetup all_walls() {
  return {.leads = {.find = LeadSettings::Find::none, .input_resolution = 0},
          .largest_masked_share = 1};
}

const Diagnostic* Outcome::error() const {
  for (const Diagnostic& diagnostic : diagnostics)
    if (diagnostic.severity == Severity::error) return &diagnostic;
  return nullptr;
}

Channel::Channel(const TrcMode& mode, const Point& start, std::size_t batch,
                 const CompensatorSetup& compensator)
    : plane_(mode.plane),
      batch_(batch),
      session_(setup_for(mode, start, compensator)),
      answers_([this](Answer& part) {
        std::ranges::move(part.blocks, std::back_inserter(outcome_.blocks));
        std::ranges::move(part.diagnostics, std::back_inserter(outcome_.diagnostics));
        return true;
      }) {}

void Channel::item_given(bool goes_on) {
  note(goes_on);
  if (running_ && batch_ != 0 && ++items_ % batch_ == 0) running_ = session_.advance(answers_);
}

void Channel::move(const Segment& segment, std::size_t ordinal, std::optional<double> third,
                   std::optional<double> tracking) {
  if (!running_) return;
  MoveRequest request = request_for(segment, plane_, index_++, ordinal);
  request.end[axes_of(plane_).third] = third;
  if (tracking) request.tracking = {tracking};
  item_given(program().move(request));
}

void Channel::pass(const std::string& text, std::size_t ordinal) {
  if (!running_) return;
  const Source source = place(ordinal);
  ++index_;
  item_given(program().pass(source, text));
}

Outcome Channel::finish(std::size_t ordinal) {
  // An item that was refused is told by this call too.
  running_ = session_.advance(answers_) && running_;
  if (running_) running_ = session_.finish(place(ordinal), answers_);
  outcome_.stopped = session_.diagnostics().stopped();
  return std::move(outcome_);
}

Outcome compensate(const Contour& contour, const TrcMode& mode, const Feeding& feeding) {
  Channel channel(mode, contour.approach.start, feeding.batch, feeding.compensator);
  const auto value = [](const auto& function, std::size_t ordinal) -> std::optional<double> {
    return function ? std::optional<double>(function(ordinal)) : std::nullopt;
  };
  const auto give = [&](const Segment& segment, std::size_t ordinal) {
    channel.move(segment, ordinal, value(feeding.third, ordinal), value(feeding.tracking, ordinal));
    if (feeding.texts)
      for (const std::string& text : feeding.texts(ordinal)) channel.pass(text, ordinal);
    if (channel.running() && feeding.watch) feeding.watch(ordinal, channel.blocks());
  };
  const std::size_t last = contour.blocks.size() + 1;
  channel.note(channel.program().select(mode.side, channel.place(0)));
  give(contour.approach, 0);
  for (std::size_t k = 0; k < contour.blocks.size(); ++k) give(contour.blocks[k], k + 1);
  if (channel.running()) channel.note(channel.program().deselect(channel.place(last)));
  give(contour.retract, last);
  return channel.finish(last);
}

std::vector<CompensatedBlock> moving(const std::vector<CompensatedBlock>& blocks, double shortest) {
  std::vector<CompensatedBlock> result;
  for (const CompensatedBlock& block : blocks)
    if (block.origin != Origin::passthrough && extent_of(block.path) > shortest)
      result.push_back(block);
  return result;
}

std::string first_gap(const std::vector<CompensatedBlock>& blocks) {
  const CompensatedBlock* before = nullptr;
  for (const CompensatedBlock& block : blocks) {
    if (block.origin == Origin::passthrough) continue;
    if (before != nullptr) {
      bool joined = from_plane(before->plane, last_of(before->path), before->normal.to) ==
                        from_plane(block.plane, first_of(block.path), block.normal.from) &&
                    (before->tracking.empty() || before->tracking.size() == block.tracking.size());
      // Before an axis is programmed for the first time all stand at 0.
      for (std::size_t axis = 0; joined && axis < block.tracking.size(); ++axis)
        joined =
            (before->tracking.empty() ? 0 : before->tracking[axis].to) == block.tracking[axis].from;
      if (!joined) return text_of(*before) + "\nis not joined to\n" + text_of(block);
    }
    before = &block;
  }
  return {};
}

std::string difference(const std::vector<CompensatedBlock>& actual,
                       const std::vector<SlowBlock>& expected, double tolerance) {
  std::vector<Plain> left;
  std::vector<Plain> right;
  for (const CompensatedBlock& block : moving(actual)) left.push_back(plain(block, Motion{}));
  for (const SlowBlock& block : expected) right.push_back(plain(block));
  return difference(std::move(left), std::move(right), tolerance);
}

std::string difference(const std::vector<CompensatedBlock>& actual,
                       const std::vector<CompensatedBlock>& expected, const Motion& map,
                       double tolerance) {
  std::vector<Plain> left;
  std::vector<Plain> right;
  for (const CompensatedBlock& block : moving(actual)) left.push_back(plain(block, Motion{}));
  for (const CompensatedBlock& block : moving(expected)) right.push_back(plain(block, map));
  return difference(std::move(left), std::move(right), tolerance);
}

// Which role a block plays is told by its number; what remains is geometry.
std::string geometric_difference(std::vector<CompensatedBlock> actual,
                                 std::vector<SlowBlock> expected, double tolerance) {
  for (CompensatedBlock& block : actual) {
    if (block.origin != Origin::passthrough) block.origin = Origin::programmed;
    block.source.number = 0;
  }
  for (SlowBlock& block : expected) {
    block.origin = Origin::programmed;
    block.ordinal = 0;
  }
  return difference(actual, expected, tolerance);
}

bool same(const Outcome& a, const Outcome& b) {
  const auto same_block = [](const CompensatedBlock& x, const CompensatedBlock& y) {
    return x.source == y.source && x.origin == y.origin && x.plane == y.plane &&
           x.rapid == y.rapid && x.tangential == y.tangential && x.path == y.path &&
           x.normal == y.normal && x.feed == y.feed && x.tracking == y.tracking && x.text == y.text;
  };
  const auto same_report = [](const Diagnostic& x, const Diagnostic& y) {
    return x.code == y.code && x.severity == y.severity && x.source == y.source;
  };
  return a.stopped == b.stopped &&
         std::equal(a.blocks.begin(), a.blocks.end(), b.blocks.begin(), b.blocks.end(),
                    same_block) &&
         std::equal(a.diagnostics.begin(), a.diagnostics.end(), b.diagnostics.begin(),
                    b.diagnostics.end(), same_report);
}

SlowPoint wide(const Point& p) { return {p.x(), p.y()}; }
Point narrow(const SlowPoint& p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

Vector start_tangent(const Segment& segment) {
  if (const auto* line = std::get_if<Line>(&segment)) return (line->end - line->start).normalized();
  const auto& arc = std::get<Arc>(segment);
  const Vector spoke = (arc.start - arc.center).normalized();
  return (arc.sweep > 0 ? 1.0 : -1.0) * Vector(-spoke.y(), spoke.x());
}

Vector end_tangent(const Segment& segment) { return -start_tangent(reversed(segment)); }

std::string name_of(Origin origin) {
  static constexpr std::array<const char*, origin_count> names = {
      "programmed",    "approach", "retract",          "transition",  "masked",
      "radius_change", "kerf",     "converted_circle", "passthrough", "uncompensated"};
  return names[static_cast<std::size_t>(origin)];
}

std::string text_of(const CompensatedBlock& block) {
  if (block.origin == Origin::passthrough)
    return std::to_string(block.source.number) + " passthrough " + block.text;
  std::string text = text_of(plain(block, Motion{}));
  if (block.normal.moves())
    text += " third " + std::to_string(block.normal.from) + ' ' + std::to_string(block.normal.to);
  return text;
}

std::string text_of(const std::vector<CompensatedBlock>& blocks) {
  std::string text;
  for (const CompensatedBlock& block : blocks) text += text_of(block) + '\n';
  return text;
}

}  // namespace trc::support
