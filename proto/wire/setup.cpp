#include "proto/wire/setup.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/base/tolerances.h"
#include "core/base/utf8.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/text/characters.h"
#include "proto/wire/geometry.h"
#include "proto/wire/modes.h"
#include "proto/wire/options.h"

namespace trc::wire {
namespace {

constexpr double largest_length = Tolerances{}.largest_coordinate;  // mm
constexpr int most_axes = 32;
constexpr int most_tools = 10'000;
constexpr std::size_t longest_tool_name = 64;

constexpr EnumTable<v1::ResponseLayout, Layout, 2> layouts{{
    {v1::RESPONSE_LAYOUT_BLOCKS, Layout::blocks},
    {v1::RESPONSE_LAYOUT_COLUMNS, Layout::columns},
}};

constexpr EnumTable<v1::ProgramOutput, bool, 2> outputs{{
    {v1::PROGRAM_OUTPUT_NC, true},
    {v1::PROGRAM_OUTPUT_BLOCKS, false},
}};

constexpr EnumTable<v1::Dialect, DialectName, 5> dialects{{
    {v1::DIALECT_ISG, DialectName::isg},
    {v1::DIALECT_FANUC, DialectName::fanuc},
    {v1::DIALECT_LINUXCNC, DialectName::linuxcnc},
    {v1::DIALECT_SINUMERIK, DialectName::sinumerik},
    {v1::DIALECT_HEIDENHAIN, DialectName::heidenhain},
}};

// Whether lengths count in inch.
constexpr EnumTable<v1::LengthUnit, bool, 2> units{{
    {v1::LENGTH_UNIT_MM, false},
    {v1::LENGTH_UNIT_INCH, true},
}};

// Whether they are copied.
constexpr EnumTable<v1::UnknownWords, bool, 2> unknown_words{{
    {v1::UNKNOWN_WORDS_REFUSE, false},
    {v1::UNKNOWN_WORDS_COPY, true},
}};

constexpr EnumTable<v1::WholeNumbers, WholeNumbers, 2> whole_numbers{{
    {v1::WHOLE_NUMBERS_UNITS, WholeNumbers::units},
    {v1::WHOLE_NUMBERS_INCREMENTS, WholeNumbers::increments},
}};

constexpr EnumTable<v1::BlockSkip, BlockSkip, 3> block_skips{{
    {v1::BLOCK_SKIP_REFUSE, BlockSkip::refuse},
    {v1::BLOCK_SKIP_EXECUTE, BlockSkip::execute},
    {v1::BLOCK_SKIP_LEAVE_OUT, BlockSkip::leave_out},
}};

constexpr EnumTable<v1::Encoding, Encoding, 3> encodings{{
    {v1::ENCODING_UTF8, Encoding::utf8},
    {v1::ENCODING_AUTO, Encoding::any},
    {v1::ENCODING_LATIN1, Encoding::any},
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
  // In a program this is a warning at its line; a setup has no line to warn about.
  if (message.options().has_stretch_factor())
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

// D-43
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
  // A tenth of a micrometre is the finest there is (rule 1.6).
  take(message.has_nominal_radius(), message.nominal_radius(), 1e-4, "nominal_radius",
       program.nominal_radius);
}

void to_proto(const ProgramSetup& program, v1::PathSetup& message) {
  if (program.wear != 0) message.set_wear(program.wear);
  if (program.allowance != 0) message.set_allowance(program.allowance);
  if (program.max_wear != ProgramSetup{}.max_wear) message.set_max_wear(program.max_wear);
  if (program.nominal_radius != 0) message.set_nominal_radius(program.nominal_radius);
}

// The tool of a name, which has a number of its own if it is given none. Nothing where another tool
// has that name.
std::optional<std::int64_t> tool_named(const v1::Tool& tool, ProgramSetup& program) {
  const auto next = first_named_tool + static_cast<std::int64_t>(program.tool_names.size());
  const std::int64_t number = tool.number() > 0 ? tool.number() : next;
  const auto [known, is_new] =
      program.tool_names.try_emplace(in_capitals_as_utf8(tool.name()), number);
  if (!is_new && tool.number() > 0 && known->second != number) return std::nullopt;
  return known->second;
}

void read_tools(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                FieldFaults& faults) {
  if (message.tools_size() > most_tools) {
    add_fault(FieldPath(path, "tools"),
              "has " + std::to_string(message.tools_size()) + " entries, allowed are " +
                  std::to_string(most_tools),
              faults);
    return;
  }
  for (int i = 0; i < message.tools_size(); ++i) {
    const v1::Tool& tool = message.tools(i);
    const FieldPath entry(path, "tools", static_cast<std::size_t>(i));
    check_range(tool.number(), {0, 2147483647}, FieldPath(entry, "number"), faults);
    check_tool_radius(tool.radius(), FieldPath(entry, "radius"), faults);
    check_tool_radius(tool.wear(), FieldPath(entry, "wear"), faults);
    check_range(tool.edge(), {0, 99}, FieldPath(entry, "edge"), faults);
    std::int64_t number = tool.number();
    if (!tool.name().empty()) {
      if (tool.name().size() > longest_tool_name) {
        add_fault(FieldPath(entry, "name"),
                  "is longer than " + std::to_string(longest_tool_name) + " bytes", faults);
        continue;
      }
      const auto named = tool_named(tool, program);
      if (!named) {
        add_fault(FieldPath(entry, "name"), "is the name of another tool", faults);
        continue;
      }
      number = *named;
    }
    const std::int64_t row = row_of_edge(number, std::max<std::int64_t>(tool.edge(), 1));
    if (!program.tools.try_emplace(row, tool.radius(), tool.wear()).second)
      add_fault(FieldPath(entry, "number"),
                "names the tool " +
                    (tool.number() > 0 || tool.name().empty() ? std::to_string(tool.number())
                                                              : tool.name()) +
                    " a second time",
                faults);
  }
}

void read_pass_words(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                     FieldFaults& faults) {
  constexpr int most_words = 1000;
  if (message.pass_words_size() > most_words)
    add_fault(FieldPath(path, "pass_words"), "has more than 1000 entries", faults);
  for (int i = 0; i < std::min(message.pass_words_size(), most_words); ++i) {
    std::string word = in_upper_case(message.pass_words(i));
    if (const std::string fault = fault_of_pass_word(word, program.dialect); !fault.empty())
      add_fault(FieldPath(path, "pass_words", static_cast<std::size_t>(i)), fault, faults);
    program.pass_words.insert(std::move(word));
  }
}

// What the dialect has in force at the start, where the setup does not say so itself.
void read_dialect(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                  FieldFaults& faults) {
  program.dialect = dialects.from_proto(message.dialect(), FieldPath(path, "dialect"), faults)
                        .value_or(program.dialect);
  program.inch =
      units.from_proto(message.unit(), FieldPath(path, "unit"), faults).value_or(program.inch);
  program.copies_unknown_words =
      unknown_words.from_proto(message.unknown_words(), FieldPath(path, "unknown_words"), faults)
          .value_or(program.copies_unknown_words);
  program.whole_numbers =
      whole_numbers.from_proto(message.whole_numbers(), FieldPath(path, "whole_numbers"), faults)
          .value_or(program.whole_numbers);
  program.block_skip =
      block_skips.from_proto(message.block_skip(), FieldPath(path, "block_skip"), faults)
          .value_or(program.block_skip);
  program.encoding = encodings.from_proto(message.encoding(), FieldPath(path, "encoding"), faults)
                         .value_or(program.encoding);
  program.renumbers = message.renumber();
  read_pass_words(message, path, program, faults);
  const Dialect& dialect = dialect_of(program.dialect);
  if (message.path().selection_mode() == v1::SELECTION_MODE_UNSPECIFIED)
    program.mode.selection = dialect.selection;
  if (message.path().transition() == v1::TRANSITION_UNSPECIFIED)
    program.mode.transition = dialect.transition;
  if (message.path().feed_adaptation() == v1::FEED_ADAPTATION_UNSPECIFIED)
    program.mode.feed_adaptation = dialect.feed_adaptation;
}

// Of programs that compute.
void read_computing(const v1::ProgramSetup& message, const FieldPath& path, ProgramSetup& program,
                    FieldFaults& faults) {
  constexpr std::size_t most_variables = 10'000;
  constexpr std::size_t most_subprograms = 1'000;
  constexpr std::size_t longest_name = 255;
  const auto is_too_many = [&](std::size_t count, std::size_t most, std::string_view field) {
    if (count <= most) return false;
    add_fault(FieldPath(path, field),
              "has " + std::to_string(count) + " entries, allowed are " + std::to_string(most),
              faults);
    return true;
  };
  const auto is_name = [&](const std::string& name, std::string_view field) {
    if (!name.empty() && name.size() <= longest_name) return true;
    add_fault(FieldPath(path, field),
              "has a name that is not 1 to " + std::to_string(longest_name) + " bytes long",
              faults);
    return false;
  };
  if (!is_too_many(message.variables().size(), most_variables, "variables"))
    for (const auto& [name, value] : message.variables())
      if (is_name(name, "variables") &&
          check_range(value, {-1e15, 1e15}, FieldPath(path, "variables"), faults))
        program.variables[name] = value;
  if (!is_too_many(message.subprograms().size(), most_subprograms, "subprograms"))
    for (const auto& [name, text] : message.subprograms())
      if (is_name(name, "subprograms")) program.subprograms[name] = text;
  if (!is_too_many(message.subprogram_files().size(), most_subprograms, "subprogram_files"))
    for (const auto& [name, text] : message.subprogram_files())
      if (is_name(name, "subprogram_files") && !program.subprograms.try_emplace(name, text).second)
        add_fault(FieldPath(path, "subprogram_files"), "names " + name + ", as subprograms do",
                  faults);
  if (message.has_max_executed_lines() &&
      check_range(static_cast<double>(message.max_executed_lines()), {1, 1e9},
                  FieldPath(path, "max_executed_lines"), faults))
    program.max_executed_lines = message.max_executed_lines();
}

}  // namespace

PathSettings from_proto(const v1::PathSetup& message, const FieldPath& path, FieldFaults& faults) {
  PathSettings settings;
  ProgramSetup& program = settings.session.program;
  program.mode = read_mode(message, path, faults);
  program.tool_radius_given = message.has_tool_radius();
  OptionalPosition start;
  from_proto(message.start_position(), FieldPath(path, "start_position"), start, faults);
  for (std::size_t axis = 0; axis < start.size(); ++axis)
    program.start[axis] = start[axis].value_or(0);
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

ProgramSettings from_proto(const v1::ProgramSetup& message, const FieldPath& path,
                           FieldFaults& faults) {
  ProgramSettings settings;
  settings.path = from_proto(message.path(), FieldPath(path, "path"), faults);
  read_tools(message, path, settings.path.session.program, faults);
  read_dialect(message, path, settings.path.session.program, faults);
  read_computing(message, path, settings.path.session.program, faults);
  // Behind G40 without a motion of its own a tool change and whole drilling cycles may follow.
  constexpr std::size_t most_passive_blocks = 10'000;
  if (settings.path.session.program.dialect != DialectName::isg &&
      !message.path().has_max_passive_blocks())
    settings.path.session.compensator.limits.passive_blocks = most_passive_blocks;
  settings.nc_text = outputs.from_proto(message.output(), FieldPath(path, "output"), faults)
                         .value_or(settings.nc_text);
  if (message.has_decimals() &&
      check_range(message.decimals(), {1, 8}, FieldPath(path, "decimals"), faults))
    settings.path.session.program.decimals = static_cast<int>(message.decimals());
  settings.file_name = message.file_name();
  if (settings.file_name.size() > 255)
    add_fault(FieldPath(path, "file_name"), "is longer than 255 bytes", faults);
  return settings;
}

v1::Dialect to_proto(DialectName dialect) { return dialects.to_proto(dialect); }

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

namespace {

void tools_to_proto(const ProgramSetup& program, v1::ProgramSetup& message) {
  std::map<std::int64_t, std::string_view> names;
  for (const auto& [name, number] : program.tool_names) names.emplace(number, name);
  for (const auto& [key, row] : program.tools) {
    v1::Tool& tool = *message.add_tools();
    const std::int64_t edge = edge_of_row(key);
    const std::int64_t number = key - row_of_edge(0, edge);
    if (number < first_named_tool) tool.set_number(static_cast<std::uint32_t>(number));
    if (const auto name = names.find(number); name != names.end())
      tool.set_name(std::string(name->second));
    if (edge > 1) tool.set_edge(static_cast<std::uint32_t>(edge));
    tool.set_radius(row.radius);
    tool.set_wear(row.wear);
  }
}

}  // namespace

void add_subprogram(const std::string& name, const std::string& text, v1::ProgramSetup& message) {
  auto& texts =
      is_utf8(text) ? *message.mutable_subprograms() : *message.mutable_subprogram_files();
  message.mutable_subprograms()->erase(name);
  message.mutable_subprogram_files()->erase(name);
  texts[name] = text;
}

void to_proto(const ProgramSettings& settings, v1::ProgramSetup& message) {
  message.Clear();
  to_proto(settings.path, *message.mutable_path());
  tools_to_proto(settings.path.session.program, message);
  if (!settings.nc_text) message.set_output(outputs.to_proto(false));
  message.set_file_name(settings.file_name);
  const ProgramSetup& program = settings.path.session.program;
  if (program.decimals != ProgramSetup{}.decimals)
    message.set_decimals(static_cast<std::uint32_t>(program.decimals));
  if (program.inch) message.set_unit(units.to_proto(true));
  if (program.copies_unknown_words) message.set_unknown_words(unknown_words.to_proto(true));
  message.mutable_variables()->insert(program.variables.begin(), program.variables.end());
  for (const auto& [name, text] : program.subprograms) add_subprogram(name, text, message);
  if (program.max_executed_lines != ProgramSetup{}.max_executed_lines)
    message.set_max_executed_lines(program.max_executed_lines);
  if (program.whole_numbers != WholeNumbers::unsaid)
    message.set_whole_numbers(whole_numbers.to_proto(program.whole_numbers));
  if (program.block_skip != BlockSkip::refuse)
    message.set_block_skip(block_skips.to_proto(program.block_skip));
  message.mutable_pass_words()->Assign(program.pass_words.begin(), program.pass_words.end());
  if (program.encoding != Encoding::of_dialect)
    message.set_encoding(encodings.to_proto(program.encoding));
  message.set_renumber(program.renumbers);
  if (program.dialect == DialectName::isg) return;
  message.set_dialect(dialects.to_proto(program.dialect));
  message.mutable_path()->set_selection_mode(selections.to_proto(program.mode.selection));
  message.mutable_path()->set_transition(transitions.to_proto(program.mode.transition));
}

}  // namespace trc::wire
