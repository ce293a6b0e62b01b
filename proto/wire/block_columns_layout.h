#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "trc/v1/block.pb.h"

// How v1::BlockColumns hold their blocks.
namespace trc::wire::block_columns {

using Columns = v1::BlockColumns;

inline constexpr unsigned end_bits =
    Columns::PRESENT_BIT_X | Columns::PRESENT_BIT_Y | Columns::PRESENT_BIT_Z;
inline constexpr unsigned center_bits =
    Columns::PRESENT_BIT_I | Columns::PRESENT_BIT_J | Columns::PRESENT_BIT_K;
inline constexpr unsigned feed_bit = Columns::PRESENT_BIT_FEED;
inline constexpr unsigned number_bit = Columns::PRESENT_BIT_SOURCE_NUMBER;

inline constexpr unsigned center_shift = 3;  // PRESENT_BIT_I is PRESENT_BIT_X shifted by so many
static_assert(Columns::PRESENT_BIT_X << center_shift == Columns::PRESENT_BIT_I);

inline bool is_motion(unsigned kind) {
  return kind >= Columns::KIND_LINEAR && kind <= Columns::KIND_COUNTER_CLOCKWISE;
}
inline bool is_arc(unsigned kind) {
  return kind == Columns::KIND_CLOCKWISE || kind == Columns::KIND_COUNTER_CLOCKWISE;
}

// The bits a block of this kind may have.
inline unsigned allowed_bits(unsigned kind) {
  if (kind == Columns::KIND_OTHER) return 0;
  if (is_arc(kind)) return end_bits | center_bits | feed_bit | number_bit;
  return is_motion(kind) ? end_bits | feed_bit | number_bit : number_bit;
}

struct Column {
  std::string_view name;
  unsigned bit;
  std::size_t size;
};

inline std::array<Column, 8> columns_of(const Columns& message) {
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

inline unsigned byte_at(const std::string& bytes, std::size_t index) {
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

}  // namespace trc::wire::block_columns
