#include "server/rpc/outbox.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "core/base/pages.h"
#include "proto/wire/message_size.h"

namespace trc::server {
namespace {

// Upper bound for a diagnostic in a message: its sentences are written out in English and in the
// requested language.
std::size_t message_bytes(const Diagnostic& diagnostic) {
  constexpr std::size_t sentences = 1200;
  constexpr std::size_t per_value = 120;
  return sentences + 3 * diagnostic.detail.size() + per_value * diagnostic.values.size();
}

// A larger buffer is freed once it is empty: a client that does not read would keep it alive.
constexpr std::size_t large = 64U << 10U;

template <class Buffer>
void empty_out(Buffer& buffer) {
  if (buffer.capacity() * sizeof(buffer[0]) > large)
    buffer = Buffer();
  else
    buffer.clear();
}

// The memory pages of a portion go back to the system with it.
void empty_portion(std::vector<CompensatedBlock>& blocks) {
  const std::size_t bytes = blocks.capacity() * sizeof(CompensatedBlock);
  void* const memory = blocks.data();
  blocks.clear();
  if (memory != nullptr) give_back_pages(memory, bytes);
}

}  // namespace

void Outbox::forget_taken_parts() {
  std::deque<Answer>& parts = answers_.parts();
  while (parts.size() > 1 && is_taken(parts.front())) {
    empty_portion(parts.front().blocks);
    parts.pop_front();
    taken_ = {};
    parts_seen_ = parts.size();
  }
}

void Outbox::forget_taken() {
  forget_taken_parts();
  if (!empty()) return;
  Answer& last = answers_.parts().front();
  empty_out(last.blocks);
  empty_out(last.text);
  last.diagnostics.clear();
  taken_ = {};
}

bool Outbox::empty() const {
  const std::deque<Answer>& parts = answers_.parts();
  return is_taken(parts.front()) && std::all_of(parts.begin() + 1, parts.end(),
                                                [](const Answer& part) { return part.empty(); });
}

const Diagnostic* Outbox::error() const {
  for (const Answer& part : answers_.parts())
    for (const Diagnostic& told : part.diagnostics)
      if (told.severity == Severity::error) return &told;
  return nullptr;
}

Outbox::Slice Outbox::take(wire::Layout layout, std::size_t most_bytes) {
  forget_taken_parts();
  Answer& part = answers_.parts().front();

  Slice slice{.first_block = blocks_taken_,
              .blocks = std::span(part.blocks).subspan(taken_.blocks)};
  std::size_t bytes = 0;
  std::size_t count = 0;
  while (count < slice.blocks.size() && (count == 0 || bytes < most_bytes))
    bytes += wire::most_bytes(slice.blocks[count++], layout);
  slice.blocks = slice.blocks.first(count);
  taken_.blocks += count;
  blocks_taken_ += count;

  // Each line that begins in this slice also ends in it.
  const std::size_t end_byte = part.text.size();
  std::size_t stop = std::min(end_byte, taken_.bytes + most_bytes - std::min(most_bytes, bytes));
  if (stop < end_byte && stop > taken_.bytes) {
    const std::size_t line_end = part.text.find('\n', stop - 1);
    stop = line_end == std::string::npos ? end_byte : std::min(end_byte, line_end + 1);
  }
  slice.text = std::string_view(part.text).substr(taken_.bytes, stop - taken_.bytes);
  taken_.bytes = stop;

  bytes += slice.text.size();
  if (taken_.blocks == part.blocks.size() && taken_.bytes == end_byte)
    take_diagnostics(bytes, most_bytes, slice);
  return slice;
}

void Outbox::take_diagnostics(std::size_t bytes, std::size_t most_bytes, Slice& slice) {
  std::vector<Diagnostic>& diagnostics = answers_.parts().front().diagnostics;
  while (taken_.diagnostics < diagnostics.size() && (bytes == 0 || bytes < most_bytes)) {
    bytes += message_bytes(diagnostics[taken_.diagnostics]);
    slice.diagnostics.push_back(std::move(diagnostics[taken_.diagnostics++]));
  }
}

bool Outbox::holds(std::size_t bytes) const {
  std::size_t held = 0;
  // Reserved memory does not count: it was never written to.
  const auto add = [&](const Answer& part, const Taken& taken) {
    held += (part.blocks.size() - taken.blocks) * sizeof(CompensatedBlock) + part.text.size() -
            taken.bytes + (part.diagnostics.size() - taken.diagnostics) * sizeof(Diagnostic);
  };
  for (const Answer& part : answers_.parts()) {
    add(part, &part == &answers_.parts().front() ? taken_ : Taken{});
    if (held >= bytes) return true;
  }
  return false;
}

bool Outbox::has_grown() {
  return std::exchange(parts_seen_, answers_.parts().size()) < answers_.parts().size();
}

}  // namespace trc::server
