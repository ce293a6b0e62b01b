#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "core/nc/state/program_state.h"
#include "proto/wire/field_fault.h"
#include "proto/wire/trc_command.h"
#include "trc/v1/block.pb.h"

namespace trc::wire {

// Text that comes out in its place, never interpreted.
struct Passthrough {
  Source source{};
  std::string text{};

  bool operator==(const Passthrough&) const = default;
};

// One item of the programmed path. A MoveRequest is absolute here: messages have
// no G91.
using PathInput = std::variant<MoveRequest, TrcCommand, Passthrough>;

[[nodiscard]] const Source& source_of(const PathInput& input);

// Gives one item to the state of the program. Returns whether the stream goes on.
bool apply(const PathInput& input, ProgramState& program);

// Reads the batches of one stream: numbers the blocks and keeps the feed in
// force. Items before a fault are given out, so that the result does not depend
// on how blocks are batched; a batch of columns that do not fit each other gives
// out nothing.
class BlockReader {
 public:
  // Returns whether to go on.
  using Sink = std::function<bool(const PathInput&)>;

  // `tracking_axes`: how many the setup names.
  explicit BlockReader(std::size_t tracking_axes) : tracking_axes_(tracking_axes) {}

  // The index the next batch has to begin with. `read` does not check it.
  [[nodiscard]] std::uint64_t next_block() const { return next_block_; }

  // False when a fault was found or the sink has stopped.
  bool read(const v1::BlockBatch& batch, const Sink& sink, FieldFaults& faults);
  bool read(const v1::BlockColumns& columns, const Sink& sink, FieldFaults& faults);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(next_block_, feed_);
  }

 private:
  bool read(const v1::Block& block, const FieldPath& path, const Sink& sink, FieldFaults& faults);
  MoveRequest& fresh_move();

  std::size_t tracking_axes_;
  std::uint64_t next_block_ = 0;
  double feed_ = 0;
  PathInput item_{};
};

// Writes the batches of one stream; the counterpart of BlockReader.
class BlockWriter {
 public:
  // Replaces the content of the message and numbers it as the next batch, which is not the final
  // one as long as nobody says so.
  void write(std::span<const PathInput> items, v1::BlockBatch& batch);
  void write(std::span<const PathInput> items, v1::BlockColumns& columns);

  [[nodiscard]] std::uint64_t next_block() const { return next_block_; }

 private:
  void write(const PathInput& item, v1::Block& block);

  std::uint64_t next_block_ = 0;
  double feed_ = 0;
};

}  // namespace trc::wire
