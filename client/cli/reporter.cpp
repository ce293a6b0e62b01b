#include "client/cli/reporter.h"

#include <iostream>

#include "client/cli/report.h"
#include "core/base/explanation.h"
#include "proto/wire/setup.h"

namespace trc::cli {
namespace {

Writing writing_of(const v1::ProgramSetup& setup) {
  wire::FieldFaults faults;
  const wire::ProgramSettings settings = wire::from_proto(setup, wire::FieldPath("setup"), faults);
  return {.dialect = settings.path.session.program.dialect};
}

// Its help in words of the command line, where it is the one of its code: the sender names fields
// of the setup.
wire::ReceivedDiagnostic for_command_line(wire::ReceivedDiagnostic received) {
  const Language language = received.diagnostic.language;
  const std::string& sent = received.help.empty() ? received.remedy : received.help;
  const std::string_view own = help_on_command_line(received.diagnostic.code, language);
  if (!own.empty() && sent == help_of({.code = received.diagnostic.code}, language))
    received.help = own;
  return received;
}

}  // namespace

Reporter::Reporter(Input& input, const v1::ProgramSetup& setup, Progress& progress)
    : input_(input),
      lines_(input),
      writing_(writing_of(setup)),
      in_colour_(colours_wanted()),
      progress_(progress) {}

void Reporter::report(const std::vector<wire::ReceivedDiagnostic>& diagnostics) {
  for (const wire::ReceivedDiagnostic& received : diagnostics) {
    const Diagnostic& found = received.diagnostic;
    refused_ = refused_ || found.severity == Severity::error;
    const Text text(found.severity, found.code, received.message);
    const auto [like, is_new] = not_shown_.try_emplace(text);
    if (!is_new) {
      like->second.push_back(found);
      continue;
    }
    order_.push_back(text);
    progress_.clear();
    std::cerr << text_of(for_command_line(received), {.file = input_.name(),
                                                      .source_line = lines_.line(found.source.line),
                                                      .writing = writing_,
                                                      .in_colour = in_colour_});
  }
}

void Reporter::finish() {
  progress_.clear();
  for (const Text& text : order_) {
    const std::vector<Diagnostic>& like = not_shown_.at(text);
    if (!like.empty())
      std::cerr << more_like(like, {.file = input_.name(), .in_colour = in_colour_});
  }
  order_.clear();
  not_shown_.clear();
}

}  // namespace trc::cli
