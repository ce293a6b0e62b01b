#include "proto/wire/block_columns_checks.h"

#include "proto/wire/block_columns_layout.h"
#include "proto/wire/modes.h"

namespace trc::wire::block_columns {
namespace {

bool check_kinds(const Columns& message, const FieldReader& reader) {
  const std::string& kinds = message.kinds();
  const std::string& present = message.present();
  const std::size_t before = reader.faults.count();
  if (!present.empty() && present.size() != kinds.size())
    add_fault(FieldPath(reader.path, "present"),
              "has " + std::to_string(present.size()) + " bytes, kinds has " +
                  std::to_string(kinds.size()),
              reader.faults);
  for (std::size_t i = 0; i < kinds.size() && reader.faults.count() == before; ++i) {
    const unsigned kind = byte_at(kinds, i);
    if (kind == Columns::KIND_UNSPECIFIED || kind > Columns::KIND_OTHER)
      add_fault(FieldPath(reader.path, "kinds", i),
                "is " + std::to_string(kind) + ", which Kind has not", reader.faults);
    else if (!present.empty() && (byte_at(present, i) & ~allowed_bits(kind)) != 0)
      add_fault(FieldPath(reader.path, "present", i),
                "has a bit that a block of kind " + std::to_string(kind) + " cannot have",
                reader.faults);
  }
  return reader.faults.count() == before;
}

bool check_roles(const Columns& message, const FieldReader& reader) {
  const std::string& roles = message.roles();
  if (roles.empty()) return true;
  const FieldPath place(reader.path, "roles");
  if (roles.size() != message.kinds().size()) {
    add_fault(place,
              "has " + std::to_string(roles.size()) + " bytes, kinds has " +
                  std::to_string(message.kinds().size()),
              reader.faults);
    return false;
  }
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] == 0) continue;
    const FieldPath entry(reader.path, "roles", i);
    if (!is_motion(byte_at(message.kinds(), i))) {
      add_fault(entry, "marks what is no motion of these columns", reader.faults);
      return false;
    }
    const auto role = static_cast<v1::BlockRole>(byte_at(roles, i));
    if (!block_roles.from_proto(role, entry, reader.faults)) return false;
  }
  return true;
}

bool check_lengths(const Columns& message, const FieldReader& reader) {
  const std::size_t before = reader.faults.count();
  const Presence presence(message);
  std::array<std::size_t, 256> blocks_with{};  // how many have exactly these bits
  for (std::size_t i = 0; i < message.kinds().size(); ++i)
    ++blocks_with[presence.of(i, byte_at(message.kinds(), i))];
  std::array<std::size_t, 8> expected{};
  for (std::size_t bits = 0; bits < blocks_with.size(); ++bits)
    for (std::size_t bit = 0; bit < expected.size(); ++bit)
      if (((bits >> bit) & 1U) != 0) expected[bit] += blocks_with[bits];
  const auto columns = columns_of(message);
  for (std::size_t bit = 0; bit < expected.size(); ++bit)
    if (columns[bit].size != expected[bit])
      add_fault(FieldPath(reader.path, columns[bit].name),
                "has " + std::to_string(columns[bit].size) + " values, " +
                    std::to_string(expected[bit]) + " blocks have one",
                reader.faults);
  return reader.faults.count() == before;
}

// The entries of a sparse list must be at the places that `kinds` names.
template <class List>
bool check_places(const List& list, unsigned kind, std::string_view name, const Columns& message,
                  const FieldReader& reader) {
  int entry = 0;
  const std::string& kinds = message.kinds();
  const auto byte = static_cast<char>(kind);
  for (std::size_t i = kinds.find(byte); i != std::string::npos; i = kinds.find(byte, i + 1)) {
    if (entry == list.size()) {
      add_fault(FieldPath(reader.path, name),
                "has " + std::to_string(list.size()) + " entries, kinds names more", reader.faults);
      return false;
    }
    if (list.Get(entry).index() != i) {
      add_fault(
          FieldPath(FieldPath(reader.path, name, static_cast<std::size_t>(entry)), "index"),
          "is " + std::to_string(list.Get(entry).index()) + ", kinds says " + std::to_string(i),
          reader.faults);
      return false;
    }
    ++entry;
  }
  if (entry == list.size()) return true;
  add_fault(FieldPath(reader.path, name),
            "has " + std::to_string(list.size()) + " entries, kinds names " + std::to_string(entry),
            reader.faults);
  return false;
}

}  // namespace

bool check(const Columns& message, const FieldReader& reader) {
  return check_kinds(message, reader) && check_lengths(message, reader) &&
         check_roles(message, reader) &&
         check_places(message.commands(), Columns::KIND_COMMAND, "commands", message, reader) &&
         check_places(message.passthroughs(), Columns::KIND_PASSTHROUGH, "passthroughs", message,
                      reader) &&
         check_places(message.others(), Columns::KIND_OTHER, "others", message, reader);
}

}  // namespace trc::wire::block_columns
