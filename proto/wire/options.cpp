#include "proto/wire/options.h"

#include <array>
#include <cmath>

#include "core/base/tolerances.h"
#include "proto/wire/enums.h"

namespace trc::wire {
namespace {

// An option that is on or off.
struct Switch {
  bool TrcOptions::*option;
  std::optional<bool> TrcOptionChanges::*change;
  bool (v1::TrcOptions::*has)() const;
  bool (v1::TrcOptions::*get)() const;
  void (v1::TrcOptions::*set)(bool);
};

using Message = v1::TrcOptions;

constexpr std::array<Switch, 11> switches{{
    {&TrcOptions::conv_cir_to_lin, &TrcOptionChanges::conv_cir_to_lin,
     &Message::has_conv_cir_to_lin, &Message::conv_cir_to_lin, &Message::set_conv_cir_to_lin},
    {&TrcOptions::kerf_masking, &TrcOptionChanges::kerf_masking, &Message::has_kerf_masking,
     &Message::kerf_masking, &Message::set_kerf_masking},
    {&TrcOptions::reverse, &TrcOptionChanges::reverse, &Message::has_reverse, &Message::reverse,
     &Message::set_reverse},
    {&TrcOptions::ignore_cont_damage, &TrcOptionChanges::ignore_cont_damage,
     &Message::has_ignore_cont_damage, &Message::ignore_cont_damage,
     &Message::set_ignore_cont_damage},
    {&TrcOptions::remove_masked_blocks, &TrcOptionChanges::remove_masked_blocks,
     &Message::has_remove_masked_blocks, &Message::remove_masked_blocks,
     &Message::set_remove_masked_blocks},
    {&TrcOptions::ext_angle_block_intersection, &TrcOptionChanges::ext_angle_block_intersection,
     &Message::has_ext_angle_block_intersection, &Message::ext_angle_block_intersection,
     &Message::set_ext_angle_block_intersection},
    {&TrcOptions::g236_lin, &TrcOptionChanges::g236_lin, &Message::has_g236_lin, &Message::g236_lin,
     &Message::set_g236_lin},
    {&TrcOptions::perpendicular_radius_change, &TrcOptionChanges::perpendicular_radius_change,
     &Message::has_perpendicular_radius_change, &Message::perpendicular_radius_change,
     &Message::set_perpendicular_radius_change},
    {&TrcOptions::gen_cir_block_in_corner, &TrcOptionChanges::gen_cir_block_in_corner,
     &Message::has_gen_cir_block_in_corner, &Message::gen_cir_block_in_corner,
     &Message::set_gen_cir_block_in_corner},
    {&TrcOptions::suppress_trc, &TrcOptionChanges::suppress_trc, &Message::has_suppress_trc,
     &Message::suppress_trc, &Message::set_suppress_trc},
    {&TrcOptions::inverse, &TrcOptionChanges::inverse, &Message::has_inverse, &Message::inverse,
     &Message::set_inverse},
}};

using Split = v1::SplitOption;

constexpr EnumTable<Split::Place, SplitOption::Where, 3> places{{
    {Split::PLACE_PRE, SplitOption::Where::pre},
    {Split::PLACE_POST, SplitOption::Where::post},
    {Split::PLACE_COMBINED, SplitOption::Where::combined},
}};

constexpr double largest_feed = 1e9;  // mm/min

SplitOption from_proto(const Split& message, const FieldPath& path, FieldFaults& faults) {
  const FieldPath measure(path, "measure");
  switch (message.measure()) {
    case Split::MEASURE_OFF:
      return {};
    case Split::MEASURE_AXIS:
    case Split::MEASURE_PATH:
      break;
    case Split::MEASURE_UNSPECIFIED:
      add_fault(measure, "is missing", faults);
      return {};
    default:
      add_fault(measure, "is " + std::to_string(message.measure()) + ", which the enum has not",
                faults);
      return {};
  }
  constexpr double largest = Tolerances{}.largest_coordinate;
  SplitOption split;
  split.where = places.from_proto(message.place(), FieldPath(path, "place"), faults)
                    .value_or(SplitOption::Where::pre);
  split.along_path = message.measure() == Split::MEASURE_PATH;
  if (!split.along_path && check_range(message.axis(), {1, 3}, FieldPath(path, "axis"), faults))
    split.axis = static_cast<std::uint8_t>(message.axis() - 1);
  check_above(message.dist_seg1(), {0, largest, "mm"}, FieldPath(path, "dist_seg1"), faults);
  check_above(message.feed_seg1(), {0, largest_feed, "mm/min"}, FieldPath(path, "feed_seg1"),
              faults);
  check_range(message.dist_seg2(), {0, largest, "mm"}, FieldPath(path, "dist_seg2"), faults);
  const FieldPath feed_2(path, "feed_seg2");
  if (message.dist_seg2() > 0)
    check_above(message.feed_seg2(), {0, largest_feed, "mm/min"}, feed_2, faults);
  else
    check_range(message.feed_seg2(), {0, largest_feed, "mm/min"}, feed_2, faults);
  split.distance_1 = message.dist_seg1();
  split.feed_1 = message.feed_seg1();
  split.distance_2 = message.dist_seg2();
  split.feed_2 = message.feed_seg2();
  return split;
}

void to_proto(const SplitOption& split, Split& message) {
  message.Clear();
  if (split.where == SplitOption::Where::off) {
    message.set_measure(Split::MEASURE_OFF);
    return;
  }
  message.set_measure(split.along_path ? Split::MEASURE_PATH : Split::MEASURE_AXIS);
  message.set_place(places.to_proto(split.where));
  if (!split.along_path) message.set_axis(split.axis + 1U);
  message.set_dist_seg1(split.distance_1);
  message.set_feed_seg1(split.feed_1);
  message.set_dist_seg2(split.distance_2);
  message.set_feed_seg2(split.feed_2);
}

}  // namespace

TrcOptions changed(TrcOptions options, const TrcOptionChanges& changes) {
  for (const Switch& row : switches)
    options.*row.option = (changes.*row.change).value_or(options.*row.option);
  options.stretch_factor = changes.stretch_factor.value_or(options.stretch_factor);
  options.tangential_limit = changes.tangential_limit.value_or(options.tangential_limit);
  options.split = changes.split.value_or(options.split);
  return options;
}

TrcOptionChanges changes_from_initial(const TrcOptions& options) {
  const TrcOptions initial;
  TrcOptionChanges changes;
  for (const Switch& row : switches)
    if (options.*row.option != initial.*row.option) changes.*row.change = options.*row.option;
  if (options.stretch_factor != initial.stretch_factor)
    changes.stretch_factor = options.stretch_factor;
  if (options.tangential_limit != initial.tangential_limit)
    changes.tangential_limit = options.tangential_limit;
  if (options.split != initial.split) changes.split = options.split;
  return changes;
}

TrcOptionChanges from_proto(const v1::TrcOptions& message, const FieldPath& path,
                            FieldFaults& faults) {
  TrcOptionChanges changes;
  for (const Switch& row : switches)
    if ((message.*row.has)()) changes.*row.change = (message.*row.get)();
  if (message.has_stretch_factor()) {
    // The core answers a finite value outside 1 … 9 with warning 22007.
    if (!std::isfinite(message.stretch_factor()))
      add_range_fault(message.stretch_factor(), {1, 9}, FieldPath(path, "stretch_factor"), faults);
    changes.stretch_factor = message.stretch_factor();
  }
  if (message.has_tangential_limit()) {
    check_range(message.tangential_limit(), {0.1, 3, "degrees"},
                FieldPath(path, "tangential_limit"), faults);
    changes.tangential_limit = message.tangential_limit();
  }
  if (message.has_split())
    changes.split = from_proto(message.split(), FieldPath(path, "split"), faults);
  if (message.online() != 0)
    add_fault(FieldPath(path, "online"), "is not available, only 0 is allowed", faults);
  if (message.online_by_vector())
    add_fault(FieldPath(path, "online_by_vector"), "is not available, only false is allowed",
              faults);
  return changes;
}

void to_proto(const TrcOptionChanges& changes, v1::TrcOptions& message) {
  message.Clear();
  for (const Switch& row : switches)
    if (changes.*row.change) (message.*row.set)(*(changes.*row.change));
  if (changes.stretch_factor) message.set_stretch_factor(*changes.stretch_factor);
  if (changes.tangential_limit) message.set_tangential_limit(*changes.tangential_limit);
  if (changes.split) to_proto(*changes.split, *message.mutable_split());
}

}  // namespace trc::wire
