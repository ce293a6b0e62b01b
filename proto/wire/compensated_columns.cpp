#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>

#include "core/geometry/segment.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/geometry.h"

namespace trc::wire {
namespace {

using Columns = v1::CompensatedColumns;
using Doubles = google::protobuf::RepeatedField<double>;

// == takes -0 for 0; a column must give back the same double.
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
template <class Value>
bool same_bits(Value a, Value b) {
  return a == b;
}

// A column with one value for all blocks keeps that one only.
template <class Value>
void collapse(google::protobuf::RepeatedField<Value>& column) {
  if (column.size() < 2) return;
  const Value first = column.Get(0);
  const bool constant = std::all_of(column.begin(), column.end(),
                                    [first](Value value) { return same_bits(value, first); });
  if (constant) column.Truncate(1);
}

void collapse(std::string& column) {
  if (column.size() > 1 && column.find_first_not_of(column[0]) == std::string::npos)
    column.resize(1);
}

struct PositionColumns {
  Doubles* x;
  Doubles* y;
  Doubles* z;

  void add(const Position& position) const {
    x->Add(position[0]);
    y->Add(position[1]);
    z->Add(position[2]);
  }
  void collapse_each() const {
    collapse(*x);
    collapse(*y);
    collapse(*z);
  }
};

// Whether every value but the first repeats the end of the one before it.
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
    message.add_source_index(static_cast<std::uint32_t>(source.index));
    flags |= Columns::FLAG_SOURCE_INDEX;
  }
  if (source.line != 0) {
    message.add_source_line(source.line);
    flags |= Columns::FLAG_SOURCE_LINE;
  }
  return flags;
}

void collapse_all(Columns& message) {
  Doubles& start_x = *message.mutable_start_x();
  Doubles& start_y = *message.mutable_start_y();
  Doubles& start_z = *message.mutable_start_z();
  if (follows(start_x, message.end_x()) && follows(start_y, message.end_y()) &&
      follows(start_z, message.end_z()) && start_x.size() > 1) {
    start_x.Truncate(1);
    start_y.Truncate(1);
    start_z.Truncate(1);
  }
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

unsigned byte_at(const std::string& bytes, std::size_t index) {
  return static_cast<unsigned char>(bytes[index]);
}

// A column that holds one value for each block of a sort, or one for all.
template <class Field>
class Spread {
 public:
  Spread(const Field& values, std::string_view name, std::size_t expected, const FieldPath& path,
         FieldFaults& faults)
      : values_(values), single_(values.size() == 1) {
    const auto size = static_cast<std::size_t>(values.size());
    if (size == expected || (size == 1 && expected > 1)) return;
    add_fault(FieldPath(path, name),
              "has " + std::to_string(size) + " values, expected are " + std::to_string(expected) +
                  " or one for all",
              faults);
  }
  auto next() { return values_[single_ ? 0 : next_++]; }

 private:
  const Field& values_;
  bool single_;
  int next_ = 0;
};
using DoubleSpread = Spread<Doubles>;

struct PositionSpread {
  DoubleSpread x;
  DoubleSpread y;
  DoubleSpread z;
  Position next() { return {x.next(), y.next(), z.next()}; }
};

struct Counts {
  std::size_t motions = 0;
  std::size_t arcs = 0;
  std::size_t feeds = 0;
  std::size_t numbers = 0;
  std::size_t indexes = 0;
  std::size_t lines = 0;
  std::size_t tracking = 0;
};

bool count(const Columns& message, const FieldPath& path, Counts& counts, FieldFaults& faults) {
  const std::string& kinds = message.kinds();
  if (message.flags().size() != kinds.size()) {
    add_fault(FieldPath(path, "flags"), "is not as long as kinds", faults);
    return false;
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const unsigned kind = byte_at(kinds, i);
    const unsigned flags = byte_at(message.flags(), i);
    if (kind == Columns::KIND_UNSPECIFIED || kind > Columns::KIND_TEXT) {
      add_fault(FieldPath(path, "kinds", i), "is " + std::to_string(kind) + ", which Kind has not",
                faults);
      return false;
    }
    counts.motions += kind != Columns::KIND_TEXT ? 1 : 0;
    counts.arcs += kind == Columns::KIND_ARC ? 1 : 0;
    counts.feeds += (flags & Columns::FLAG_FEED) != 0 ? 1 : 0;
    counts.numbers += (flags & Columns::FLAG_SOURCE_NUMBER) != 0 ? 1 : 0;
    counts.indexes += (flags & Columns::FLAG_SOURCE_INDEX) != 0 ? 1 : 0;
    counts.lines += (flags & Columns::FLAG_SOURCE_LINE) != 0 ? 1 : 0;
    counts.tracking += (flags & Columns::FLAG_TRACKING) != 0 ? 1 : 0;
  }
  return true;
}

// The starts of a column: one for each block, or the first one only.
class Starts {
 public:
  Starts(const Doubles& starts, std::string_view name, std::size_t expected, const FieldPath& path,
         FieldFaults& faults)
      : starts_(starts), chained_(starts.size() == 1) {
    const auto size = static_cast<std::size_t>(starts.size());
    if (size == expected || (size == 1 && expected > 1)) return;
    add_fault(FieldPath(path, name),
              "has " + std::to_string(size) + " values, expected are " + std::to_string(expected) +
                  " or the first one",
              faults);
  }
  // `end`: of the block this start belongs to.
  double next(double end) {
    const double start = chained_ && next_ > 0 ? last_end_ : starts_[chained_ ? 0 : next_];
    ++next_;
    last_end_ = end;
    return start;
  }

 private:
  const Doubles& starts_;
  bool chained_;
  int next_ = 0;
  double last_end_ = 0;
};

struct TrackingReader {
  DoubleSpread ends;
  Starts starts;
};

std::vector<TrackingReader> tracking_readers(const Columns& message, std::size_t expected,
                                             const FieldPath& path, FieldFaults& faults) {
  std::vector<TrackingReader> readers;
  for (int axis = 0; axis < message.tracking_axes_size(); ++axis) {
    const FieldPath entry(path, "tracking_axes", static_cast<std::size_t>(axis));
    const Columns::TrackingColumn& column = message.tracking_axes(axis);
    readers.push_back({.ends = {column.end(), "end", expected, entry, faults},
                       .starts = {column.start(), "start", expected, entry, faults}});
  }
  return readers;
}

// Hands out the entry that stands at a position, entries in order of position.
template <class List>
class Sparse {
 public:
  explicit Sparse(const List& list) : list_(list) {}
  auto* at(std::size_t index) {
    using Entry = const typename List::value_type;
    if (next_ == list_.size() || list_.Get(next_).index() != index)
      return static_cast<Entry*>(nullptr);
    return static_cast<Entry*>(&list_.Get(next_++));
  }
  [[nodiscard]] bool used_up() const { return next_ == list_.size(); }

 private:
  const List& list_;
  int next_ = 0;
};
template <class List>
Sparse(const List&) -> Sparse<List>;

}  // namespace

