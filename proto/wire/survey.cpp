#include "proto/wire/survey.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "core/geometry/plane.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/geometry.h"
#include "proto/wire/path_item.h"

namespace trc::wire {
namespace {

// A tenth of a micrometre is the smallest length (rule 1.6).
constexpr double smallest_radius = 1e-4;
constexpr double largest_radius = 0.5 * ToolInForce::largest_tool_radius;
// The most stretches that a message names.
constexpr std::size_t most_stretches = 2000;

void add_radius(double radius, const FieldPath& path, std::vector<double>& radii,
                FieldFaults& faults) {
  if (!check_range(radius, {smallest_radius, largest_radius, "mm"}, path, faults)) return;
  if (std::find(radii.begin(), radii.end(), radius) != radii.end())
    return add_fault(path, "stands there a second time", faults);
  radii.push_back(radius);
}

void add_range(const v1::RadiusRange& range, const FieldPath& path, std::vector<double>& radii,
               FieldFaults& faults) {
  const bool fits = check_range(range.from(), {smallest_radius, largest_radius, "mm"},
                                FieldPath(path, "from"), faults) &&
                    check_range(range.to(), {range.from(), largest_radius, "mm"},
                                FieldPath(path, "to"), faults) &&
                    check_range(range.step(), {smallest_radius, largest_radius, "mm"},
                                FieldPath(path, "step"), faults);
  if (!fits) return;
  constexpr double rounding = 1e-9;
  const double count = std::floor((range.to() - range.from()) / range.step() + rounding) + 1;
  if (count > static_cast<double>(survey::most_radii))
    return add_fault(path, "are more than " + std::to_string(survey::most_radii) + " radii",
                     faults);
  // Rounded, so that steps of a tenth do not add up to 0.30000000000000004.
  constexpr double per_mm = 1e6;
  for (int i = 0; i < static_cast<int>(count); ++i)
    add_radius(std::round((range.from() + i * range.step()) * per_mm) / per_mm, path, radii,
               faults);
}

void tell(const Source& source, v1::SurveyPlace& place) {
  if (source.number != Source::no_number)
    place.set_source_number(static_cast<std::uint64_t>(source.number));
  place.set_source_index(source.index);
  place.set_line(source.line);
}

void tell(const verify::UncutWall& wall, v1::UncutWall& message) {
  const auto set = [&](const Point& point, v1::Position& position) {
    to_proto(from_plane(wall.plane, point, 0), position);
  };
  tell(wall.source, *message.mutable_place());
  std::visit(
      [&](const auto& shape) {
        set(shape.start, *message.mutable_start());
        set(shape.end, *message.mutable_end());
      },
      wall.path);
  const auto* arc = std::get_if<Arc>(&wall.path);
  if (arc == nullptr) return;
  set(arc->center, *message.mutable_center());
  message.set_sweep(arc->sweep);
}

std::optional<double> number_from(std::string_view text) {
  double number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

}  // namespace

SurveySettings from_proto(const v1::SurveySetup& message, const FieldPath& path,
                          FieldFaults& faults) {
  SurveySettings settings{.is_path = message.has_path(),
                          .wants_largest = !message.without_largest(),
                          .wants_uncut = message.want_uncut()};
  if (message.has_path())
    settings.program.path = from_proto(message.path(), FieldPath(path, "path"), faults);
  else if (message.has_program())
    settings.program = from_proto(message.program(), FieldPath(path, "program"), faults);
  else
    add_fault(FieldPath(path, "input"), "is missing: program or path", faults);
  const FieldPath radii(path, "radii");
  if (static_cast<std::size_t>(message.radii_size()) > survey::most_radii) {
    add_fault(radii,
              "has " + std::to_string(message.radii_size()) + " entries, allowed are " +
                  std::to_string(survey::most_radii),
              faults);
    return settings;
  }
  for (int i = 0; i < message.radii_size(); ++i)
    add_radius(message.radii(i), FieldPath(path, "radii", static_cast<std::size_t>(i)),
               settings.radii, faults);
  if (message.has_range())
    add_range(message.range(), FieldPath(path, "range"), settings.radii, faults);
  if (settings.radii.size() > survey::most_radii)
    add_fault(radii, "are more than " + std::to_string(survey::most_radii) + " with the range",
              faults);
  if (settings.radii.empty() && !settings.wants_largest && faults.empty())
    add_fault(radii, "is empty, and the largest one is not asked for", faults);
  return settings;
}

std::string read_radii(std::string_view text, v1::SurveySetup& setup) {
  const char separator = text.find(':') == std::string_view::npos ? ',' : ':';
  std::vector<double> numbers;
  for (std::string_view left = text;;) {
    const auto end = left.find(separator);
    const auto number = number_from(left.substr(0, end));
    if (!number)
      return "\"" + std::string(text) + "\" is not possible; it takes 3,5,8 or 3:8:0.5, mm";
    numbers.push_back(*number);
    if (end == std::string_view::npos) break;
    left.remove_prefix(end + 1);
  }
  if (separator == ',') {
    for (const double number : numbers) setup.add_radii(number);
    return {};
  }
  if (numbers.size() != 3) return "\"" + std::string(text) + "\" is no from:to:step";
  setup.mutable_range()->set_from(numbers[0]);
  setup.mutable_range()->set_to(numbers[1]);
  setup.mutable_range()->set_step(numbers[2]);
  return {};
}

void to_proto(const survey::Surveyed& found, v1::SurveyedRadius& message) {
  message.Clear();
  message.set_radius(found.radius);
  message.set_accepted(found.accepted());
  if (found.refusal) to_proto(*found.refusal, *message.mutable_refusal());
  message.set_reaches_every_wall(found.reaches_all);
  message.set_warnings(found.warnings);
  if (found.accepted()) {
    const verify::ClearanceReport& measured = found.clearance;
    if (measured.wall_length > 0)
      message.set_masked_share(std::min(1.0, found.left_out_length / measured.wall_length));
    if (measured.worst) to_proto(measured, *message.mutable_certificate());
    message.set_compensated_length(found.summary.compensated_length);
    message.set_programmed_length(found.summary.programmed_length);
  }
  if (found.accepted() || found.uncut_known) {
    message.set_wall_length(found.wall_length);
    message.set_uncut_length(found.uncut_length);
  }
  message.set_uncut_by_removal(found.uncut_by_removal);
  if (found.uncut_known) {
    const std::size_t count = std::min(found.uncut.size(), most_stretches);
    for (std::size_t i = 0; i < count; ++i) tell(found.uncut[i], *message.add_uncut());
    message.set_uncut_left_out(found.uncut.size() - count);
  }
  for (const Source& source : found.limits) tell(source, *message.add_limits());
}

void to_proto(const survey::Largest& found, v1::LargestRadius& message) {
  message.Clear();
  message.set_radius(found.radius);
  message.set_is_limited(found.is_limited);
  for (const Source& source : found.limits) tell(source, *message.add_limits());
  if (found.refusal) to_proto(*found.refusal, *message.mutable_refusal());
  message.set_runs(found.runs);
}

}  // namespace trc::wire
