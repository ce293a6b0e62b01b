#include "proto/wire/compensated_block.h"

#include <limits>
#include <memory>

#include "proto/wire/enums.h"
#include "proto/wire/geometry.h"
#include "proto/wire/text.h"

namespace trc::wire {
namespace {

using Message = v1::CompensatedBlock;

constexpr EnumTable<Message::Origin, Origin, origin_count> origins{{
    {Message::PROGRAMMED, Origin::programmed},
    {Message::APPROACH, Origin::approach},
    {Message::RETRACT, Origin::retract},
    {Message::TRANSITION, Origin::transition},
    {Message::MASKED, Origin::masked},
    {Message::RADIUS_CHANGE, Origin::radius_change},
    {Message::KERF, Origin::kerf},
    {Message::CONVERTED_CIRCLE, Origin::converted_circle},
    {Message::PASSTHROUGH, Origin::passthrough},
    {Message::UNCOMPENSATED, Origin::uncompensated},
}};

Position position_of(const v1::Position& message) {
  return {message.x(), message.y(), message.z()};
}

void write_tracking(const TrackingTravel& tracking, Message& message) {
  for (const AxisTravel& axis : tracking) {
    message.add_tracking_start(axis.from);
    message.add_tracking_end(axis.to);
  }
}

void arc_to_proto(const Position& end, const Position& center, double sweep, v1::Arc& message) {
  to_proto(end, *message.mutable_end());
  to_proto(center, *message.mutable_center());
  message.set_sweep(sweep);
}

Arc arc_from_proto(const v1::Arc& message, const Point& start, Plane plane) {
  return {.start = start,
          .end = to_plane(plane, position_of(message.end())),
          .center = to_plane(plane, position_of(message.center())),
          .sweep = message.sweep()};
}

void write_geometry(const CompensatedBlock& block, Message& message) {
  const Position start = from_plane(block.plane, start_of(block.path), block.normal.from);
  const Position end = from_plane(block.plane, end_of(block.path), block.normal.to);
  to_proto(start, *message.mutable_start());
  if (const auto* arc = std::get_if<Arc>(&block.path)) {
    arc_to_proto(end, from_plane(block.plane, arc->center, block.normal.from), arc->sweep,
                 *message.mutable_arc());
  } else {
    message.set_rapid(block.rapid);
    to_proto(end, *message.mutable_line()->mutable_end());
  }
}

}  // namespace

v1::CompensatedBlock::Origin to_proto(Origin origin) { return origins.to_proto(origin); }

std::optional<Origin> from_proto(v1::CompensatedBlock::Origin origin, const FieldPath& path,
                                 FieldFaults& faults) {
  const std::optional<Origin> native = origins.from_proto(origin, path, faults);
  if (!native && origin == Message::ORIGIN_UNSPECIFIED) add_fault(path, "is missing", faults);
  return native;
}

bool is_text_alone(const CompensatedBlock& block) {
  if (block.origin != Origin::passthrough) return false;
  for (const AxisTravel& axis : block.tracking)
    if (axis.moves()) return false;
  const auto* line = std::get_if<Line>(&block.path);
  return line != nullptr && line->start == line->end && !block.normal.moves();
}

namespace {

// Fills an empty message.
void fill(const CompensatedBlock& block, Message& message) {
  const Source& source = block.source;
  if (source.number != Source::no_number)
    message.set_source_number(static_cast<std::uint64_t>(source.number));
  if (source.index <= std::numeric_limits<std::uint32_t>::max())
    message.set_source_index(static_cast<std::uint32_t>(source.index));
  message.set_origin(to_proto(block.origin));
  if (!block.text.empty() || block.origin == Origin::passthrough)
    set_text(block.text, *message.mutable_passthrough());
  if (block.plane != Plane::xy) message.set_plane(to_proto(block.plane));
  if (source.line != 0) message.set_source_line(source.line);
  if (block.feed != 0) message.set_feed(block.feed);
  message.set_tangential(block.tangential);
  if (is_text_alone(block)) return;
  write_geometry(block, message);
  write_tracking(block.tracking, message);
  if (block.inverse) inverse_to_proto(block, *message.mutable_inverse());
}

}  // namespace

void to_proto(const CompensatedBlock& block, v1::CompensatedBlock& message) {
  message.Clear();
  fill(block, message);
}

void to_proto(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
              v1::CompensatedBatch& message) {
  message.Clear();
  message.set_first_block(first_block);
  message.mutable_blocks()->Reserve(static_cast<int>(blocks.size()));
  for (const CompensatedBlock& block : blocks) fill(block, *message.add_blocks());
}

void inverse_to_proto(const CompensatedBlock& block, v1::InverseSegment& message) {
  const Segment& inverse = *block.inverse;
  const auto position = [&](const Point& point, double third) {
    return from_plane(block.plane, point, third);
  };
  message.Clear();
  to_proto(position(start_of(inverse), block.normal.from), *message.mutable_start());
  const Position end = position(end_of(inverse), block.normal.to);
  if (const auto* arc = std::get_if<Arc>(&inverse))
    arc_to_proto(end, position(arc->center, block.normal.from), arc->sweep, *message.mutable_arc());
  else
    to_proto(end, *message.mutable_line()->mutable_end());
}

Segment from_proto(const v1::InverseSegment& message, Plane plane) {
  const Point start = to_plane(plane, position_of(message.start()));
  if (message.has_arc()) return arc_from_proto(message.arc(), start, plane);
  return Line{.start = start, .end = to_plane(plane, position_of(message.line().end()))};
}

namespace {

void read_geometry(const v1::CompensatedBlock& message, CompensatedBlock& block) {
  const Plane plane = block.plane;
  const Position start = position_of(message.start());
  const Position end = position_of(message.has_arc() ? message.arc().end() : message.line().end());
  const std::size_t third = axes_of(plane).third;
  block.normal = {.from = start[third], .to = end[third]};
  if (message.has_arc())
    block.path = arc_from_proto(message.arc(), to_plane(plane, start), plane);
  else
    block.path = Line{.start = to_plane(plane, start), .end = to_plane(plane, end)};
}

}  // namespace

void CompensatedReader::place_text(CompensatedBlock& block) const {
  const Point here = to_plane(block.plane, position_);
  const double height = position_[axes_of(block.plane).third];
  block.path = Line{.start = here, .end = here};
  block.normal = {.from = height, .to = height};
  block.tracking = tracking_;
}

void CompensatedReader::follow(const CompensatedBlock& block) {
  position_ = from_plane(block.plane, end_of(block.path), block.normal.to);
  tracking_ = block.tracking;
  for (AxisTravel& axis : tracking_) axis.from = axis.to;
}

bool CompensatedReader::expect(std::uint64_t first_block, const FieldPath& path,
                               FieldFaults& faults) {
  if (first_block == next_block_) return true;
  add_fault(FieldPath(path, "first_block"),
            "is " + std::to_string(first_block) + ", expected is " + std::to_string(next_block_),
            faults);
  return false;
}

bool CompensatedReader::read(const v1::CompensatedBlock& message, const FieldPath& path,
                             CompensatedBlock& block, FieldFaults& faults) {
  const std::size_t before = faults.count();
  block = {};
  block.source = {.index = message.source_index(),
                  .number = message.has_source_number()
                                ? static_cast<std::int64_t>(message.source_number())
                                : Source::no_number,
                  .line = message.source_line()};
  block.origin = from_proto(message.origin(), FieldPath(path, "origin"), faults)
                     .value_or(Origin::uncompensated);
  block.plane = from_proto(message.plane(), FieldPath(path, "plane"), faults).value_or(Plane::xy);
  block.rapid = message.rapid();
  block.tangential = message.tangential();
  block.feed = message.feed();
  block.text = message.passthrough().text();
  if (message.tracking_start_size() != message.tracking_end_size())
    add_fault(FieldPath(path, "tracking_end"), "is not as long as tracking_start", faults);
  if (faults.count() != before) return false;

  ++next_block_;
  if (message.geometry_case() == Message::GEOMETRY_NOT_SET) {
    place_text(block);
    return true;
  }
  read_geometry(message, block);
  for (int axis = 0; axis < message.tracking_start_size(); ++axis)
    block.tracking.push_back(
        {.from = message.tracking_start(axis), .to = message.tracking_end(axis)});
  if (message.has_inverse())
    block.inverse = std::make_shared<const Segment>(from_proto(message.inverse(), block.plane));
  follow(block);
  return true;
}

bool CompensatedReader::read(const v1::CompensatedBatch& batch, std::vector<CompensatedBlock>& out,
                             FieldFaults& faults) {
  const FieldPath path("batch");
  if (!expect(batch.first_block(), path, faults)) return false;
  for (int i = 0; i < batch.blocks_size(); ++i)
    if (!read(batch.blocks(i), FieldPath(path, "blocks", static_cast<std::size_t>(i)),
              out.emplace_back(), faults)) {
      out.pop_back();
      return false;
    }
  return true;
}

}  // namespace trc::wire
