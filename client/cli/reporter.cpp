#include "client/cli/reporter.h"

#include <array>
#include <iostream>
#include <memory>
#include <string_view>
#include <utility>

#include "core/base/explanation.h"
#include "core/nc/dialect/dialect.h"
#include "proto/wire/setup.h"

namespace trc::cli {

DialectName dialect_of(const v1::ProgramSetup& setup) {
  wire::FieldFaults faults;
  return wire::from_proto(setup, wire::FieldPath("setup"), faults).path.session.program.dialect;
}

namespace {

// Of help that has no words of its own for the command line, those that it has otherwise.
std::string without_names_of_fields(std::string help) {
  constexpr auto names = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"SurveyRadii (trc radii)", "trc radii"},
       {", `dialect` in the setup", ""},
       {", `dialect` im Setup", ""},
       {"the radius of the setup", "that of --radius and --tools"},
       {"der Radius der Einstellungen", "der von --radius und --tools"}});
  for (const auto& [field, own] : names)
    if (const std::size_t at = help.find(field); at != std::string::npos)
      help.replace(at, field.size(), own);
  return help;
}

}  // namespace

Diagnostic for_command_line(Diagnostic found, DialectName dialect) {
  const ControlWords words = dialect_of(dialect).words;
  const std::string_view own = help_on_command_line(found.code, found.language);
  const bool has_own = !own.empty() && help_in(words, found.code, found.language).empty();
  DiagnosticTexts texts = texts_of(found);
  const bool is_of_row =
      texts.help == help_of({.code = found.code, .words = words}, found.language);
  texts.help = has_own && is_of_row ? in_words_of(words, std::string(own))
                                    : without_names_of_fields(std::move(texts.help));
  found.texts = std::make_shared<const DiagnosticTexts>(std::move(texts));
  return found;
}

Reporter::Reporter(Input& input, const v1::ProgramSetup& setup, Progress& progress, bool quiet)
    : input_(input),
      lines_(input),
      writing_{.dialect = dialect_of(setup)},
      in_colour_(colours_wanted()),
      quiet_(quiet),
      progress_(progress) {}

void Reporter::report(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& found : diagnostics) {
    refused_ = refused_ || found.severity == Severity::error;
    if (quiet_ && found.severity != Severity::error) continue;
    const Text text(found.severity, found.code, texts_of(found).message);
    if (const auto like = like_shown_.find(text); like != like_shown_.end()) {
      like->second.add(found);
    } else if (order_.size() < most_texts) {
      like_shown_.emplace(text, Counted{});
      order_.push_back(text);
      show(found);
    } else {
      of_other_texts_[Kind(found.severity, found.code)].add(found);
    }
  }
}

void Reporter::show(const Diagnostic& found) {
  progress_.clear();
  std::cerr << text_of(for_command_line(found, writing_.dialect),
                       {.file = input_.name(),
                        .source_line = lines_.line(found.source.line),
                        .writing = writing_,
                        .in_colour = in_colour_});
}

void Reporter::finish() {
  progress_.clear();
  const Shown shown{.file = input_.name(), .in_colour = in_colour_};
  for (const Text& text : order_) {
    const Counted& like = like_shown_.at(text);
    if (like.count > 0) std::cerr << more_like(like, shown);
  }
  for (const auto& [kind, counted] : of_other_texts_) std::cerr << more_of_code(counted, shown);
  order_.clear();
  like_shown_.clear();
  of_other_texts_.clear();
}

}  // namespace trc::cli
