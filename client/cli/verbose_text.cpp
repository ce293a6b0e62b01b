#include "client/cli/verbose_text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>

#include "client/cli/fixed_text.h"
#include "client/cli/printable.h"
#include "client/cli/program_options.h"
#include "core/nc/dialect/dialect.h"
#include "core/trc/result/compensated_block.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

// The words of -v in one language.
struct Words {
  const char* dialect;
  const char* lengths_in;
  const char* inch;
  const char* until_said;
  const char* setup;
  const char* defaults;
  const char* tools;
  const char* radius;
  const char* wear;
  const char* others_before;
  const char* others_behind;
  const char* no_tools;
  const char* service;
  const char* this_process;
  const char* at_most;
  const char* blocks_in_selection;
  const char* lines;
  const char* bytes;
  const char* blocks_in;
  const char* blocks_out;
  std::array<const char*, origin_count> origins;  // in the order of Origin
  const char* length;
  const char* programmed;
  const char* compensated;
  const char* radius_at_end;
  const char* of_it_wear;
  const char* allowance;
  const char* measured_against;
  const char* of_contour;
  const char* of_wall_touched;
  const char* time;
  const char* in_engine;
  const char* computing;
};

constexpr Words english{
    .dialect = "dialect ",
    .lengths_in = ", lengths in ",
    .inch = "inch",
    .until_said = " until the program says",
    .setup = "setup:",
    .defaults = " defaults",
    .tools = "tools:",
    .radius = ": radius ",
    .wear = ", wear ",
    .others_before = "; and ",
    .others_behind = " others",
    .no_tools = " none",
    .service = "service: ",
    .this_process = "this process",
    .at_most = "at most ",
    .blocks_in_selection = " blocks in a selection, ",
    .lines = " lines, ",
    .bytes = " bytes; ",
    .blocks_in = " blocks in, ",
    .blocks_out = " out",
    .origins = {"programmed", "approach", "retract", "transition", "masked", "radius change",
                "kerf", "converted circle", "passed through", "uncompensated"},
    .length = "length ",
    .programmed = " programmed, ",
    .compensated = " compensated; ",
    .radius_at_end = "radius at the end ",
    .of_it_wear = ", of it wear",
    .allowance = ", allowance",
    .measured_against = " blocks of the path measured against ",
    .of_contour = " of the contour",
    .of_wall_touched = " % of the wall touched",
    .time = "time ",
    .in_engine = " s, in the engine ",
    .computing = " s, of it computing ",
};

constexpr Words german{
    .dialect = "Dialekt ",
    .lengths_in = ", Längen in ",
    .inch = "Zoll",
    .until_said = ", solange das Programm nichts anderes vorgibt",
    .setup = "Vorgaben:",
    .defaults = " keine",
    .tools = "Werkzeuge:",
    .radius = ": Radius ",
    .wear = ", Verschleiß ",
    .others_before = "; und ",
    .others_behind = " weitere",
    .no_tools = " keine",
    .service = "Dienst: ",
    .this_process = "dieser Prozess",
    .at_most = "höchstens ",
    .blocks_in_selection = " Sätze zwischen An- und Abwahl, ",
    .lines = " Zeilen, ",
    .bytes = " Byte; ",
    .blocks_in = " Sätze hinein, ",
    .blocks_out = " heraus",
    .origins = {"programmiert", "Anfahren", "Abfahren", "Übergang", "ausgeblendet", "Radiuswechsel",
                "Kerbe", "gewandelter Kreisbogen", "durchgereicht", "unkorrigiert"},
    .length = "Länge ",
    .programmed = " programmiert, ",
    .compensated = " korrigiert; ",
    .radius_at_end = "Radius am Ende ",
    .of_it_wear = ", davon Verschleiß",
    .allowance = ", Aufmaß",
    .measured_against = " Sätze der Bahn nachgemessen an ",
    .of_contour = " der Kontur",
    .of_wall_touched = " % der Wand berührt",
    .time = "Zeit ",
    .in_engine = " s, im Rechenkern ",
    .computing = " s, davon gerechnet ",
};

const Words& words_in(Language language) { return language == Language::german ? german : english; }

// A length in the unit of the program.
std::string length_text(double mm, LengthUnit unit) {
  return unit == LengthUnit::inch ? fixed(mm / mm_per_inch, 4) + " in" : fixed(mm, 3) + " mm";
}

std::string signed_length(double mm, LengthUnit unit) {
  return (mm < 0 ? " - " : " + ") + length_text(std::abs(mm), unit);
}

