#pragma once

#include <optional>

#include "core/nc/state/program_state.h"
#include "proto/wire/field_fault.h"
#include "proto/wire/options.h"
#include "trc/v1/block.pb.h"

namespace trc::wire {

// Settings that change between two blocks; an empty field stays as it is.
struct TrcCommand {
  Source source{};
  std::optional<Side> side{};  // off: G40
  bool tangential = false;     // G05
  std::optional<Selection> selection{};
  std::optional<Transition> transition{};
  std::optional<Masking> masking{};
  std::optional<FeedAdaptation> feed_adaptation{};
  std::optional<double> tangfeed_minimum{};  // mm
  std::optional<double> tool_radius{};       // mm; negative swaps the side
  std::optional<double> wear{};              // mm
  std::optional<double> allowance{};         // mm
  std::optional<TrcOptionChanges> options{};
  std::optional<Plane> plane{};
  std::optional<bool> absolute_center{};  // G161 / G162
  std::optional<bool> correct_center{};   // G165 / G164

  bool operator==(const TrcCommand&) const = default;
};

// Makes the changes, the side last: a selection sees the settings beside it.
// Returns whether the stream goes on.
bool apply(const TrcCommand& command, ProgramState& program);

// Everything but the source, which the place in the batch gives.
bool from_proto(const v1::TrcCommand& message, const FieldPath& path, TrcCommand& command,
                FieldFaults& faults);
void to_proto(const TrcCommand& command, v1::TrcCommand& message);

}  // namespace trc::wire
