#include <array>
#include <memory>

#include "core/geometry/segment.h"
#include "proto/wire/column_cursors.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/geometry.h"

namespace trc::wire {
namespace {

using Columns = v1::CompensatedColumns;
using Doubles = google::protobuf::RepeatedField<double>;

unsigned byte_at(const std::string& bytes, std::size_t index) {
  return static_cast<unsigned char>(bytes[index]);
}

// How many blocks have a value in each sort of column.
struct Counts {
  std::size_t blocks = 0;
  std::size_t motions = 0;
  std::size_t arcs = 0;
  std::size_t feeds = 0;
  std::size_t numbers = 0;
  std::size_t indexes = 0;
  std::size_t lines = 0;
  std::size_t tracking = 0;
};

Counts count(const Columns& message, const FieldPath& path, FieldFaults& faults) {
  const std::string& kinds = message.kinds();
  Counts counts{.blocks = kinds.size()};
  if (message.flags().size() != kinds.size()) {
    add_fault(FieldPath(path, "flags"), "is not as long as kinds", faults);
    return counts;
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const unsigned kind = byte_at(kinds, i);
    const unsigned flags = byte_at(message.flags(), i);
    if (kind == Columns::KIND_UNSPECIFIED || kind > Columns::KIND_TEXT) {
      add_fault(FieldPath(path, "kinds", i), "is " + std::to_string(kind) + ", which Kind has not",
                faults);
      return counts;
    }
    counts.motions += kind != Columns::KIND_TEXT ? 1 : 0;
    counts.arcs += kind == Columns::KIND_ARC ? 1 : 0;
    counts.feeds += (flags & Columns::FLAG_FEED) != 0 ? 1 : 0;
    counts.numbers += (flags & Columns::FLAG_SOURCE_NUMBER) != 0 ? 1 : 0;
    counts.indexes += (flags & Columns::FLAG_SOURCE_INDEX) != 0 ? 1 : 0;
    counts.lines += (flags & Columns::FLAG_SOURCE_LINE) != 0 ? 1 : 0;
    counts.tracking += (flags & Columns::FLAG_TRACKING) != 0 ? 1 : 0;
  }
  return counts;
}

// Reads all columns of a message, block by block.
class ColumnReader {
 public:
  // The message can be read if no fault has been added.
  ColumnReader(const Columns& message, const Counts& counts, const FieldPath& path,
               FieldFaults& faults)
      : message_(message),
        path_(path),
        origins_(message.origins(), "origins", counts.blocks, path, faults),
        planes_(message.planes(), "planes", counts.blocks, path, faults),
        feeds_(message.feed(), "feed", counts.feeds, path, faults),
        numbers_(message.source_number(), "source_number", counts.numbers, path, faults),
        indexes_(message.source_index(), "source_index", counts.indexes, path, faults),
        lines_(message.source_line(), "source_line", counts.lines, path, faults),
        starts_{{{message.start_x(), "start_x", counts.motions, path, faults},
                 {message.start_y(), "start_y", counts.motions, path, faults},
                 {message.start_z(), "start_z", counts.motions, path, faults}}},
        ends_{{{message.end_x(), "end_x", counts.motions, path, faults},
               {message.end_y(), "end_y", counts.motions, path, faults},
               {message.end_z(), "end_z", counts.motions, path, faults}}},
        centers_{{{message.center_x(), "center_x", counts.arcs, path, faults},
                  {message.center_y(), "center_y", counts.arcs, path, faults},
                  {message.center_z(), "center_z", counts.arcs, path, faults}}},
        sweeps_(message.sweep(), "sweep", counts.arcs, path, faults),
        texts_(message.texts()),
        inverses_(message.inverses()) {
    for (int axis = 0; axis < message.tracking_axes_size(); ++axis) {
      const FieldPath entry(path, "tracking_axes", static_cast<std::size_t>(axis));
      const Columns::TrackingColumn& column = message.tracking_axes(axis);
      tracking_.push_back({.starts = {column.start(), "start", counts.tracking, entry, faults},
                           .ends = {column.end(), "end", counts.tracking, entry, faults}});
    }
  }