std::string settings_of(const v1::ProgramSetup& setup, const Words& words) {
  v1::ProgramSetup without_tools = setup;
  without_tools.clear_tools();
  std::string text;
  for (const std::string& assignment : wire::assignments_of(without_tools))
    text += " " + assignment;
  return text.empty() ? words.defaults : text;
}

// A table may hold thousands of tools.
constexpr int most_tools = 20;

std::string tools_of(const v1::ProgramSetup& setup, const Words& words) {
  std::string text;
  for (int i = 0; i < setup.tools_size() && i < most_tools; ++i) {
    const v1::Tool& tool = setup.tools(i);
    text += (i > 0 ? "; " : " ") + std::to_string(tool.number()) + words.radius +
            length_text(tool.radius(), LengthUnit::mm);
    if (tool.wear() != 0) text += words.wear + length_text(tool.wear(), LengthUnit::mm);
  }
  if (setup.tools_size() > most_tools)
    text +=
        words.others_before + std::to_string(setup.tools_size() - most_tools) + words.others_behind;
  return text.empty() ? words.no_tools : text;
}

std::string origins_of(const Summary& done, const Words& words) {
  std::string text;
  for (std::size_t i = 0; i < origin_count; ++i) {
    if (done.blocks_by_origin[i] == 0) continue;
    text += (text.empty() ? ": " : ", ") + std::to_string(done.blocks_by_origin[i]) + ' ' +
            words.origins[i];
  }
  return text;
}

}  // namespace

std::string text_of_taken(const std::string& name, const v1::ProgramSetup& setup,
                          const ServiceOptions& service, const v1::GetServerInfoResponse& info) {
  const Words& words = words_in(language_of(setup));
  wire::FieldFaults faults;
  const wire::ProgramSettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  const ProgramSetup& program = settings.path.session.program;
  const std::string begin = printable(name) + ": ";
  return begin + words.dialect + std::string(dialect_of(program.dialect).spelling) +
         words.lengths_in + (program.inch ? words.inch : "mm") + words.until_said + '\n' + begin +
         words.setup + settings_of(setup, words) + '\n' + begin + words.tools +
         tools_of(setup, words) + '\n' + begin + words.service +
         (service.server.empty() ? words.this_process : printable(service.server)) + ", trc " +
         info.version() + " (" + info.commit() + "), " + words.at_most +
         std::to_string(info.limits().max_selection_blocks()) + words.blocks_in_selection +
         std::to_string(info.limits().max_memory_bytes() >> 20U) + " MiB\n";
}

Exit tell_taken(const std::string& name, const v1::ProgramSetup& setup,
                const ServiceOptions& service) {
  v1::GetServerInfoResponse info;
  if (const Exit exit = server_info(service, info); exit != Exit::done) return exit;
  std::cerr << text_of_taken(name, setup, service, info);
  return Exit::done;
}

std::string text_of_done(const std::string& name, const wire::ProgramSummary& summary,
                         double seconds, const Telling& telling) {
  const Words& words = words_in(telling.language);
  const LengthUnit unit = telling.unit;
  const wire::PathSummary& path = summary.path;
  const Summary& done = path.summary;
  const std::string begin = printable(name) + ": ";
  std::string text = begin + std::to_string(summary.lines_in) + words.lines +
                     std::to_string(summary.bytes_in) + words.bytes +
                     std::to_string(done.blocks_in) + words.blocks_in +
                     std::to_string(done.blocks_out) + words.blocks_out + origins_of(done, words);
  text += '\n' + begin + words.length + length_text(done.programmed_length, unit) +
          words.programmed + length_text(done.compensated_length, unit) + words.compensated +
          words.radius_at_end + length_text(path.effective_radius, unit) + words.of_it_wear +
          signed_length(path.wear, unit) + words.allowance + signed_length(path.allowance, unit) +
          '\n';
  const verify::ClearanceReport& measured = path.clearance;
  if (measured.worst) {
    text += begin + std::to_string(measured.checked) + words.measured_against +
            std::to_string(measured.walls) + words.of_contour;
    if (measured.wall_length > 0)
      text += ", " + fixed(100 * measured.coverage(), 1) + words.of_wall_touched;
    text += '\n';
  }
  return text + begin + words.time + fixed(seconds, 3) + words.in_engine +
         fixed(path.wall_time_seconds, 3) + words.computing + fixed(path.cpu_time_seconds, 3) +
         " s\n";
}

}  // namespace trc::cli
