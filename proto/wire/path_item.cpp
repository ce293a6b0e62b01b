#include "proto/wire/path_item.h"

#include "proto/wire/compensated_block.h"
#include "proto/wire/geometry.h"

namespace trc::wire {
namespace {

// The common fields of the two messages that report a clearance.
template <class Message>
void tell_where(const verify::ClearanceReport& report, Message& message) {
  const verify::Clearance& worst = *report.worst;
  message.set_tool_radius(worst.required);
  to_proto(worst.place, *message.mutable_point());
  if (worst.path.number != Source::no_number)
    message.set_source_number(static_cast<std::uint64_t>(worst.path.number));
  message.set_source_index(worst.path.index);
  message.set_blocks_checked(report.checked);
  message.set_blocks_gouging(report.gouging);
}

void tell(const verify::ClearanceReport& report, v1::Clearance& message) {
  tell_where(report, message);
  const Source& contour = report.worst->contour;
  message.set_distance(report.worst->distance);
  if (contour.number != Source::no_number)
    message.set_contour_number(static_cast<std::uint64_t>(contour.number));
  message.set_contour_index(contour.index);
}

Source source_of(std::uint64_t index, bool has_number, std::uint64_t number) {
  return {.index = index,
          .number = has_number ? static_cast<std::int64_t>(number) : Source::no_number};
}

verify::ClearanceReport from_proto(const v1::Certificate& message) {
  const v1::Position& point = message.point();
  return {
      .worst =
          verify::Clearance{.distance = message.clearance(),
                            .required = message.tool_radius(),
                            .place = {point.x(), point.y(), point.z()},
                            .path = source_of(message.source_index(), message.has_source_number(),
                                              message.source_number()),
                            .contour = source_of(message.wall_index(), message.has_wall_number(),
                                                 message.wall_number())},
      .checked = message.blocks_checked(),
      .walls = message.walls(),
      .gouging = message.blocks_gouging()};
}

}  // namespace

void to_proto(const verify::ClearanceReport& report, v1::Certificate& message) {
  tell_where(report, message);
  const Source& wall = report.worst->contour;
  message.set_clearance(report.worst->distance);
  if (wall.number != Source::no_number)
    message.set_wall_number(static_cast<std::uint64_t>(wall.number));
  message.set_wall_index(wall.index);
  message.set_walls(report.walls);
  message.set_method_version(verify::method_version);
}

void to_proto(const PathSummary& summary, v1::PathSummary& message) {
  message.Clear();
  const Summary& core = summary.summary;
  message.set_blocks_in(core.blocks_in);
  message.set_blocks_out(core.blocks_out);
  message.set_masked_blocks(core.blocks_by_origin[static_cast<std::size_t>(Origin::masked)]);
  message.set_programmed_length(core.programmed_length);
  message.set_compensated_length(core.compensated_length);
  if (summary.clearance.wall_length > 0) message.set_coverage(summary.clearance.coverage());
  if (summary.clearance.worst) {
    tell(summary.clearance, *message.mutable_min_clearance());
    to_proto(summary.clearance, *message.mutable_certificate());
  }
  for (std::size_t origin = 0; origin < core.blocks_by_origin.size(); ++origin) {
    if (core.blocks_by_origin[origin] == 0) continue;
    v1::OriginCount& entry = *message.add_blocks_by_origin();
    entry.set_origin(to_proto(static_cast<Origin>(origin)));
    entry.set_count(core.blocks_by_origin[origin]);
  }
  message.set_effective_radius(summary.effective_radius);
  message.set_wear(summary.wear);
  message.set_allowance(summary.allowance);
  message.set_nominal_radius(summary.nominal_radius);
  message.set_notes(summary.notes);
  message.set_warnings(summary.warnings);
  message.set_wall_time_seconds(summary.wall_time_seconds);
  message.set_cpu_time_seconds(summary.cpu_time_seconds);
}

void to_proto(const ProgramSummary& summary, v1::ProgramSummary& message) {
  to_proto(summary.path, *message.mutable_path());
  message.set_lines_in(summary.lines_in);
  message.set_bytes_in(summary.bytes_in);
  message.set_bytes_out(summary.bytes_out);
}

PathSummary from_proto(const v1::PathSummary& message) {
  PathSummary summary{.effective_radius = message.effective_radius(),
                      .wear = message.wear(),
                      .allowance = message.allowance(),
                      .nominal_radius = message.nominal_radius(),
                      .notes = message.notes(),
                      .warnings = message.warnings(),
                      .wall_time_seconds = message.wall_time_seconds(),
                      .cpu_time_seconds = message.cpu_time_seconds()};
  Summary& core = summary.summary;
  core.blocks_in = message.blocks_in();
  core.blocks_out = message.blocks_out();
  core.programmed_length = message.programmed_length();
  core.compensated_length = message.compensated_length();
  if (message.has_certificate()) summary.clearance = from_proto(message.certificate());
  // The message does not hold the lengths themselves.
  if (message.has_coverage()) {
    summary.clearance.wall_length = 1;
    summary.clearance.touched_length = message.coverage();
  }
  for (const v1::OriginCount& entry : message.blocks_by_origin()) {
    // A newer server may know more origins; its total includes them.
    FieldFaults ignored;
    const auto origin = from_proto(entry.origin(), FieldPath("origin"), ignored);
    if (origin) core.blocks_by_origin[static_cast<std::size_t>(*origin)] = entry.count();
  }
  return summary;
}

ProgramSummary from_proto(const v1::ProgramSummary& message) {
  return {.path = from_proto(message.path()),
          .lines_in = message.lines_in(),
          .bytes_in = message.bytes_in(),
          .bytes_out = message.bytes_out()};
}

}  // namespace trc::wire