void to_proto(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
              v1::CompensatedColumns& message) {
  message.Clear();
  message.set_first_block(first_block);
  const PositionColumns starts{message.mutable_start_x(), message.mutable_start_y(),
                               message.mutable_start_z()};
  const PositionColumns ends{message.mutable_end_x(), message.mutable_end_y(),
                             message.mutable_end_z()};
  const PositionColumns centers{message.mutable_center_x(), message.mutable_center_y(),
                                message.mutable_center_z()};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const CompensatedBlock& block = blocks[i];
    const auto index = static_cast<std::uint32_t>(i);
    unsigned kind = Columns::KIND_TEXT;
    unsigned flags = write_source(block.source, message);
    if (block.tangential) flags |= Columns::FLAG_TANGENTIAL;
    if (block.feed != 0) {
      message.add_feed(block.feed);
      flags |= Columns::FLAG_FEED;
    }
    if (!is_text_alone(block)) {
      kind = block.rapid ? Columns::KIND_RAPID : Columns::KIND_LINEAR;
      starts.add(from_plane(block.plane, start_of(block.path), block.normal.from));
      ends.add(from_plane(block.plane, end_of(block.path), block.normal.to));
      if (const auto* arc = std::get_if<Arc>(&block.path)) {
        kind = Columns::KIND_ARC;
        centers.add(from_plane(block.plane, arc->center, block.normal.from));
        message.add_sweep(arc->sweep);
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
    }
    if (!block.text.empty()) {
      Columns::TextAt& entry = *message.add_texts();
      entry.set_index(index);
      entry.set_text(block.text);
    }
    message.mutable_kinds()->push_back(static_cast<char>(kind));
    message.mutable_flags()->push_back(static_cast<char>(flags));
    message.mutable_origins()->push_back(static_cast<char>(to_proto(block.origin)));
    message.mutable_planes()->push_back(static_cast<char>(to_proto(block.plane)));
  }
  collapse_all(message);
}

