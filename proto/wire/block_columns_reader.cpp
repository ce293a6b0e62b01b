#include <array>
#include <cstddef>

#include "proto/wire/block.h"
#include "proto/wire/block_columns_checks.h"
#include "proto/wire/block_columns_layout.h"
#include "proto/wire/block_values.h"

namespace trc::wire {
namespace {

using namespace block_columns;

constexpr std::array<MotionKind, 5> motion_kinds{MotionKind::linear, MotionKind::linear,
                                                 MotionKind::rapid, MotionKind::clockwise,
                                                 MotionKind::counter_clockwise};

// Reads one column from its first value to its last.
template <class Value>
class Cursor {
 public:
  Cursor(const google::protobuf::RepeatedField<Value>& values, std::string_view name)
      : values_(values), name_(name) {}
  Value next() { return values_.Get(next_++); }
  // The place of the value given last.
  [[nodiscard]] FieldPath place(const FieldPath& path) const {
    return {path, name_, static_cast<std::size_t>(next_ - 1)};
  }

 private:
  const google::protobuf::RepeatedField<Value>& values_;
  std::string_view name_;
  int next_ = 0;
};

using CoordinateCursors = std::array<Cursor<double>, 3>;

bool read_coordinates(unsigned bits, CoordinateCursors& cursors, const FieldPath& path,
                      std::array<std::optional<double>, 3>& target, FieldFaults& faults) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (((bits >> axis) & 1U) == 0) continue;
    const double value = cursors[axis].next();
    // The place is only built for a faulty value.
    if (!is_coordinate(value)) [[unlikely]]
      return check_coordinate(value, cursors[axis].place(path), faults);
    target[axis] = value;
  }
  return true;
}

// The reading position in each list of a message.
struct ColumnCursors {
  explicit ColumnCursors(const Columns& columns)
      : ends{{{columns.x(), "x"}, {columns.y(), "y"}, {columns.z(), "z"}}},
        centers{{{columns.i(), "i"}, {columns.j(), "j"}, {columns.k(), "k"}}},
        feeds(columns.feed(), "feed"),
        numbers(columns.source_number(), "source_number") {}

  CoordinateCursors ends;
  CoordinateCursors centers;
  Cursor<double> feeds;
  Cursor<std::uint64_t> numbers;
  int command = 0;
  int passthrough = 0;
  int other = 0;
};

bool read_number(unsigned bits, ColumnCursors& cursors, const FieldPath& path,
                 std::int64_t& source_number, FieldFaults& faults) {
  source_number = Source::no_number;
  if ((bits & number_bit) == 0) return true;
  const std::uint64_t number = cursors.numbers.next();
  if (!is_number(number)) [[unlikely]]
    return check_number(number, cursors.numbers.place(path), faults);
  source_number = static_cast<std::int64_t>(number);
  return true;
}

bool read_command(const Columns& columns, ColumnCursors& cursors, const FieldPath& path,
                  TrcCommand& item, FieldFaults& faults) {
  const FieldPath entry(path, "commands", static_cast<std::size_t>(cursors.command));
  const FieldPath place(entry, "command");
  const v1::BlockColumns::CommandAt& at = columns.commands(cursors.command++);
  if (at.has_command()) return from_proto(at.command(), place, item, faults);
  add_fault(place, "is missing", faults);
  return false;
}

bool read_passthrough(const Columns& columns, ColumnCursors& cursors, const FieldPath& path,
                      Passthrough& item, FieldFaults& faults) {
  const FieldPath entry(path, "passthroughs", static_cast<std::size_t>(cursors.passthrough));
  const FieldPath place(entry, "passthrough");
  const v1::BlockColumns::PassthroughAt& at = columns.passthroughs(cursors.passthrough++);
  if (!at.has_passthrough()) {
    add_fault(place, "is missing", faults);
    return false;
  }
  item.text = at.passthrough().text();
  return check_text(item.text, FieldPath(place, "text"), faults);
}

// `feed` is the feed in force.
bool read_move(unsigned bits, ColumnCursors& cursors, double& feed, MoveRequest& move,
               const FieldReader& reader) {
  const auto& [path, faults] = reader;
  if (!read_coordinates(bits & end_bits, cursors.ends, path, move.end, faults) ||
      !read_coordinates((bits & center_bits) >> center_shift, cursors.centers, path, move.center,
                        faults))
    return false;
  if ((bits & feed_bit) != 0) {
    feed = cursors.feeds.next();
    if (!check_feed(feed, cursors.feeds.place(path), faults)) return false;
  }
  move.feed = feed;
  return true;
}

}  // namespace

bool BlockReader::read(const v1::BlockColumns& columns, const Sink& sink, FieldFaults& faults) {
  const FieldPath path("columns");
  if (!block_columns::check(columns, {path, faults})) return false;
  const Presence presence(columns);
  ColumnCursors cursors(columns);
  for (std::size_t i = 0; i < columns.kinds().size(); ++i) {
    const unsigned kind = byte_at(columns.kinds(), i);
    if (kind == Columns::KIND_OTHER) {
      const FieldPath entry(path, "others", static_cast<std::size_t>(cursors.other));
      const v1::Block& block = columns.others(cursors.other++).block();
      if (!block.has_linear() && !block.has_circular()) {
        add_fault(FieldPath(entry, "block"), "is neither a linear nor a circular move", faults);
        return false;
      }
      if (!read(block, FieldPath(entry, "block"), sink, faults)) return false;
      continue;
    }
    const unsigned bits = presence.of(i, kind);
    std::int64_t source_number = Source::no_number;
    if (!read_number(bits, cursors, path, source_number, faults)) return false;
    // Field by field: a copy of the whole source would wait for fields that are still being stored.
    const auto name_source = [&](Source& source) {
      source.index = next_block_;
      source.number = source_number;
    };
    if (kind == Columns::KIND_COMMAND) {
      auto& item = item_.emplace<TrcCommand>();
      if (!read_command(columns, cursors, path, item, faults)) return false;
      name_source(item.source);
    } else if (kind == Columns::KIND_PASSTHROUGH) {
      auto& item = item_.emplace<Passthrough>();
      if (!read_passthrough(columns, cursors, path, item, faults)) return false;
      name_source(item.source);
    } else {
      MoveRequest& move = fresh_move();
      name_source(move.source);
      move.kind = motion_kinds[kind];
      if (!read_move(bits, cursors, feed_, move, {path, faults})) return false;
      if (!columns.roles().empty() && columns.roles()[i] != 0)
        move.role = static_cast<v1::BlockRole>(columns.roles()[i]) == v1::BLOCK_ROLE_LEAD
                        ? ContourRole::lead
                        : ContourRole::wall;
    }
    ++next_block_;
    if (!sink(item_)) return false;
  }
  return true;
}

}  // namespace trc::wire
