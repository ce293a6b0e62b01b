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

// What a session has answered and the client has not got yet. A request can release any number of
// blocks at once (the end of a selection releases all of it), so they leave in slices that fit a
// message, in the order of the answer.
class Outbox {
 public:
  struct Slice {
    std::uint64_t first_block = 0;  // index of the first block in the whole path
    std::span<const CompensatedBlock> blocks{};
    std::string_view text{};                // whole lines
    std::vector<Diagnostic> diagnostics{};  // behind the blocks and the text
  };

  // The session appends here.
  [[nodiscard]] Answers& content() { return answers_; }
  // To be called when the last slice is no longer needed: gives back the memory of what was taken.
  void forget_taken();

  [[nodiscard]] bool empty() const;
  // The first error in it, or null.
  [[nodiscard]] const Diagnostic* error() const;
  // How many blocks were taken so far, and that a resumed path goes on behind them.
  [[nodiscard]] std::uint64_t blocks_taken() const { return blocks_taken_; }
  void go_on_behind(std::uint64_t blocks) { blocks_taken_ = blocks; }
  // The next slice of about `most_bytes` as a message of this layout, at least one block or line.
  // Valid until the content changes or the next one is taken.
  [[nodiscard]] Slice take(wire::Layout layout, std::size_t most_bytes);

  // Takes all blocks at once, which leave by another way than the slices: `give` may keep them.
  template <class Give>
  void take_blocks(Give give) {
    for (Answer& part : answers_.parts()) {
      blocks_taken_ += part.blocks.size();
      give(part.blocks);
      part.blocks.clear();
    }
    forget_taken_parts();
  }

  // Whether it holds so much, about. Takes no longer where it holds far more.
  [[nodiscard]] bool holds(std::size_t bytes) const;
  // Whether a part was ended since it was asked last: a selection that goes on for long comes out.
  [[nodiscard]] bool has_grown();

 private:
  // What was taken of the first part.
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
  // As many as fit beside so many bytes.
  void take_diagnostics(std::size_t bytes, std::size_t most_bytes, Slice& slice);

  Answers answers_;
  Taken taken_;
  std::uint64_t blocks_taken_ = 0;  // of the whole path
  std::size_t parts_seen_ = 1;
};

}  // namespace trc::server