bool CompensatedReader::read(const v1::CompensatedColumns& message,
                             std::vector<CompensatedBlock>& out, FieldFaults& faults) {
  const FieldPath path("columns");
  Counts counts;
  if (!expect(message.first_block(), path, faults) || !count(message, path, counts, faults))
    return false;
  const std::size_t size = message.kinds().size();
  Spread origins(message.origins(), "origins", size, path, faults);
  Spread planes(message.planes(), "planes", size, path, faults);
  Spread feeds(message.feed(), "feed", counts.feeds, path, faults);
  Spread numbers(message.source_number(), "source_number", counts.numbers, path, faults);
  Spread indexes(message.source_index(), "source_index", counts.indexes, path, faults);
  Spread lines(message.source_line(), "source_line", counts.lines, path, faults);
  Spread sweeps(message.sweep(), "sweep", counts.arcs, path, faults);
  PositionSpread ends{{message.end_x(), "end_x", counts.motions, path, faults},
                      {message.end_y(), "end_y", counts.motions, path, faults},
                      {message.end_z(), "end_z", counts.motions, path, faults}};
  PositionSpread centers{{message.center_x(), "center_x", counts.arcs, path, faults},
                         {message.center_y(), "center_y", counts.arcs, path, faults},
                         {message.center_z(), "center_z", counts.arcs, path, faults}};
  std::array<Starts, 3> starts{{{message.start_x(), "start_x", counts.motions, path, faults},
                                {message.start_y(), "start_y", counts.motions, path, faults},
                                {message.start_z(), "start_z", counts.motions, path, faults}}};
  auto tracking = tracking_readers(message, counts.tracking, path, faults);
  if (!faults.empty()) return false;

  Sparse texts(message.texts());
  Sparse inverses(message.inverses());
  for (std::size_t i = 0; i < size; ++i) {
    const unsigned kind = byte_at(message.kinds(), i);
    const unsigned flags = byte_at(message.flags(), i);
    const auto origin = from_proto(static_cast<v1::CompensatedBlock::Origin>(origins.next()),
                                   FieldPath(path, "origins", i), faults);
    const auto plane =
        from_proto(static_cast<v1::Plane>(planes.next()), FieldPath(path, "planes", i), faults);
    if (!origin || !faults.empty()) return false;
    CompensatedBlock& block = out.emplace_back();
    ++next_block_;
    block.origin = *origin;
    block.plane = plane.value_or(Plane::xy);
    block.rapid = kind == Columns::KIND_RAPID;
    block.tangential = (flags & Columns::FLAG_TANGENTIAL) != 0;
    if ((flags & Columns::FLAG_FEED) != 0) block.feed = feeds.next();
    if ((flags & Columns::FLAG_SOURCE_NUMBER) != 0)
      block.source.number = static_cast<std::int64_t>(numbers.next());
    if ((flags & Columns::FLAG_SOURCE_INDEX) != 0) block.source.index = indexes.next();
    if ((flags & Columns::FLAG_SOURCE_LINE) != 0) block.source.line = lines.next();
    if (const Columns::TextAt* text = texts.at(i)) block.text = text->text();
    if (kind == Columns::KIND_TEXT) {
      seat_text(block);
      continue;
    }
    const Position end = ends.next();
    const Position start{starts[0].next(end[0]), starts[1].next(end[1]), starts[2].next(end[2])};
    const std::size_t third = axes_of(block.plane).third;
    block.normal = {.from = start[third], .to = end[third]};
    const Point from = to_plane(block.plane, start);
    const Point to = to_plane(block.plane, end);
    if (kind == Columns::KIND_ARC)
      block.path = Arc{.start = from,
                       .end = to,
                       .center = to_plane(block.plane, centers.next()),
                       .sweep = sweeps.next()};
    else
      block.path = Line{.start = from, .end = to};
    if ((flags & Columns::FLAG_TRACKING) != 0)
      for (TrackingReader& axis : tracking) {
        const double axis_end = axis.ends.next();
        block.tracking.push_back({.from = axis.starts.next(axis_end), .to = axis_end});
      }
    if (const Columns::InverseAt* inverse = inverses.at(i))
      block.inverse = std::make_shared<const Segment>(from_proto(inverse->inverse(), block.plane));
    follow(block);
  }
  if (!texts.used_up()) add_fault(FieldPath(path, "texts"), "does not fit kinds", faults);
  if (!inverses.used_up()) add_fault(FieldPath(path, "inverses"), "does not fit kinds", faults);
  return faults.empty();
}

}  // namespace trc::wire
