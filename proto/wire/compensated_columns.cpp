#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/geometry/segment.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/geometry.h"
#include "proto/wire/text.h"

namespace trc::wire {
namespace {

using Columns = v1::CompensatedColumns;
using Doubles = google::protobuf::RepeatedField<double>;

// == treats -0 as 0, but a column must return the same double.
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// Whether all values are equal, bit for bit.
template <class Value>
bool is_constant(const Value* values, std::size_t count) {
  return std::memcmp(values, values + 1, (count - 1) * sizeof(Value)) == 0;
}

// If all values are equal, the column keeps one of them.
template <class Value>
void collapse(google::protobuf::RepeatedField<Value>& column) {
  if (column.size() > 1 && is_constant(column.data(), static_cast<std::size_t>(column.size())))
    column.Truncate(1);
}

void collapse(std::string& column) {
  if (column.size() > 1 && is_constant(column.data(), column.size())) column.resize(1);
}

// Each value of the enum as a byte of its column, for look-up per block.
template <class Native, std::size_t count>
std::array<char, count> bytes_of_enum() {
  std::array<char, count> bytes{};
  for (std::size_t value = 0; value < count; ++value)
    bytes[value] = static_cast<char>(to_proto(static_cast<Native>(value)));
  return bytes;
}

struct PositionColumns {
  Doubles* x;
  Doubles* y;
  Doubles* z;

  void add(const Position& position) const {
    x->AddAlreadyReserved(position[0]);
    y->AddAlreadyReserved(position[1]);
    z->AddAlreadyReserved(position[2]);
  }
  void reserve(int count) const {
    x->Reserve(count);
    y->Reserve(count);
    z->Reserve(count);
  }
  void collapse_each() const {
    collapse(*x);
    collapse(*y);
    collapse(*z);
  }
};

Position start_position(const CompensatedBlock& block) {
  return from_plane(block.plane, start_of(block.path), block.normal.from);
}

bool same_bits(const Point& a, const Point& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y());
}

// Whether the block starts where `before` ends, bit for bit.
bool goes_on_from(const CompensatedBlock& before, const CompensatedBlock& block) {
  if (before.plane == block.plane)
    return same_bits(end_of(before.path), start_of(block.path)) &&
           same_bits(before.normal.to, block.normal.from);
  const Position end = from_plane(before.plane, end_of(before.path), before.normal.to);
  const Position start = start_position(block);
  return same_bits(end[0], start[0]) && same_bits(end[1], start[1]) && same_bits(end[2], start[2]);
}

// Whether every start but the first repeats the previous end.
bool follows(const Doubles& starts, const Doubles& ends) {
  for (int i = 1; i < starts.size(); ++i)
    if (!same_bits(starts.Get(i), ends.Get(i - 1))) return false;
  return true;
}

void write_tracking(const TrackingTravel& tracking, Columns& message) {
  for (std::size_t axis = 0; axis < tracking.size(); ++axis) {
    if (message.tracking_axes_size() <= static_cast<int>(axis)) message.add_tracking_axes();
    Columns::TrackingColumn& column = *message.mutable_tracking_axes(static_cast<int>(axis));
    column.add_start(tracking[axis].from);
    column.add_end(tracking[axis].to);
  }
}

unsigned write_source(const Source& source, Columns& message) {
  unsigned flags = 0;
  if (source.number != Source::no_number) {
    message.add_source_number(static_cast<std::uint64_t>(source.number));
    flags |= Columns::FLAG_SOURCE_NUMBER;
  }
  if (source.index <= std::numeric_limits<std::uint32_t>::max()) {
    message.mutable_source_index()->AddAlreadyReserved(static_cast<std::uint32_t>(source.index));
    flags |= Columns::FLAG_SOURCE_INDEX;
  }
  if (source.line != 0) {
    message.add_source_line(source.line);
    flags |= Columns::FLAG_SOURCE_LINE;
  }
  return flags;
}

// Starts nearly always repeat ends, so they are only written if one does not.
void write_starts(std::span<const CompensatedBlock> blocks, const PositionColumns& starts) {
  starts.reserve(static_cast<int>(blocks.size()));
  for (const CompensatedBlock& block : blocks)
    if (!is_text_alone(block)) starts.add(start_position(block));
}

void collapse_all(Columns& message) {
  for (Columns::TrackingColumn& column : *message.mutable_tracking_axes()) {
    if (column.start_size() > 1 && follows(column.start(), column.end()))
      column.mutable_start()->Truncate(1);
    collapse(*column.mutable_end());
  }
  PositionColumns{message.mutable_end_x(), message.mutable_end_y(), message.mutable_end_z()}
      .collapse_each();
  PositionColumns{message.mutable_center_x(), message.mutable_center_y(),
                  message.mutable_center_z()}
      .collapse_each();
  collapse(*message.mutable_sweep());
  collapse(*message.mutable_feed());
  collapse(*message.mutable_source_number());
  collapse(*message.mutable_source_index());
  collapse(*message.mutable_source_line());
  collapse(*message.mutable_origins());
  collapse(*message.mutable_planes());
}

// The columns of motions; remembers the previous motion.
struct Motions {
  // Returns the kind of the motion; adds to the flags of its block.
  unsigned write(const CompensatedBlock& block, std::uint32_t index, unsigned& flags) {
    if (before == nullptr)
      first = &block;
    else
      gaps = gaps || !goes_on_from(*before, block);
    before = &block;
    ends.add(from_plane(block.plane, end_of(block.path), block.normal.to));
    const auto* arc = std::get_if<Arc>(&block.path);
    if (arc != nullptr) {
      centers.add(from_plane(block.plane, arc->center, block.normal.from));
      message.mutable_sweep()->AddAlreadyReserved(arc->sweep);
    }
    if (!block.tracking.empty()) {
      write_tracking(block.tracking, message);
      flags |= Columns::FLAG_TRACKING;
    }
    if (block.inverse) {
      Columns::InverseAt& entry = *message.add_inverses();
      entry.set_index(index);
      inverse_to_proto(block, *entry.mutable_inverse());
    }
    if (arc != nullptr) return Columns::KIND_ARC;
    return block.rapid ? Columns::KIND_RAPID : Columns::KIND_LINEAR;
  }
  // All starts if some motion does not begin where the previous one ends; otherwise only the first.
  void write_starts_of(std::span<const CompensatedBlock> blocks) {
    const PositionColumns starts{message.mutable_start_x(), message.mutable_start_y(),
                                 message.mutable_start_z()};
    if (gaps)
      write_starts(blocks, starts);
    else if (first != nullptr)
      write_starts({first, 1}, starts);
  }

