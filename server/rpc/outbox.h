#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/session/program_output.h"
#include "proto/wire/setup.h"

namespace trc::server {

// What a session has produced and the client has not got yet. A request can release any number of
// blocks at once (the end of a selection releases all of it), so they leave in slices that fit a
// message.
//
// Diagnostics keep their place among the blocks: behind those that were certain when they were
// raised. The place does not depend on how the input was batched: sessions give it.
class Outbox {
 public:
  struct Slice {
    std::uint64_t first_block = 0;  // index of the first block in the whole path
    std::span<const CompensatedBlock> blocks{};
    std::string_view text{};                // whole lines
    std::vector<Diagnostic> diagnostics{};  // raised behind the blocks and the text
  };

  // The core appends here.
  [[nodiscard]] ProgramOutput& content() { return content_; }
  // To be called while it appends (TakePortion): keeps `blocks`, which is left empty. One growing
  // vector would be moved again and again, and be far larger than what is in it.
  void keep_portion(std::vector<CompensatedBlock>& blocks);
  // To be called when the last slice is no longer needed: gives back the memory of what was taken.
  void forget_taken();
  // Puts diagnostics where the content says they belong, else behind everything there is now.
  void place(std::vector<Diagnostic> diagnostics);

  [[nodiscard]] bool empty() const;
  // How many blocks were taken so far, and that a resumed path goes on behind them.
  [[nodiscard]] std::uint64_t blocks_taken() const { return next_block_; }
  void go_on_behind(std::uint64_t blocks) { next_block_ = content_.blocks_before = blocks; }
  // The next slice of about `most_bytes` as a message of this layout, at least one block or line.
  // Valid until the content changes or the next one is taken.
  [[nodiscard]] Slice take(wire::Layout layout, std::size_t most_bytes);

  // About what it holds.
  [[nodiscard]] std::size_t held_bytes() const;
  [[nodiscard]] std::size_t blocks_waiting() const {
    return content_.blocks_before + content_.blocks.size() - next_block_;
  }

 private:
  struct Placed {
    std::uint64_t block = 0;  // in the whole path
    std::size_t byte = 0;
    std::vector<Diagnostic> diagnostics{};
  };

  // Those behind what has been taken, as many as fit beside so many bytes.
  void take_diagnostics(std::size_t bytes, std::size_t most_bytes, Slice& slice);

  // Blocks that lie together, and the index in the path of the first one. Its pages go back to the
  // system with it.
  struct Portion {
    Portion(std::uint64_t first, std::vector<CompensatedBlock>&& kept)
        : first_block(first), blocks(std::move(kept)) {}
    Portion(const Portion&) = delete;
    Portion& operator=(const Portion&) = delete;
    ~Portion();

    std::uint64_t first_block;
    std::vector<CompensatedBlock> blocks;
  };

  void forget_portions();
  // Blocks that lie together, from the next one on, up to where diagnostics belong.
  [[nodiscard]] std::span<const CompensatedBlock> next_blocks() const;

  std::deque<Portion> portions_;  // before the content
  ProgramOutput content_;
  std::deque<Placed> placed_;
  std::uint64_t next_block_ = 0;  // in the whole path
  std::size_t next_byte_ = 0;
  std::size_t next_diagnostic_ = 0;  // of the first placed ones
  std::size_t diagnostics_waiting_ = 0;
};

}  // namespace trc::server