  // Reads the next block, except the place of a text without motion. False if it has a fault.
  bool next(CompensatedBlock& block, FieldFaults& faults) {
    const std::size_t before = faults.count();
    const unsigned kind = byte_at(message_.kinds(), next_);
    const unsigned flags = byte_at(message_.flags(), next_);
    block.origin = from_proto(static_cast<v1::CompensatedBlock::Origin>(origins_.next()),
                              FieldPath(path_, "origins", next_), faults)
                       .value_or(Origin::uncompensated);
    block.plane = from_proto(static_cast<v1::Plane>(planes_.next()),
                             FieldPath(path_, "planes", next_), faults)
                      .value_or(Plane::xy);
    if (faults.count() != before) return false;
    block.rapid = kind == Columns::KIND_RAPID;
    block.tangential = (flags & Columns::FLAG_TANGENTIAL) != 0;
    if ((flags & Columns::FLAG_FEED) != 0) block.feed = feeds_.next();
    if ((flags & Columns::FLAG_SOURCE_NUMBER) != 0)
      block.source.number = static_cast<std::int64_t>(numbers_.next());
    if ((flags & Columns::FLAG_SOURCE_INDEX) != 0) block.source.index = indexes_.next();
    if ((flags & Columns::FLAG_SOURCE_LINE) != 0) block.source.line = lines_.next();
    if (const Columns::TextAt* text = texts_.at(next_)) block.text = text->text();
    if (kind != Columns::KIND_TEXT) read_motion(kind, flags, block);
    ++next_;
    return true;
  }

  [[nodiscard]] bool next_moves() const {
    return byte_at(message_.kinds(), next_) != Columns::KIND_TEXT;
  }

  // Every entry of a list must belong to a block.
  void check_used_up(FieldFaults& faults) const {
    if (!texts_.used_up()) add_fault(FieldPath(path_, "texts"), "does not fit kinds", faults);
    if (!inverses_.used_up()) add_fault(FieldPath(path_, "inverses"), "does not fit kinds", faults);
  }

 private:
  struct TrackingCursors {
    Starts<Doubles> starts;
    Spread<Doubles> ends;
  };

  void read_motion(unsigned kind, unsigned flags, CompensatedBlock& block) {
    const Position end{ends_[0].next(), ends_[1].next(), ends_[2].next()};
    const Position start{starts_[0].next(end[0]), starts_[1].next(end[1]), starts_[2].next(end[2])};
    const std::size_t third = axes_of(block.plane).third;
    block.normal = {.from = start[third], .to = end[third]};
    const Point from = to_plane(block.plane, start);
    const Point to = to_plane(block.plane, end);
    if (kind == Columns::KIND_ARC) {
      const Position center{centers_[0].next(), centers_[1].next(), centers_[2].next()};
      block.path = Arc{.start = from,
                       .end = to,
                       .center = to_plane(block.plane, center),
                       .sweep = sweeps_.next()};
    } else {
      block.path = Line{.start = from, .end = to};
    }
    if ((flags & Columns::FLAG_TRACKING) != 0) {
      for (TrackingCursors& axis : tracking_) {
        const double axis_end = axis.ends.next();
        block.tracking.push_back({.from = axis.starts.next(axis_end), .to = axis_end});
      }
    }
    if (const Columns::InverseAt* inverse = inverses_.at(next_))
      block.inverse = std::make_shared<const Segment>(from_proto(inverse->inverse(), block.plane));
  }

  const Columns& message_;
  const FieldPath& path_;
  Spread<std::string> origins_;
  Spread<std::string> planes_;
  Spread<Doubles> feeds_;
  Spread<google::protobuf::RepeatedField<std::uint64_t>> numbers_;
  Spread<google::protobuf::RepeatedField<std::uint32_t>> indexes_;
  Spread<google::protobuf::RepeatedField<std::uint32_t>> lines_;
  std::array<Starts<Doubles>, 3> starts_;
  std::array<Spread<Doubles>, 3> ends_;
  std::array<Spread<Doubles>, 3> centers_;
  Spread<Doubles> sweeps_;
  std::vector<TrackingCursors> tracking_{};
  Sparse<google::protobuf::RepeatedPtrField<Columns::TextAt>> texts_;
  Sparse<google::protobuf::RepeatedPtrField<Columns::InverseAt>> inverses_;
  std::size_t next_ = 0;
};

}  // namespace

bool CompensatedReader::read(const v1::CompensatedColumns& message,
                             std::vector<CompensatedBlock>& out, FieldFaults& faults) {
  const FieldPath path("columns");
  const std::size_t before = faults.count();
  if (!expect(message.first_block(), path, faults)) return false;
  const Counts counts = count(message, path, faults);
  if (faults.count() != before) return false;
  ColumnReader columns(message, counts, path, faults);
  if (faults.count() != before) return false;
  if (out.empty()) out.reserve(counts.blocks);
  for (std::size_t i = 0; i < counts.blocks; ++i) {
    const bool moves = columns.next_moves();
    CompensatedBlock& block = out.emplace_back();
    if (!columns.next(block, faults)) {
      out.pop_back();
      return false;
    }
    ++next_block_;
    if (moves) {
      follow(block);
    } else {
      place_text(block);
    }
  }
  columns.check_used_up(faults);
  return faults.count() == before;
}

}  // namespace trc::wire
