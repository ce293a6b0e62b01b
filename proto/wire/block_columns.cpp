#include <array>
#include <cstddef>

#include "core/geometry/segment.h"
#include "proto/wire/block.h"
#include "proto/wire/block_values.h"
#include "proto/wire/modes.h"
#include "proto/wire/text.h"

namespace trc::wire {
namespace {

using Columns = v1::BlockColumns;
using Doubles = google::protobuf::RepeatedField<double>;

constexpr unsigned end_bits =
    Columns::PRESENT_BIT_X | Columns::PRESENT_BIT_Y | Columns::PRESENT_BIT_Z;
constexpr unsigned center_bits =
    Columns::PRESENT_BIT_I | Columns::PRESENT_BIT_J | Columns::PRESENT_BIT_K;
constexpr unsigned feed_bit = Columns::PRESENT_BIT_FEED;
constexpr unsigned number_bit = Columns::PRESENT_BIT_SOURCE_NUMBER;

bool is_motion(unsigned kind) {
  return kind >= Columns::KIND_LINEAR && kind <= Columns::KIND_COUNTER_CLOCKWISE;
}
bool is_arc(unsigned kind) {
  return kind == Columns::KIND_CLOCKWISE || kind == Columns::KIND_COUNTER_CLOCKWISE;
}

// The bits a block of this kind may have.
unsigned allowed_bits(unsigned kind) {
  if (kind == Columns::KIND_OTHER) return 0;
  if (is_arc(kind)) return end_bits | center_bits | feed_bit | number_bit;
  return is_motion(kind) ? end_bits | feed_bit | number_bit : number_bit;
}

struct Column {
  std::string_view name;
  unsigned bit;
  std::size_t size;
};

std::array<Column, 8> columns_of(const Columns& message) {
  const auto size = [](const auto& field) { return static_cast<std::size_t>(field.size()); };
  return {{
      {"x", Columns::PRESENT_BIT_X, size(message.x())},
      {"y", Columns::PRESENT_BIT_Y, size(message.y())},
      {"z", Columns::PRESENT_BIT_Z, size(message.z())},
      {"i", Columns::PRESENT_BIT_I, size(message.i())},
      {"j", Columns::PRESENT_BIT_J, size(message.j())},
      {"k", Columns::PRESENT_BIT_K, size(message.k())},
      {"feed", feed_bit, size(message.feed())},
      {"source_number", number_bit, size(message.source_number())},
  }};
}

unsigned byte_at(const std::string& bytes, std::size_t index) {
  return static_cast<unsigned char>(bytes[index]);
}

// Which bits each block has, whichever of the two forms the message uses.
class Presence {
 public:
  explicit Presence(const Columns& message) : bytes_(message.present()) {
    for (const Column& column : columns_of(message))
      if (column.size > 0) filled_ |= column.bit;
  }
  [[nodiscard]] unsigned of(std::size_t index, unsigned kind) const {
    return bytes_.empty() ? filled_ & allowed_bits(kind) : byte_at(bytes_, index);
  }

 private:
  const std::string& bytes_;
  unsigned filled_ = 0;
};

bool check_kinds(const Columns& message, const FieldPath& path, FieldFaults& faults) {
  const std::string& kinds = message.kinds();
  const std::string& present = message.present();
  const std::size_t before = faults.count();
  if (!present.empty() && present.size() != kinds.size())
    add_fault(FieldPath(path, "present"),
              "has " + std::to_string(present.size()) + " bytes, kinds has " +
                  std::to_string(kinds.size()),
              faults);
  for (std::size_t i = 0; i < kinds.size() && faults.count() == before; ++i) {
    const unsigned kind = byte_at(kinds, i);
    if (kind == Columns::KIND_UNSPECIFIED || kind > Columns::KIND_OTHER)
      add_fault(FieldPath(path, "kinds", i), "is " + std::to_string(kind) + ", which Kind has not",
                faults);
    else if (!present.empty() && (byte_at(present, i) & ~allowed_bits(kind)) != 0)
      add_fault(FieldPath(path, "present", i),
                "has a bit that a block of kind " + std::to_string(kind) + " cannot have", faults);
  }
  return faults.count() == before;
}

bool check_roles(const Columns& message, const FieldPath& path, FieldFaults& faults) {
  const std::string& roles = message.roles();
  if (roles.empty()) return true;
  const FieldPath place(path, "roles");
  if (roles.size() != message.kinds().size()) {
    add_fault(place,
              "has " + std::to_string(roles.size()) + " bytes, kinds has " +
                  std::to_string(message.kinds().size()),
              faults);
    return false;
  }
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] == 0) continue;
    const FieldPath entry(path, "roles", i);
    if (!is_motion(byte_at(message.kinds(), i))) {
      add_fault(entry, "marks what is no motion of these columns", faults);
      return false;
    }
    const auto role = static_cast<v1::BlockRole>(byte_at(roles, i));
    if (!block_roles.from_proto(role, entry, faults)) return false;
  }
  return true;
}

