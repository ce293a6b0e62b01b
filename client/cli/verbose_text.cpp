#include "client/cli/verbose_text.h"

#include <cmath>
#include <cstddef>
#include <iostream>

#include "core/nc/dialect/dialect.h"
#include "core/nc/text/number_format.h"
#include "core/trc/result/listing.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

std::string fixed(double value, int decimals = 3) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

std::string signed_mm(double value) { return (value < 0 ? " - " : " + ") + fixed(std::abs(value)); }

std::string settings_of(const v1::ProgramSetup& setup) {
  v1::ProgramSetup without_tools = setup;
  without_tools.clear_tools();
  std::string text;
  for (const std::string& assignment : wire::assignments_of(without_tools))
    text += " " + assignment;
  return text.empty() ? " defaults" : text;
}

// A table may hold thousands.
constexpr int most_tools = 20;

std::string tools_of(const v1::ProgramSetup& setup) {
  std::string text;
  for (int i = 0; i < setup.tools_size() && i < most_tools; ++i) {
    const v1::Tool& tool = setup.tools(i);
    text += (i > 0 ? "; " : " ") + std::to_string(tool.number()) + ": radius " +
            fixed(tool.radius()) + " mm";
    if (tool.wear() != 0) text += ", wear " + fixed(tool.wear()) + " mm";
  }
  if (setup.tools_size() > most_tools)
    text += "; and " + std::to_string(setup.tools_size() - most_tools) + " others";
  return text.empty() ? " none" : text;
}

}  // namespace

std::string text_of_taken(const std::string& name, const v1::ProgramSetup& setup,
                          const ServiceOptions& service, const v1::GetServerInfoResponse& info) {
  wire::FieldFaults faults;
  const wire::ProgramSettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  const ProgramSetup& program = settings.path.session.program;
  const std::string begin = name + ": ";
  return begin + "dialect " + std::string(dialect_of(program.dialect).spelling) + ", lengths in " +
         (program.inch ? "inch" : "mm") + " until the program says\n" + begin +
         "setup:" + settings_of(setup) + '\n' + begin + "tools:" + tools_of(setup) + '\n' + begin +
         "service: " + (service.server.empty() ? "this process" : service.server) + ", trc " +
         info.version() + " (" + info.commit() + "), at most " +
         std::to_string(info.limits().max_selection_blocks()) + " blocks in a selection, " +
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
                         double seconds) {
  const wire::PathSummary& path = summary.path;
  const Summary& done = path.summary;
  const std::string begin = name + ": ";
  std::string text = begin + std::to_string(summary.lines_in) + " lines, " +
                     std::to_string(summary.bytes_in) + " bytes; " +
                     std::to_string(done.blocks_in) + " blocks in, " +
                     std::to_string(done.blocks_out) + " out";
  const char* between = ": ";
  for (std::size_t i = 0; i < origin_count; ++i) {
    if (done.blocks_by_origin[i] == 0) continue;
    text += between + std::to_string(done.blocks_by_origin[i]) + ' ' +
            std::string(name_of(static_cast<Origin>(i)));
    between = ", ";
  }
  text += '\n' + begin + "length " + fixed(done.programmed_length) + " mm programmed, " +
          fixed(done.compensated_length) + " mm compensated; radius at the end " +
          fixed(path.effective_radius) + " mm, of it wear" + signed_mm(path.wear) + ", allowance" +
          signed_mm(path.allowance) + '\n';
  const verify::ClearanceReport& measured = path.clearance;
  if (measured.worst) {
    text += begin + std::to_string(measured.checked) + " blocks of the path measured against " +
            std::to_string(measured.walls) + " of the contour";
    if (measured.wall_length > 0)
      text += ", " + fixed(100 * measured.coverage(), 1) + " % of the wall touched";
    text += '\n';
  }
  return text + begin + "time " + fixed(seconds) + " s, in the engine " +
         fixed(path.wall_time_seconds) + " s, of it computing " + fixed(path.cpu_time_seconds) +
         " s\n";
}

}  // namespace trc::cli
