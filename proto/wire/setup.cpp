#include "proto/wire/setup.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "core/base/tolerances.h"
#include "core/nc/dialect/dialect.h"
#include "proto/wire/geometry.h"
#include "proto/wire/modes.h"
#include "proto/wire/options.h"

namespace trc::wire {
namespace {

constexpr double largest_length = Tolerances{}.largest_coordinate;  // mm
constexpr int most_axes = 32;

constexpr EnumTable<v1::ResponseLayout, Layout, 2> layouts{{
    {v1::RESPONSE_LAYOUT_BLOCKS, Layout::blocks},
    {v1::RESPONSE_LAYOUT_COLUMNS, Layout::columns},
}};

constexpr EnumTable<v1::KerfMethod, bool, 2> kerf_methods{{
    {v1::KERF_METHOD_LINEAR, false},
    {v1::KERF_METHOD_CIRCULAR, true},
}};

constexpr EnumTable<v1::Verification, Verify, 3> verifications{{
    {v1::VERIFICATION_ENFORCE, Verify::enforce},
    {v1::VERIFICATION_REPORT, Verify::report},
    {v1::VERIFICATION_OFF, Verify::off},
}};

CircleCheck from_proto(const v1::CircleCenterMode& message, const FieldPath& path,
                       FieldFaults& faults) {
  CircleCheck check;
  const auto limit = [&](bool present, double value, double high, std::string_view name,
                         double& target) {
    if (present && check_range(value, {0, high}, FieldPath(path, name), faults)) target = value;
  };
  check.correct_center =
      center_corrections.from_proto(message.correction(), FieldPath(path, "correction"), faults)
          .value_or(check.correct_center);
  limit(message.has_max_shift(), message.max_shift(), largest_length, "max_shift",
        check.largest_shift);
  limit(message.has_max_shift_factor(), message.max_shift_factor(), 1, "max_shift_factor",
        check.largest_shift_factor);
  limit(message.has_warn_shift(), message.warn_shift(), largest_length, "warn_shift",
        check.reported_shift);
  limit(message.has_max_radius_difference(), message.max_radius_difference(), largest_length,
        "max_radius_difference", check.largest_radius_difference);
  limit(message.has_max_radius_difference_factor(), message.max_radius_difference_factor(), 1,
        "max_radius_difference_factor", check.largest_radius_factor);
  return check;
}

void to_proto(const CircleCheck& check, bool absolute_center, v1::CircleCenterMode& message) {
  message.set_reference(center_references.to_proto(absolute_center));
  message.set_correction(center_corrections.to_proto(check.correct_center));
  message.set_max_shift(check.largest_shift);
  message.set_max_shift_factor(check.largest_shift_factor);
  message.set_warn_shift(check.reported_shift);
  message.set_max_radius_difference(check.largest_radius_difference);
  message.set_max_radius_difference_factor(check.largest_radius_factor);
}

bool is_axis_name(const std::string& name) {
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
  const auto is_part = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && name.size() <= 16 && is_letter(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(), is_part);
}

void read_axis_names(const v1::PathSetup& message, const FieldPath& path,
                     std::vector<std::string>& names, FieldFaults& faults) {
  if (message.axis_names().empty()) return;
  if (message.axis_names_size() > most_axes) {
    add_fault(FieldPath(path, "axis_names"),
              "has " + std::to_string(message.axis_names_size()) + " entries, allowed are " +
                  std::to_string(most_axes),
              faults);
    return;
  }
  std::set<std::string> taken{"X", "Y", "Z"};
  names.assign(message.axis_names().begin(), message.axis_names().end());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const FieldPath entry(path, "axis_names", i);
    if (!is_axis_name(names[i]))
      add_fault(entry, "is not a letter followed by up to 15 letters, digits or '_'", faults);
    else if (!taken.insert(names[i]).second)
      add_fault(entry, "names the axis " + names[i] + " a second time", faults);
  }
}

bool is_printable(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

TrcMode read_mode(const v1::PathSetup& message, const FieldPath& path, FieldFaults& faults) {
  TrcMode mode;
  mode.plane = from_proto(message.plane(), FieldPath(path, "plane"), faults).value_or(mode.plane);
  mode.selection =
      selections.from_proto(message.selection_mode(), FieldPath(path, "selection_mode"), faults)
          .value_or(mode.selection);
  mode.transition =
      transitions.from_proto(message.transition(), FieldPath(path, "transition"), faults)
          .value_or(mode.transition);
  mode.masking =
      maskings.from_proto(message.contour_masking(), FieldPath(path, "contour_masking"), faults)
          .value_or(mode.masking);
  mode.feed_adaptation =
      feed_adaptations
          .from_proto(message.feed_adaptation(), FieldPath(path, "feed_adaptation"), faults)
          .value_or(mode.feed_adaptation);
  if (check_range(message.tangfeed_min_radius(), {0, largest_length, "mm"},
                  FieldPath(path, "tangfeed_min_radius"), faults))
    mode.tangfeed_minimum = message.tangfeed_min_radius();
  if (check_tool_radius(message.tool_radius(), FieldPath(path, "tool_radius"), faults))
    mode.tool_radius = message.tool_radius();
  const FieldPath options(path, "options");
  mode.options = changed({}, from_proto(message.options(), options, faults));
  // In a program this is a warning at its line; a setup has no line to warn about. Values that are
  // not finite have already been refused with the other options.
  if (message.options().has_stretch_factor() && std::isfinite(message.options().stretch_factor()))
    check_range(message.options().stretch_factor(), {1, 9}, FieldPath(options, "stretch_factor"),
                faults);
  return mode;
}

void read_limits(const v1::PathSetup& message, const FieldPath& path, CompensatorSetup& compensator,
                 FieldFaults& faults) {
  compensator.limits.look_ahead_blocks = message.look_ahead_blocks();
  if (message.has_max_passive_blocks() &&
      check_range(message.max_passive_blocks(), {1, 10'000}, FieldPath(path, "max_passive_blocks"),
                  faults))
    compensator.limits.passive_blocks = message.max_passive_blocks();
  if (message.has_min_feed_factor() &&
      check_range(message.min_feed_factor(), {1e-6, 1}, FieldPath(path, "min_feed_factor"), faults))
    compensator.smallest_feed_factor = message.min_feed_factor();
  if (message.has_input_resolution() && check_range(message.input_resolution(), {0, 0.1, "mm"},
                                                    FieldPath(path, "input_resolution"), faults))
    compensator.tolerances.input_resolution = compensator.leads.input_resolution =
        message.input_resolution();
  compensator.implicit_contour_masking = message.implicit_contour_masking();
  compensator.circular_kerf_masking =
      kerf_methods.from_proto(message.kerf_method(), FieldPath(path, "kerf_method"), faults)
          .value_or(compensator.circular_kerf_masking);
}

void read_leads(const v1::PathSetup& message, const FieldPath& path, CompensatorSetup& compensator,
                FieldFaults& faults) {
  const FieldPath leads(path, "leads");
  LeadSettings& settings = compensator.leads;
  settings.find = lead_searches.from_proto(message.leads().find(), FieldPath(leads, "find"), faults)
                      .value_or(settings.find);
  settings.blocks_in = message.leads().blocks_in();
  settings.blocks_out = message.leads().blocks_out();
  const bool counted = settings.find == LeadSettings::Find::counted;
  if (!counted && settings.blocks_in + settings.blocks_out > 0)
    add_fault(leads, "counts blocks, which only FIND_BLOCKS does", faults);
  if (message.has_closing_tolerance() && check_range(message.closing_tolerance(), {0, 1, "mm"},
                                                     FieldPath(path, "closing_tolerance"), faults))
    settings.closing_tolerance = message.closing_tolerance();
  if (message.has_max_masked_share() &&
      check_range(message.max_masked_share(), {0, 1}, FieldPath(path, "max_masked_share"), faults))
    compensator.largest_masked_share = message.max_masked_share();
}

// The terms of the radius (D-43).
void read_radius_terms(const v1::PathSetup& message, const FieldPath& path, ProgramSetup& program,
                       FieldFaults& faults) {
  const auto take = [&](bool present, double value, double low, const char* name, double& target) {
    if (present && check_range(value, {low, ToolInForce::largest_tool_radius, "mm"},
                               FieldPath(path, name), faults))
      target = value;
  };
  constexpr double largest = ToolInForce::largest_tool_radius;
  take(message.has_wear(), message.wear(), -largest, "wear", program.wear);
  take(message.has_allowance(), message.allowance(), -largest, "allowance", program.allowance);
  take(message.has_max_wear(), message.max_wear(), 0, "max_wear", program.max_wear);
  // A tenth of a micrometre is the smallest length (rule 1.6).
  take(message.has_nominal_radius(), message.nominal_radius(), 1e-4, "nominal_radius",
       program.nominal_radius);
}

void to_proto(const ProgramSetup& program, v1::PathSetup& message) {
  if (program.wear != 0) message.set_wear(program.wear);
  if (program.allowance != 0) message.set_allowance(program.allowance);
  if (program.max_wear != ProgramSetup{}.max_wear) message.set_max_wear(program.max_wear);
  if (program.nominal_radius != 0) message.set_nominal_radius(program.nominal_radius);
}

}  // namespace

PathSettings from_proto(const v1::PathSetup& message, const FieldPath& path, FieldFaults& faults) {
  PathSettings settings;
  ProgramSetup& program = settings.session.program;
  program.mode = read_mode(message, path, faults);
  program.tool_radius_given = message.has_tool_radius();
  OptionalPosition start;
  from_proto(message.start_position(), FieldPath(path, "start_position"), start, faults);
  // A negative zero becomes a positive one; otherwise the answer would carry its sign.
  constexpr double unsigned_zero = 0.0;
  for (std::size_t axis = 0; axis < start.size(); ++axis)
    program.start[axis] = start[axis].value_or(0) + unsigned_zero;
  settings.session.compensator.start = program.start;
  const FieldPath circles(path, "circle_center_mode");
  program.circle = from_proto(message.circle_center_mode(), circles, faults);
  program.absolute_center = center_references
                                .from_proto(message.circle_center_mode().reference(),
                                            FieldPath(circles, "reference"), faults)
                                .value_or(program.absolute_center);
  read_radius_terms(message, path, program, faults);
  read_axis_names(message, path, program.tracking_axes, faults);
  read_limits(message, path, settings.session.compensator, faults);
  read_leads(message, path, settings.session.compensator, faults);
  settings.response_layout =
      layouts.from_proto(message.response_layout(), FieldPath(path, "response_layout"), faults)
          .value_or(settings.response_layout);
  settings.session.compensator.inverse_path = message.include_inverse_path();
  settings.session.verify =
      verifications.from_proto(message.verify(), FieldPath(path, "verify"), faults)
          .value_or(settings.session.verify);
  settings.want_resume_tokens = message.want_resume_tokens();
  settings.resume_token = message.resume_token();
  settings.client_tag = message.client_tag();
  if (settings.client_tag.size() > 64 || !is_printable(settings.client_tag))
    add_fault(FieldPath(path, "client_tag"), "is not at most 64 bytes of printable ASCII", faults);
  if (!message.language().empty()) {
    const auto language = language_of_tag(message.language());
    if (!language) add_fault(FieldPath(path, "language"), "is neither en nor de", faults);
    settings.session.language = language.value_or(Language::english);
  }
  return settings;
}

void to_proto(const PathSettings& settings, v1::PathSetup& message) {
  const PathSettings initial;
  const ProgramSetup& program = settings.session.program;
  const TrcMode& mode = program.mode;
  const CompensatorSetup& compensator = settings.session.compensator;
  const CompensatorSetup& compensator_initial = initial.session.compensator;
  message.Clear();
  if (mode.plane != Plane::xy) message.set_plane(to_proto(mode.plane));
  if (program.start != Position{}) to_proto(program.start, *message.mutable_start_position());
  if (mode.tool_radius != 0 || program.tool_radius_given) message.set_tool_radius(mode.tool_radius);
  to_proto(program, message);
  const Dialect& dialect = dialect_of(program.dialect);
  if (mode.selection != dialect.selection)
    message.set_selection_mode(selections.to_proto(mode.selection));
  if (mode.transition != dialect.transition)
    message.set_transition(transitions.to_proto(mode.transition));
  if (mode.masking != Masking::off) message.set_contour_masking(maskings.to_proto(mode.masking));
  if (mode.feed_adaptation != dialect.feed_adaptation)
    message.set_feed_adaptation(feed_adaptations.to_proto(mode.feed_adaptation));
  if (mode.tangfeed_minimum != 0) message.set_tangfeed_min_radius(mode.tangfeed_minimum);
  if (compensator.smallest_feed_factor != compensator_initial.smallest_feed_factor)
    message.set_min_feed_factor(compensator.smallest_feed_factor);
  to_proto(program.circle, program.absolute_center, *message.mutable_circle_center_mode());
  if (mode.options != TrcOptions{})
    to_proto(changes_from_initial(mode.options), *message.mutable_options());
  if (compensator.limits.look_ahead_blocks != 0)
    message.set_look_ahead_blocks(static_cast<std::uint32_t>(compensator.limits.look_ahead_blocks));
  if (compensator.tolerances.input_resolution != compensator_initial.tolerances.input_resolution)
    message.set_input_resolution(compensator.tolerances.input_resolution);
  if (compensator.implicit_contour_masking) message.set_implicit_contour_masking(true);
  if (!compensator.circular_kerf_masking) message.set_kerf_method(kerf_methods.to_proto(false));
  const LeadSettings& leads = compensator.leads;
  if (leads.find != LeadSettings::Find::automatic) {
    message.mutable_leads()->set_find(lead_searches.to_proto(leads.find));
    message.mutable_leads()->set_blocks_in(static_cast<std::uint32_t>(leads.blocks_in));
    message.mutable_leads()->set_blocks_out(static_cast<std::uint32_t>(leads.blocks_out));
  }
  if (leads.closing_tolerance != compensator_initial.leads.closing_tolerance)
    message.set_closing_tolerance(leads.closing_tolerance);
  if (compensator.largest_masked_share != compensator_initial.largest_masked_share)
    message.set_max_masked_share(compensator.largest_masked_share);
  if (program.tracking_axes != initial.session.program.tracking_axes)
    message.mutable_axis_names()->Assign(program.tracking_axes.begin(),
                                         program.tracking_axes.end());
  if (compensator.limits.passive_blocks != compensator_initial.limits.passive_blocks)
    message.set_max_passive_blocks(static_cast<std::uint32_t>(compensator.limits.passive_blocks));
  if (settings.response_layout != Layout::blocks)
    message.set_response_layout(layouts.to_proto(settings.response_layout));
  message.set_include_inverse_path(compensator.inverse_path);
  if (settings.session.verify != Verify::off)
    message.set_verify(verifications.to_proto(settings.session.verify));
  message.set_client_tag(settings.client_tag);
  if (settings.session.language == Language::german) message.set_language("de");
  message.set_want_resume_tokens(settings.want_resume_tokens);
  message.set_resume_token(settings.resume_token);
}

}  // namespace trc::wire
