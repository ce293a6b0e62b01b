#include "proto/wire/block.h"

#include "core/base/tolerances.h"
#include "core/geometry/segment.h"
#include "proto/wire/block_values.h"
#include "proto/wire/geometry.h"
#include "proto/wire/modes.h"
#include "proto/wire/text.h"

namespace trc::wire {
namespace {

constexpr double largest_tracking = Tolerances{}.largest_coordinate;  // mm or degrees

bool read_feed(bool present, double value, const FieldPath& path, double& feed,
               FieldFaults& faults) {
  if (!present) return true;
  if (!check_feed(value, FieldPath(path, "feed"), faults)) return false;
  feed = value;
  return true;
}

bool read_tracking(const google::protobuf::RepeatedPtrField<v1::AxisPosition>& positions,
                   std::size_t axes, const FieldPath& path,
                   std::vector<std::optional<double>>& tracking, FieldFaults& faults) {
  if (positions.empty()) return true;
  tracking.resize(axes);
  for (int i = 0; i < positions.size(); ++i) {
    const v1::AxisPosition& position = positions.Get(i);
    const FieldPath entry(path, "tracking_axes", static_cast<std::size_t>(i));
    if (position.axis() >= axes) {
      add_fault(FieldPath(entry, "axis"),
                "is " + std::to_string(position.axis()) + ", the setup names " +
                    std::to_string(axes) + " axes",
                faults);
      return false;
    }
    std::optional<double>& target = tracking[position.axis()];
    if (target) {
      add_fault(FieldPath(entry, "axis"), "is programmed twice in one block", faults);
      return false;
    }
    if (!check_range(position.position(), {-largest_tracking, largest_tracking},
                     FieldPath(entry, "position"), faults))
      return false;
    target = position.position();
  }
  return true;
}

bool read_role(v1::BlockRole role, const FieldPath& path, MoveRequest& move, FieldFaults& faults) {
  const std::size_t before = faults.count();
  move.role = block_roles.from_proto(role, FieldPath(path, "role"), faults).value_or(move.role);
  return faults.count() == before;
}

// `feed` is the feed in force.
bool read_move(const v1::LinearMove& message, std::size_t axes, MoveRequest& move, double& feed,
               const FieldReader& reader) {
  const auto& [path, faults] = reader;
  move.kind = message.rapid() ? MotionKind::rapid : MotionKind::linear;
  return from_proto(message.end(), FieldPath(path, "end"), move.end, faults) &&
         read_tracking(message.tracking_axes(), axes, path, move.tracking, faults) &&
         read_role(message.role(), path, move, faults) &&
         read_feed(message.has_feed(), message.feed(), path, feed, faults);
}

bool read_move(const v1::CircularMove& message, std::size_t axes, MoveRequest& move, double& feed,
               const FieldReader& reader) {
  const auto& [path, faults] = reader;
  move.kind = message.clockwise() ? MotionKind::clockwise : MotionKind::counter_clockwise;
  if (!from_proto(message.end(), FieldPath(path, "end"), move.end, faults)) return false;
  switch (message.arc_case()) {
    case v1::CircularMove::kCenter:
      if (!from_proto(message.center(), FieldPath(path, "center"), move.center, faults))
        return false;
      break;
    case v1::CircularMove::kRadius:
      if (!check_coordinate(message.radius(), FieldPath(path, "radius"), faults)) return false;
      move.radius = message.radius();
      break;
    case v1::CircularMove::ARC_NOT_SET:
      add_fault(path, "has neither center nor radius", faults);
      return false;
  }
  return read_tracking(message.tracking_axes(), axes, path, move.tracking, faults) &&
         read_role(message.role(), path, move, faults) &&
         read_feed(message.has_feed(), message.feed(), path, feed, faults);
}

void write_tracking(const MoveRequest& move,
                    google::protobuf::RepeatedPtrField<v1::AxisPosition>& positions) {
  for (std::size_t axis = 0; axis < move.tracking.size(); ++axis) {
    if (!move.tracking[axis]) continue;
    v1::AxisPosition& position = *positions.Add();
    position.set_axis(static_cast<std::uint32_t>(axis));
    position.set_position(*move.tracking[axis]);
  }
}

bool has_coordinate(const OptionalPosition& position) {
  return position[0] || position[1] || position[2];
}

void write_move(const MoveRequest& move, bool with_feed, v1::LinearMove& message) {
  if (has_coordinate(move.end)) to_proto(move.end, *message.mutable_end());
  message.set_rapid(move.kind == MotionKind::rapid);
  if (with_feed) message.set_feed(move.feed);
  message.set_role(block_roles.to_proto(move.role));
  write_tracking(move, *message.mutable_tracking_axes());
}

void write_move(const MoveRequest& move, bool with_feed, v1::CircularMove& message) {
  if (has_coordinate(move.end)) to_proto(move.end, *message.mutable_end());
  message.set_clockwise(move.kind == MotionKind::clockwise);
  if (move.radius)
    message.set_radius(*move.radius);
  else
    to_proto(move.center, *message.mutable_center());
  if (with_feed) message.set_feed(move.feed);
  message.set_role(block_roles.to_proto(move.role));
  write_tracking(move, *message.mutable_tracking_axes());
}

}  // namespace

const Source& source_of(const PathInput& input) {
  return std::visit([](const auto& item) -> const Source& { return item.source; }, input);
}

bool apply(const PathInput& input, ProgramState& program) {
  return std::visit(overloaded{
                        [&](const MoveRequest& move) { return program.move(move); },
                        [&](const TrcCommand& command) { return apply(command, program); },
                        [&](const Passthrough& passthrough) {
                          return program.pass(passthrough.source, passthrough.text);
                        },
                    },
                    input);
}

MoveRequest& BlockReader::fresh_move() {
  auto* move = std::get_if<MoveRequest>(&item_);
  if (move == nullptr) return item_.emplace<MoveRequest>();
  // Assigned field by field, so that the vector keeps its memory.
  move->source = {};
  move->end = {};
  move->center = {};
  move->radius.reset();
  move->role = ContourRole::unspecified;
  move->tracking.clear();
  return *move;
}

bool BlockReader::read(const v1::Block& block, const FieldPath& path, const Sink& sink,
                       FieldFaults& faults) {
  Source source{.index = next_block_};
  if (block.has_source_number()) {
    if (!check_number(block.source_number(), FieldPath(path, "source_number"), faults))
      return false;
    source.number = static_cast<std::int64_t>(block.source_number());
  }
  switch (block.block_case()) {
    case v1::Block::kLinear: {
      MoveRequest& move = fresh_move();
      move.source = source;
      if (!read_move(block.linear(), tracking_axes_, move, feed_,
                     {FieldPath(path, "linear"), faults}))
        return false;
      move.feed = feed_;
      break;
    }
    case v1::Block::kCircular: {
      MoveRequest& move = fresh_move();
      move.source = source;
      if (!read_move(block.circular(), tracking_axes_, move, feed_,
                     {FieldPath(path, "circular"), faults}))
        return false;
      move.feed = feed_;
      break;
    }
    case v1::Block::kCommand: {
      auto& command = item_.emplace<TrcCommand>();
      if (!from_proto(block.command(), FieldPath(path, "command"), command, faults)) return false;
      command.source = source;
      break;
    }
    case v1::Block::kPassthrough:
      if (!check_text(block.passthrough().text(), FieldPath(FieldPath(path, "passthrough"), "text"),
                      faults))
        return false;
      item_ = Passthrough{.source = source, .text = block.passthrough().text()};
      break;
    case v1::Block::BLOCK_NOT_SET:
      add_fault(path, "has no content", faults);
      return false;
  }
  ++next_block_;
  return sink(item_);
}

bool BlockReader::read(const v1::BlockBatch& batch, const Sink& sink, FieldFaults& faults) {
  const FieldPath path("batch");
  for (int i = 0; i < batch.blocks_size(); ++i)
    if (!read(batch.blocks(i), FieldPath(path, "blocks", static_cast<std::size_t>(i)), sink,
              faults))
      return false;
  return true;
}

void BlockWriter::write(const PathInput& item, v1::Block& block) {
  const Source& source = source_of(item);
  if (source.number != Source::no_number)
    block.set_source_number(static_cast<std::uint64_t>(source.number));
  std::visit(overloaded{
                 [&](const MoveRequest& move) {
                   const bool with_feed = move.feed != feed_;
                   feed_ = move.feed;
                   if (move.kind == MotionKind::rapid || move.kind == MotionKind::linear)
                     write_move(move, with_feed, *block.mutable_linear());
                   else
                     write_move(move, with_feed, *block.mutable_circular());
                 },
                 [&](const TrcCommand& command) { to_proto(command, *block.mutable_command()); },
                 [&](const Passthrough& passthrough) {
                   set_text(passthrough.text, *block.mutable_passthrough());
                 },
             },
             item);
}

void BlockWriter::write(std::span<const PathInput> items, v1::BlockBatch& batch) {
  batch.Clear();
  batch.set_first_block(next_block_);
  for (const PathInput& item : items) write(item, *batch.add_blocks());
  next_block_ += items.size();
}

}  // namespace trc::wire
