#include <array>
#include <cstddef>

#include "core/geometry/segment.h"
#include "proto/wire/block.h"
#include "proto/wire/block_columns_layout.h"
#include "proto/wire/modes.h"
#include "proto/wire/text.h"

namespace trc::wire {
namespace {

using namespace block_columns;
using Doubles = google::protobuf::RepeatedField<double>;

unsigned kind_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::rapid:
      return Columns::KIND_RAPID;
    case MotionKind::linear:
      return Columns::KIND_LINEAR;
    case MotionKind::clockwise:
      return Columns::KIND_CLOCKWISE;
    case MotionKind::counter_clockwise:
      return Columns::KIND_COUNTER_CLOCKWISE;
  }
  return Columns::KIND_UNSPECIFIED;
}

bool fits_columns(const MoveRequest& move) {
  for (const auto& position : move.tracking)
    if (position) return false;
  return !move.radius;
}

unsigned write_coordinates(const std::array<std::optional<double>, 3>& values,
                           const std::array<Doubles*, 3>& columns) {
  unsigned bits = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!values[axis]) continue;
    columns[axis]->Add(*values[axis]);
    bits |= 1U << axis;
  }
  return bits;
}

// If every column is empty or full, the lengths of the columns imply the values of `present`.
void drop_present_if_implied(Columns& message) {
  const std::string present = message.present();
  message.clear_present();
  const Presence implied(message);
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (byte_at(present, i) == implied.of(i, byte_at(message.kinds(), i))) continue;
    message.set_present(present);
    return;
  }
}

}  // namespace

void BlockWriter::write(std::span<const PathInput> items, v1::BlockColumns& columns) {
  columns.Clear();
  columns.set_first_block(next_block_);
  next_block_ += items.size();
  const std::array<Doubles*, 3> ends{columns.mutable_x(), columns.mutable_y(), columns.mutable_z()};
  const std::array<Doubles*, 3> centers{columns.mutable_i(), columns.mutable_j(),
                                        columns.mutable_k()};
  std::string& kinds = *columns.mutable_kinds();
  std::string& present = *columns.mutable_present();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const auto* move = std::get_if<MoveRequest>(&items[i]);
    unsigned kind = Columns::KIND_OTHER;
    unsigned bits = 0;
    if (move != nullptr && !fits_columns(*move)) {
      v1::BlockColumns::BlockAt& other = *columns.add_others();
      other.set_index(index);
      write(items[i], *other.mutable_block());
    } else if (move != nullptr) {
      kind = kind_of(move->kind);
      bits = write_coordinates(move->end, ends);
      if (is_arc(kind)) bits |= write_coordinates(move->center, centers) << center_shift;
      if (move->role != ContourRole::unspecified) {
        std::string& roles = *columns.mutable_roles();
        roles.resize(items.size());
        roles[i] = static_cast<char>(block_roles.to_proto(move->role));
      }
      if (move->feed != feed_) {
        columns.add_feed(move->feed);
        bits |= feed_bit;
        feed_ = move->feed;
      }
    } else if (const auto* command = std::get_if<TrcCommand>(&items[i])) {
      kind = Columns::KIND_COMMAND;
      v1::BlockColumns::CommandAt& entry = *columns.add_commands();
      entry.set_index(index);
      to_proto(*command, *entry.mutable_command());
    } else if (const auto* passthrough = std::get_if<Passthrough>(&items[i])) {
      kind = Columns::KIND_PASSTHROUGH;
      v1::BlockColumns::PassthroughAt& entry = *columns.add_passthroughs();
      entry.set_index(index);
      set_text(passthrough->text, *entry.mutable_passthrough());
    }
    const Source& source = source_of(items[i]);
    if (kind != Columns::KIND_OTHER && source.number != Source::no_number) {
      columns.add_source_number(static_cast<std::uint64_t>(source.number));
      bits |= number_bit;
    }
    kinds.push_back(static_cast<char>(kind));
    present.push_back(static_cast<char>(bits));
  }
  drop_present_if_implied(columns);
}

}  // namespace trc::wire
