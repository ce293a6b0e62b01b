#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/trc/result/compensated_block.h"
#include "proto/wire/field_fault.h"
#include "trc/v1/compensated_block.pb.h"

namespace trc::wire {

[[nodiscard]] v1::CompensatedBlock::Origin to_proto(Origin origin);
// A value outside the enum, and none, is a fault.
[[nodiscard]] std::optional<Origin> from_proto(v1::CompensatedBlock::Origin origin,
                                               const FieldPath& path, FieldFaults& faults);
// Passthrough that moves nothing: it travels without a position.
[[nodiscard]] bool is_text_alone(const CompensatedBlock& block);

// The contour recovered from `block`, which has one.
void inverse_to_proto(const CompensatedBlock& block, v1::InverseSegment& message);
[[nodiscard]] Segment from_proto(const v1::InverseSegment& message, Plane plane);

// Replaces the content of the message.
void to_proto(const CompensatedBlock& block, v1::CompensatedBlock& message);
// `first_block`: index of the first one in the compensated path.
void to_proto(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
              v1::CompensatedBatch& message);
void to_proto(std::span<const CompensatedBlock> blocks, std::uint64_t first_block,
              v1::CompensatedColumns& message);

// Reads the compensated blocks of one stream. Text without motion carries no
// position; it gets the end of the block before it, the same as it had.
class CompensatedReader {
 public:
  explicit CompensatedReader(const Position& start) : position_(start) {}

  // The index the next batch has to begin with; another one is a fault.
  [[nodiscard]] std::uint64_t next_block() const { return next_block_; }

  // Appends to `out`. False when a fault was found.
  bool read(const v1::CompensatedBatch& batch, std::vector<CompensatedBlock>& out,
            FieldFaults& faults);
  bool read(const v1::CompensatedColumns& columns, std::vector<CompensatedBlock>& out,
            FieldFaults& faults);
  bool read(const v1::CompensatedBlock& block, const FieldPath& path, CompensatedBlock& out,
            FieldFaults& faults);

 private:
  bool expect(std::uint64_t first_block, const FieldPath& path, FieldFaults& faults);

  void place_text(CompensatedBlock& block) const;
  void follow(const CompensatedBlock& block);

  std::uint64_t next_block_ = 0;
  Position position_;
  TrackingTravel tracking_;
};

}  // namespace trc::wire
