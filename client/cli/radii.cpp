#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/progress.h"
#include "client/cli/reporter.h"
#include "client/cli/service.h"
#include "client/cli/speech.h"
#include "client/cli/survey_text.h"
#include "client/cli/verbose_text.h"
#include "client/cli/written_files.h"
#include "client/plot/survey_svg.h"
#include "core/survey/program_reading.h"
#include "proto/wire/json.h"
#include "proto/wire/setup.h"
#include "proto/wire/survey.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::vector<std::string> radii;
  std::string picture;
  bool json = false;
  bool without_largest = false;
};

// The survey asks about the tools of the table; they are not tools of the program.
void ask_for_tools(v1::SurveySetup& setup, ToolNames& names) {
  v1::ProgramSetup& program = *setup.mutable_program();
  for (const v1::Tool& tool : program.tools()) {
    // The sign of a radius gives the side, not the size.
    const double radius = std::abs(tool.radius()) + tool.wear();
    names.add(radius, tool.number());
    const auto& asked = setup.radii();
    if (std::find(asked.begin(), asked.end(), radius) == asked.end()) setup.add_radii(radius);
  }
  program.clear_tools();
}

bool survey_setup(const Call& call, v1::SurveySetup& setup, ToolNames& names) {
  if (!setup_of(call.program, *setup.mutable_program())) return false;
  for (const std::string& text : call.radii) {
    const std::string fault = wire::read_radii(text, setup);
    if (fault.empty()) continue;
    complain("--radii: " + fault);
    return false;
  }
  setup.set_without_largest(call.without_largest);
  setup.set_want_uncut(call.json || !call.picture.empty());
  ask_for_tools(setup, names);
  return true;
}

Point to_point(Plane plane, const v1::Position& position) {
  return to_plane(plane, {position.x(), position.y(), position.z()});
}

Segment segment_of(Plane plane, const v1::UncutWall& wall) {
  const Point start = to_point(plane, wall.start());
  const Point end = to_point(plane, wall.end());
  if (!wall.has_center()) return Line{.start = start, .end = end};
  return Arc{
      .start = start, .end = end, .center = to_point(plane, wall.center()), .sweep = wall.sweep()};
}

// The program is read here as well, because the service does not send back blocks and units.
survey::ProgramReading reading_of(const v1::SurveySetup& setup, const std::string& text) {
  wire::FieldFaults faults;
  const wire::SurveySettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  const SessionSetup& session = settings.program.path.session;
  const double radius = session.program.nominal_radius > 0 ? 0 : 1;
  return survey::read_with(radius, session, survey::text_reader(text, {}, {}));
}

// Whether the program is in inch at its first contour; none: it has no contour.
std::optional<bool> unit_of(const survey::ProgramReading& reading) {
  for (const Block& block : reading.blocks)
    if (const auto* motion = std::get_if<MotionBlock>(&block); motion && motion->mode->active())
      return reading.places.units.unit_in(motion->source.index) == LengthUnit::inch;
  return std::nullopt;
}

// Whether a program is in inch at its first contour. Reads only as many lines as needed.
bool counts_in_inch(const v1::SurveySetup& setup, const std::string& text) {
  constexpr std::size_t first_bytes = 16 * 1024;
  for (std::size_t bytes = first_bytes;; bytes *= 4) {
    const bool all = bytes >= text.size();
    const std::size_t line_end = all ? text.size() : text.rfind('\n', bytes) + 1;
    const auto inch = unit_of(reading_of(setup, text.substr(0, line_end)));
    if (inch || all) return inch.value_or(false);
  }
}

