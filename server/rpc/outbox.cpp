#include "server/rpc/outbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/pages.h"
#include "proto/wire/message_size.h"

namespace trc::server {
namespace {

// What a diagnostic may take in a message: its sentences are written out, in English and in the
// language that was asked for.
std::size_t message_bytes(const Diagnostic& diagnostic) {
  constexpr std::size_t sentences = 1200;
  constexpr std::size_t per_value = 120;
  return sentences + 3 * diagnostic.detail.size() + per_value * diagnostic.values.size();
}

// Memory that is worth giving back once it is empty: a client that does not read holds it.
constexpr std::size_t large = 64U << 10U;

template <class Buffer>
void empty_out(Buffer& buffer) {
  if (buffer.capacity() * sizeof(buffer[0]) > large)
    buffer = Buffer();
  else
    buffer.clear();
}

}  // namespace

void Outbox::keep_portion(std::vector<CompensatedBlock>& blocks) {
  portions_.emplace_back(
      content_.blocks_before,
      std::vector(std::make_move_iterator(blocks.begin()), std::make_move_iterator(blocks.end())));
  content_.blocks_before += blocks.size();
  blocks.clear();
}

void Outbox::forget_portions() {
  while (!portions_.empty() &&
         portions_.front().first_block + portions_.front().blocks.size() <= next_block_)
    portions_.pop_front();
}

Outbox::Portion::~Portion() {
  const std::size_t bytes = blocks.capacity() * sizeof(CompensatedBlock);
  void* const memory = blocks.data();
  blocks.clear();
  if (memory != nullptr) give_back_pages(memory, bytes);
}

void Outbox::forget_taken() {
  forget_portions();
  if (!empty()) return;
  content_.blocks_before = next_block_;
  next_byte_ = 0;
  empty_out(content_.blocks);
  empty_out(content_.text);
}

void Outbox::place(std::vector<Diagnostic> diagnostics) {
  diagnostics_waiting_ += diagnostics.size();
  std::size_t placed = 0;
  const auto place_through = [&](const ProgramOutput::Place& place) {
    if (place.diagnostics <= placed) return;
    const auto all = std::make_move_iterator(diagnostics.begin());
    placed_.push_back({.block = place.blocks,
                       .byte = place.bytes,
                       .diagnostics = {all + static_cast<std::ptrdiff_t>(placed),
                                       all + static_cast<std::ptrdiff_t>(place.diagnostics)}});
    placed = place.diagnostics;
  };
  for (const ProgramOutput::Place& place : content_.places) place_through(place);
  content_.places.clear();
  place_through({.blocks = content_.blocks_before + content_.blocks.size(),
                 .bytes = content_.text.size(),
                 .diagnostics = diagnostics.size()});
}

bool Outbox::empty() const {
  return placed_.empty() && blocks_waiting() == 0 && next_byte_ == content_.text.size();
}

std::span<const CompensatedBlock> Outbox::next_blocks() const {
  const bool in_content = portions_.empty();
  const std::vector<CompensatedBlock>& blocks =
      in_content ? content_.blocks : portions_.front().blocks;
  const std::uint64_t first = in_content ? content_.blocks_before : portions_.front().first_block;
  std::uint64_t end = first + blocks.size();
  if (!placed_.empty()) end = std::min(end, placed_.front().block);
  return std::span(blocks).subspan(next_block_ - first, end - next_block_);
}

Outbox::Slice Outbox::take(wire::Layout layout, std::size_t most_bytes) {
  forget_portions();
  const std::size_t end_byte = placed_.empty() ? content_.text.size() : placed_.front().byte;

  Slice slice{.first_block = next_block_, .blocks = next_blocks()};
  std::size_t bytes = 0;
  std::size_t count = 0;
  while (count < slice.blocks.size() && (count == 0 || bytes < most_bytes))
    bytes += wire::most_bytes(slice.blocks[count++], layout);
  slice.blocks = slice.blocks.first(count);
  next_block_ += count;

  // A line begun in this slice is finished in it.
  std::size_t stop = std::min(end_byte, next_byte_ + most_bytes - std::min(most_bytes, bytes));
  if (stop < end_byte && stop > next_byte_) {
    const std::size_t line_end = content_.text.find('\n', stop - 1);
    stop = line_end == std::string::npos ? end_byte : std::min(end_byte, line_end + 1);
  }
  slice.text = std::string_view(content_.text).substr(next_byte_, stop - next_byte_);
  next_byte_ = stop;

  bytes += slice.text.size();
  if (!placed_.empty() && next_block_ == placed_.front().block && next_byte_ == end_byte)
    take_diagnostics(bytes, most_bytes, slice);
  return slice;
}

void Outbox::take_diagnostics(std::size_t bytes, std::size_t most_bytes, Slice& slice) {
  std::vector<Diagnostic>& diagnostics = placed_.front().diagnostics;
  while (next_diagnostic_ < diagnostics.size() && (bytes == 0 || bytes < most_bytes)) {
    bytes += message_bytes(diagnostics[next_diagnostic_]);
    slice.diagnostics.push_back(std::move(diagnostics[next_diagnostic_++]));
    --diagnostics_waiting_;
  }
  if (next_diagnostic_ < diagnostics.size()) return;
  next_diagnostic_ = 0;
  placed_.pop_front();
}

std::size_t Outbox::held_bytes() const {
  // Not what is reserved: memory that was never written to is none.
  return blocks_waiting() * sizeof(CompensatedBlock) + content_.text.size() +
         diagnostics_waiting_ * sizeof(Diagnostic);
}

}  // namespace trc::server