  v1::CompensatedColumns& message;
  PositionColumns ends{message.mutable_end_x(), message.mutable_end_y(), message.mutable_end_z()};
  PositionColumns centers{message.mutable_center_x(), message.mutable_center_y(),
                          message.mutable_center_z()};
  const CompensatedBlock* first = nullptr;
  const CompensatedBlock* before = nullptr;  // the previous motion
  bool gaps = false;
};

}  // namespace

void to_proto(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
              v1::CompensatedColumns& message) {
  message.Clear();
  message.set_first_block(first_block);
  Motions motions{.message = message};
  std::string& kinds = *message.mutable_kinds();
  std::string& all_flags = *message.mutable_flags();
  std::string& origins = *message.mutable_origins();
  std::string& planes = *message.mutable_planes();
  for (std::string* column : {&kinds, &all_flags, &origins, &planes}) column->resize(blocks.size());
  const auto count = static_cast<int>(blocks.size());
  motions.ends.reserve(count);
  motions.centers.reserve(count);
  for (Doubles* column : {message.mutable_sweep(), message.mutable_feed()}) column->Reserve(count);
  message.mutable_source_index()->Reserve(count);
  static const auto byte_of_origin = bytes_of_enum<Origin, origin_count>();
  static const auto byte_of_plane = bytes_of_enum<Plane, 3>();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const CompensatedBlock& block = blocks[i];
    const auto index = static_cast<std::uint32_t>(i);
    unsigned kind = Columns::KIND_TEXT;
    unsigned flags = write_source(block.source, message);
    if (block.tangential) flags |= Columns::FLAG_TANGENTIAL;
    if (block.feed != 0) {
      message.mutable_feed()->AddAlreadyReserved(block.feed);
      flags |= Columns::FLAG_FEED;
    }
    if (!is_text_alone(block)) kind = motions.write(block, index, flags);
    if (!block.text.empty()) {
      Columns::TextAt& entry = *message.add_texts();
      entry.set_index(index);
      set_text(block.text, entry);
    }
    kinds[i] = static_cast<char>(kind);
    all_flags[i] = static_cast<char>(flags);
    origins[i] = byte_of_origin[static_cast<std::size_t>(block.origin)];
    planes[i] = byte_of_plane[static_cast<std::size_t>(block.plane)];
  }
  motions.write_starts_of(blocks);
  collapse_all(message);
}

}  // namespace trc::wire
