#include "client/cli/reporter.h"

#include <iostream>
#include <memory>
#include <utility>

#include "core/base/explanation.h"
#include "core/nc/dialect/dialect.h"
#include "proto/wire/setup.h"

namespace trc::cli {

DialectName dialect_of(const v1::ProgramSetup& setup) {
  wire::FieldFaults faults;
  return wire::from_proto(setup, wire::FieldPath("setup"), faults).path.session.program.dialect;
}

Diagnostic for_command_line(Diagnostic found, DialectName dialect) {
  const ControlWords words = dialect_of(dialect).words;
  if (!help_in(words, found.code, found.language).empty()) return found;
  const std::string_view own = help_on_command_line(found.code, found.language);
  DiagnosticTexts texts = texts_of(found);
  if (own.empty() || texts.help != help_of({.code = found.code, .words = words}, found.language))
    return found;
  texts.help = in_words_of(words, std::string(own));
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