bool check_lengths(const Columns& message, const FieldPath& path, FieldFaults& faults) {
  const std::size_t before = faults.count();
  const Presence presence(message);
  std::array<std::size_t, 256> blocks_with{};  // how many have just these bits
  for (std::size_t i = 0; i < message.kinds().size(); ++i)
    ++blocks_with[presence.of(i, byte_at(message.kinds(), i))];
  std::array<std::size_t, 8> expected{};
  for (std::size_t bits = 0; bits < blocks_with.size(); ++bits)
    for (std::size_t bit = 0; bit < expected.size(); ++bit)
      if (((bits >> bit) & 1U) != 0) expected[bit] += blocks_with[bits];
  const auto columns = columns_of(message);
  for (std::size_t bit = 0; bit < expected.size(); ++bit)
    if (columns[bit].size != expected[bit])
      add_fault(FieldPath(path, columns[bit].name),
                "has " + std::to_string(columns[bit].size) + " values, " +
                    std::to_string(expected[bit]) + " blocks have one",
                faults);
  return faults.count() == before;
}

// The entries of a sparse list have to stand where `kinds` says.
template <class List>
bool check_places(const List& list, unsigned kind, std::string_view name, const Columns& message,
                  const FieldPath& path, FieldFaults& faults) {
  int entry = 0;
  const std::string& kinds = message.kinds();
  const auto byte = static_cast<char>(kind);
  for (std::size_t i = kinds.find(byte); i != std::string::npos; i = kinds.find(byte, i + 1)) {
    if (entry == list.size()) {
      add_fault(FieldPath(path, name),
                "has " + std::to_string(list.size()) + " entries, kinds names more", faults);
      return false;
    }
    if (list.Get(entry).index() != i) {
      add_fault(
          FieldPath(FieldPath(path, name, static_cast<std::size_t>(entry)), "index"),
          "is " + std::to_string(list.Get(entry).index()) + ", kinds says " + std::to_string(i),
          faults);
      return false;
    }
    ++entry;
  }
  if (entry == list.size()) return true;
  add_fault(FieldPath(path, name),
            "has " + std::to_string(list.size()) + " entries, kinds names " + std::to_string(entry),
            faults);
  return false;
}

bool check_columns(const Columns& message, const FieldPath& path, FieldFaults& faults) {
  return check_kinds(message, path, faults) && check_lengths(message, path, faults) &&
         check_roles(message, path, faults) &&
         check_places(message.commands(), Columns::KIND_COMMAND, "commands", message, path,
                      faults) &&
         check_places(message.passthroughs(), Columns::KIND_PASSTHROUGH, "passthroughs", message,
                      path, faults) &&
         check_places(message.others(), Columns::KIND_OTHER, "others", message, path, faults);
}

// Walks along one column.
template <class Value>
class Cursor {
 public:
  Cursor(const google::protobuf::RepeatedField<Value>& values, std::string_view name)
      : values_(values), name_(name) {}
  Value next() { return values_.Get(next_++); }
  // Where the value given last stands.
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
    // The place is put together only where it is needed.
    if (!is_coordinate(value)) [[unlikely]]
      return check_coordinate(value, cursors[axis].place(path), faults);
    target[axis] = value;
  }
  return true;
}

constexpr unsigned center_shift = 3;  // PRESENT_BIT_I is PRESENT_BIT_X shifted by so many
static_assert(Columns::PRESENT_BIT_X << center_shift == Columns::PRESENT_BIT_I);

constexpr std::array<MotionKind, 5> motion_kinds{MotionKind::linear, MotionKind::linear,
                                                 MotionKind::rapid, MotionKind::clockwise,
                                                 MotionKind::counter_clockwise};

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

// The column lengths alone say it when every column is empty or full.
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

// Where the reading of a message stands in each of its lists.
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
  return from_proto(columns.commands(cursors.command++).command(), FieldPath(entry, "command"),
                    item, faults);
}

bool read_passthrough(const Columns& columns, ColumnCursors& cursors, const FieldPath& path,
                      Passthrough& item, FieldFaults& faults) {
  const FieldPath entry(path, "passthroughs", static_cast<std::size_t>(cursors.passthrough));
  item.text = columns.passthroughs(cursors.passthrough++).passthrough().text();
  return check_text(item.text, FieldPath(FieldPath(entry, "passthrough"), "text"), faults);
}

// `feed`: the one in force.
bool read_move(unsigned bits, ColumnCursors& cursors, const FieldPath& path, double& feed,
               MoveRequest& move, FieldFaults& faults) {
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
  if (!check_columns(columns, path, faults)) return false;
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
    // Field by field: a whole one would be copied while its fields are still being stored.
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
      if (!read_move(bits, cursors, path, feed_, move, faults)) return false;
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

void BlockWriter::write(std::span<const PathInput> items, bool final, v1::BlockColumns& columns) {
  columns.Clear();
  columns.set_first_block(next_block_);
  columns.set_final(final);
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
