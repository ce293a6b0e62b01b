#include "proto/wire/message_size.h"

#include <bit>

#include "proto/wire/compensated_block.h"

namespace trc::wire {
namespace {

// Bytes of a block besides its motion, including tags and lengths.
std::size_t extras(const CompensatedBlock& block) {
  constexpr std::size_t inverse = 150;
  constexpr std::size_t about_text = 20;
  return (block.text.empty() ? 0 : about_text + block.text.size()) + (block.inverse ? inverse : 0);
}

// Bytes of a number as a varint.
std::size_t number_bytes(std::uint64_t number) {
  return (static_cast<std::size_t>(std::bit_width(number | 1U)) + 6) / 7;
}

std::size_t source_bytes(const Source& source, std::size_t tag) {
  const std::size_t number = source.number == Source::no_number
                                 ? 0
                                 : tag + number_bytes(static_cast<std::uint64_t>(source.number));
  return number + tag + number_bytes(source.index) + tag + number_bytes(source.line);
}

std::size_t bytes_in_batch(const CompensatedBlock& block) {
  constexpr std::size_t frame = 5;
  constexpr std::size_t origin_plane_and_flags = 8;
  constexpr std::size_t frame_of_text = 3;
  constexpr std::size_t number = 1 + sizeof(double);
  constexpr std::size_t position = 2 + 3 * number;
  constexpr std::size_t frames_of_tracking = 10;
  std::size_t bytes = frame + source_bytes(block.source, 1) + origin_plane_and_flags + number +
                      frame_of_text + frame + 2 * position;
  if (is_arc(block.path)) bytes += position + number;
  if (!block.tracking.empty())
    bytes += frames_of_tracking + block.tracking.size() * 2 * sizeof(double);
  return bytes;
}

// Counts the starts: they are sent if any block does not start at the previous end.
std::size_t bytes_in_columns(const CompensatedBlock& block) {
  constexpr std::size_t kind_flags_origin_and_plane = 4;
  constexpr std::size_t position = 3 * sizeof(double);
  std::size_t bytes =
      kind_flags_origin_and_plane + source_bytes(block.source, 0) + sizeof(double) + 2 * position;
  if (is_arc(block.path)) bytes += position + sizeof(double);
  return bytes + block.tracking.size() * 2 * sizeof(double);
}

}  // namespace

std::size_t most_bytes(const CompensatedBlock& block, Layout layout) {
  return extras(block) +
         (layout == Layout::columns ? bytes_in_columns(block) : bytes_in_batch(block));
}

}  // namespace trc::wire
