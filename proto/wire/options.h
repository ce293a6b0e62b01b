#pragma once

#include <optional>

#include "core/nc/state/trc_mode.h"
#include "proto/wire/field_fault.h"
#include "trc/v1/options.pb.h"

namespace trc::wire {

// What one `#TRC` command changes; an empty field leaves the option unchanged.
// ONLINE and ONLINE_BY_VECTOR have no field: they can only be off (D-15).
struct TrcOptionChanges {
  std::optional<bool> conv_cir_to_lin{};
  std::optional<bool> kerf_masking{};
  std::optional<bool> reverse{};
  std::optional<bool> ignore_cont_damage{};
  std::optional<bool> remove_masked_blocks{};
  std::optional<bool> ext_angle_block_intersection{};
  std::optional<bool> g236_lin{};
  std::optional<double> stretch_factor{};    // 1 … 9; beyond: warning 22007
  std::optional<double> tangential_limit{};  // degrees, 0.1 … 3
  std::optional<bool> perpendicular_radius_change{};
  std::optional<bool> gen_cir_block_in_corner{};
  std::optional<bool> suppress_trc{};
  std::optional<bool> inverse{};
  std::optional<SplitOption> split{};

  bool operator==(const TrcOptionChanges&) const = default;
};

// `options` with the changes made.
[[nodiscard]] TrcOptions changed(TrcOptions options, const TrcOptionChanges& changes);
// What leads from the initial options to `options`.
[[nodiscard]] TrcOptionChanges changes_from_initial(const TrcOptions& options);

[[nodiscard]] TrcOptionChanges from_proto(const v1::TrcOptions& message, const FieldPath& path,
                                          FieldFaults& faults);
void to_proto(const TrcOptionChanges& changes, v1::TrcOptions& message);

}  // namespace trc::wire