plot::SurveyPicture picture_of(const std::string& name, const survey::ProgramReading& reading,
                               const v1::SurveyAnswer& answer, Language language, bool inch,
                               const SurveyText& words) {
  plot::SurveyPicture picture{.language = language, .inch = inch, .title = name};
  const auto& limits = answer.summary().largest().limits();
  bool begun = false;
  for (const Block& block : reading.blocks) {
    const auto* motion = std::get_if<MotionBlock>(&block);
    if (motion == nullptr || !motion->mode->active()) continue;
    if (!std::exchange(begun, true)) picture.plane = motion->mode->plane;
    if (motion->mode->plane != picture.plane) continue;
    picture.contour.push_back(motion->path);
    if (std::any_of(limits.begin(), limits.end(), [&](const v1::SurveyPlace& place) {
          return place.source_index() == motion->source.index;
        }))
      picture.limits.push_back(motion->path);
  }
  for (const v1::SurveyedRadius& found : answer.radii()) {
    plot::SurveyPicture::Radius drawn{.radius = found.radius(), .text = words.legend_of(found)};
    for (const v1::UncutWall& wall : found.uncut())
      drawn.uncut.push_back(segment_of(picture.plane, wall));
    if (found.refusal().has_point())
      drawn.refused_at = to_point(picture.plane, found.refusal().point());
    picture.radii.push_back(std::move(drawn));
  }
  if (answer.summary().has_largest())
    picture.largest = words.sentence_of(answer.summary().largest());
  return picture;
}

Exit run(const Call& call) {
  v1::SurveySetup setup;
  ToolNames names;
  if (!survey_setup(call, setup, names)) return Exit::wrong_call;
  FilesRead read(call.program);
  read.add(call.program.file, "the program itself");
  if (!may_be_written({{.option = "--picture", .path = call.picture}}, read))
    return Exit::wrong_call;
  if (!call.picture.empty() && call.picture != "-" &&
      std::filesystem::path(call.picture).extension() != ".svg") {
    complain("--picture " + call.picture + ": the name must end in .svg");
    return Exit::wrong_call;
  }
  Input input(call.program.file);
  if (!input.open()) return Exit::wrong_call;
  const Loudness& loudness = call.program.loudness;
  if (loudness.verbose) {
    const Exit exit = tell_taken(input.name(), setup.program(), call.program.service);
    if (exit != Exit::done) return exit;
  }
  Progress progress(Progress::Result::elsewhere, loudness, language_of(setup.program()));
  Reporter reporter(input, setup.program(), progress, loudness.quiet);
  std::string text;
  for (std::string_view piece = input.read(); !piece.empty(); piece = input.read()) text += piece;
  if (input.failed()) return Exit::wrong_call;

  v1::SurveyAnswer answer;
  const Exit exit = survey_program(call.program.service, setup, text, reporter, answer);
  if (exit != Exit::done) return exit;
  if (call.json) std::cout << wire::json_of(answer) << '\n';
  if (call.json && call.picture.empty()) return Exit::done;
  const bool inch = counts_in_inch(setup, text);
  const Language language = language_of(setup.program());
  const SurveyText words(language, inch ? LengthUnit::inch : LengthUnit::mm, names);
  if (!call.json) std::cout << words.table_of(answer);
  if (call.picture.empty()) return Exit::done;
  const survey::ProgramReading reading = reading_of(setup, text);
  Output output(call.picture);
  const std::string name = std::filesystem::path(input.name()).filename().string();
  return output.open() &&
                 output.write(to_svg(picture_of(name, reading, answer, language, inch, words))) &&
                 output.commit()
             ? Exit::done
             : Exit::wrong_call;
}

}  // namespace

void add_radii(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "radii",
      "Say what tools of many radii make of a program, and which is the largest that fits");
  auto call = std::make_shared<Call>();
  add_program_options(*command, call->program);
  add_loudness_options(*command, call->program.loudness);
  command
      ->add_option("--radii", call->radii,
                   "Radii to ask about, mm: 3,5,8 or 3:8:0.5, from, to and step; 64 at most")
      ->type_name("LIST|RANGE")
      ->allow_extra_args(false);
  command->add_flag("--no-largest", call->without_largest,
                    "Without the largest radius that reaches every wall");
  command->add_flag("--json", call->json, "Print what was found as one JSON object");
  command->add_option("--picture", call->picture, "Picture of what each radius cannot reach")
      ->type_name("OUT.svg");
  command->footer(
      "With --tools the radii are those of the table, wear added. A radius takes the place of "
      "every one that\nthe program gives, by D and T words as well; --wear and allowance are added "
      "to each. Exit code 1 when\nthe program cannot be read with any radius.\n\n" +
      settings_help(Language::english));
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
