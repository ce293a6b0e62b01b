#include "proto/wire/compensated_batch_bytes.h"

#include <google/protobuf/io/coded_stream.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>

#include "proto/wire/compensated_block.h"
#include "proto/wire/geometry.h"

namespace trc::wire {
namespace {

using Message = v1::CompensatedBlock;
using google::protobuf::io::CodedOutputStream;

enum class WireType : std::uint8_t { varint = 0, fixed64 = 1, bytes = 2 };

constexpr std::size_t number_bytes = 1 + sizeof(double);  // with its tag
constexpr std::size_t position_bytes = 3 * number_bytes;
constexpr std::size_t field_of_position = 2 + position_bytes;  // with tag and length
constexpr std::size_t most_bytes_of_varint = 11;               // with its tag
// Upper bound for a plain block: number, index and line of its source, an arc, its feed, four small
// values, and the head of the entry.
constexpr std::size_t most_bytes_of_entry = 3 * most_bytes_of_varint + field_of_position + 2 +
                                            2 * field_of_position + 2 * number_bytes + 4 * 2 + 3;

// Writes fields one after another. Within a plain block each tag takes one byte, and so does the
// length of each field.
class Fields {
 public:
  explicit Fields(std::uint8_t* begin) : end_(begin) {}

  [[nodiscard]] std::uint8_t* end() const { return end_; }

  void tag(int field, WireType type) {
    *end_++ = static_cast<std::uint8_t>((field << 3) | static_cast<int>(type));
  }
  void varint(int field, std::uint64_t value) {
    tag(field, WireType::varint);
    end_ = CodedOutputStream::WriteVarint64ToArray(value, end_);
  }
  void number(int field, double value) {
    tag(field, WireType::fixed64);
    end_ = CodedOutputStream::WriteLittleEndian64ToArray(std::bit_cast<std::uint64_t>(value), end_);
  }
  void length(int field, std::size_t bytes) {
    tag(field, WireType::bytes);
    *end_++ = static_cast<std::uint8_t>(bytes);
  }
  void position(int field, const Position& position) {
    length(field, position_bytes);
    number(v1::Position::kXFieldNumber, position[0]);
    number(v1::Position::kYFieldNumber, position[1]);
    number(v1::Position::kZFieldNumber, position[2]);
  }

 private:
  std::uint8_t* end_;
};

// Whether the block has only its motion and its source.
bool is_plain(const CompensatedBlock& block) {
  return block.origin != Origin::passthrough && block.text.empty() && block.tracking.empty() &&
         !block.inverse;
}

void write_path(const CompensatedBlock& block, Fields& fields) {
  const auto position = [&](const Point& point, double third) {
    return from_plane(block.plane, point, third);
  };
  const auto* arc = std::get_if<Arc>(&block.path);
  if (arc == nullptr) fields.varint(Message::kRapidFieldNumber, block.rapid ? 1 : 0);
  fields.position(Message::kStartFieldNumber, position(start_of(block.path), block.normal.from));
  const Position end = position(end_of(block.path), block.normal.to);
  if (arc == nullptr) {
    fields.length(Message::kLineFieldNumber, field_of_position);
    fields.position(v1::Line::kEndFieldNumber, end);
    return;
  }
  const bool turns = std::bit_cast<std::uint64_t>(arc->sweep) != 0;
  fields.length(Message::kArcFieldNumber, 2 * field_of_position + (turns ? number_bytes : 0));
  fields.position(v1::Arc::kEndFieldNumber, end);
  fields.position(v1::Arc::kCenterFieldNumber, position(arc->center, block.normal.from));
  if (turns) fields.number(v1::Arc::kSweepFieldNumber, arc->sweep);
}

// Writes the fields of a plain block in order.
void write_plain(const CompensatedBlock& block, Fields& fields) {
  const Source& source = block.source;
  if (source.number != Source::no_number)
    fields.varint(Message::kSourceNumberFieldNumber, static_cast<std::uint64_t>(source.number));
  if (source.index <= std::numeric_limits<std::uint32_t>::max())
    fields.varint(Message::kSourceIndexFieldNumber, source.index);
  fields.varint(Message::kOriginFieldNumber, static_cast<std::uint64_t>(to_proto(block.origin)));
  write_path(block, fields);
  if (block.feed != 0) fields.number(Message::kFeedFieldNumber, block.feed);
  if (block.tangential) fields.varint(Message::kTangentialFieldNumber, 1);
  if (block.plane != Plane::xy)
    fields.varint(Message::kPlaneFieldNumber, static_cast<std::uint64_t>(to_proto(block.plane)));
  if (source.line != 0) fields.varint(Message::kSourceLineFieldNumber, source.line);
}

constexpr int blocks_field = v1::CompensatedBatch::kBlocksFieldNumber;

// Writes a plain block as a field of its batch into most_bytes_of_entry of memory; returns its
// bytes.
std::size_t write_entry(const CompensatedBlock& block, char* memory) {
  auto* const begin = reinterpret_cast<std::uint8_t*>(memory);
  Fields entry(begin);
  entry.tag(blocks_field, WireType::bytes);
  // The length nearly always takes one byte. It is known only after the fields.
  std::uint8_t* const length = entry.end();
  Fields fields(length + 1);
  write_plain(block, fields);
  const auto bytes = static_cast<std::size_t>(fields.end() - (length + 1));
  if (bytes > 127) std::memmove(length + 2, length + 1, bytes);
  const std::uint8_t* const behind_length =
      CodedOutputStream::WriteVarint32ToArray(static_cast<std::uint32_t>(bytes), length);
  return static_cast<std::size_t>(behind_length - begin) + bytes;
}

void append_any(const CompensatedBlock& block, std::string& bytes) {
  v1::CompensatedBatch batch;
  to_proto(block, *batch.add_blocks());
  batch.AppendToString(&bytes);
}

}  // namespace

void append_batch(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
                  std::string& bytes) {
  v1::CompensatedBatch head;
  head.set_first_block(first_block);
  head.AppendToString(&bytes);
  bytes.reserve(bytes.size() + blocks.size() * most_bytes_of_entry);
  std::array<char, most_bytes_of_entry> entry;
  for (const CompensatedBlock& block : blocks) {
    if (is_plain(block))
      bytes.append(entry.data(), write_entry(block, entry.data()));
    else
      append_any(block, bytes);
  }
}

}  // namespace trc::wire
