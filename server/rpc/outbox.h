#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/session/answers.h"
#include "proto/wire/setup.h"

namespace trc::server {

// The answers of a session that the client has not received yet. A request can release any number
// of blocks at once (the end of a selection releases all of it), so they leave in slices that fit a
// message, in the order of the answer.
class Outbox {
 public:
  struct Slice {
    std::uint64_t first_block = 0;  // index of the first block in the whole path
    std::span<const CompensatedBlock> blocks{};
    std::string_view text{};                // whole lines
    std::vector<Diagnostic> diagnostics{};  // after the blocks and the text
  };

  // The session appends here.
  [[nodiscard]] Answers& content() { return answers_; }
  // To be called when the last slice is no longer needed: frees the memory of the content taken.
  void forget_taken();

  [[nodiscard]] bool empty() const;
  // The first error in it, or null.
  [[nodiscard]] const Diagnostic* error() const;
  // The number of blocks taken so far; a resumed path goes on after them.
  [[nodiscard]] std::uint64_t blocks_taken() const { return blocks_taken_; }
  void go_on_behind(std::uint64_t blocks) { blocks_taken_ = blocks; }
  // The next slice of about `most_bytes` as a message of this layout, at least one block or line.
  // Valid until the content changes or the next one is taken.
  [[nodiscard]] Slice take(wire::Layout layout, std::size_t most_bytes);

  // Takes all blocks at once, to leave by another way than slices: `give` may keep them.
  template <class Give>
  void take_blocks(Give give) {
    for (Answer& part : answers_.parts()) {
      blocks_taken_ += part.blocks.size();
      give(part.blocks);
      part.blocks.clear();
    }
    forget_taken_parts();
  }

  // Whether it holds about so many bytes. Takes no longer where it holds far more.
  [[nodiscard]] bool holds(std::size_t bytes) const;
  // Whether a part has ended since the last call: then a long selection is on its way out.
  [[nodiscard]] bool has_grown();

 private:
  // The amount taken of the first part.
  struct Taken {
    std::size_t blocks = 0;
    std::size_t bytes = 0;
    std::size_t diagnostics = 0;
  };

  [[nodiscard]] bool is_taken(const Answer& first) const {
    return taken_.blocks == first.blocks.size() && taken_.bytes == first.text.size() &&
           taken_.diagnostics == first.diagnostics.size();
  }
  void forget_taken_parts();
  // Takes as many as fit in addition to `bytes`.
  void take_diagnostics(std::size_t bytes, std::size_t most_bytes, Slice& slice);

  Answers answers_;
  Taken taken_;
  std::uint64_t blocks_taken_ = 0;  // of the whole path
  std::size_t parts_seen_ = 1;
};

}  // namespace trc::server
