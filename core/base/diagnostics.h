#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/call_places.h"
#include "core/base/diagnostic.h"
#include "core/base/program_units.h"

namespace trc {

// Facts about a program block by block, which messages need.
struct ProgramPlaces {
  ProgramUnits units{};
  CallPlaces calls{};
};

// The ordered log of one session: notes, warnings, and the error that stops the stream, with the
// errors that were found together with it.
class Diagnostics {
 public:
  // Returns whether the stream goes on. After an error everything that was not found together with
  // it is dropped: it would be a consequence of the error.
  bool report(Diagnostic diagnostic) {
    const bool belongs_to_the_error = stopped_ && diagnostic.found_together && !pending_.empty() &&
                                      pending_.back().found_together;
    if (stopped_ && !belongs_to_the_error) return false;
    const ProgramPlaces& places = places_ == nullptr ? own_places_ : *places_;
    diagnostic.inch = places.units.unit_in(diagnostic.source.index) == LengthUnit::inch;
    if (diagnostic.calls.empty()) diagnostic.calls = places.calls.of(diagnostic.source.index);
    diagnostic.language = language_;
    diagnostic.words = words_;
    ++counts_[static_cast<std::size_t>(diagnostic.severity)];
    stopped_ |= diagnostic.severity == Severity::error;
    pending_.push_back(std::move(diagnostic));
    return !stopped_;
  }

  // Several errors that were found together: all of them are told, and the stream stops.
  bool report_together(std::vector<Diagnostic> errors) {
    if (stopped_) return false;
    for (Diagnostic& error : errors) {
      stopped_ = false;
      error.found_together = true;
      report(std::move(error));
    }
    return false;
  }

  [[nodiscard]] bool stopped() const { return stopped_; }

  // Adds the help to the error reported last.
  void help_with_entry(std::shared_ptr<const EntryHelp> help) {
    if (stopped_ && !pending_.empty()) pending_.back().entry_help = std::move(help);
  }

  // Reported and not yet taken, in order.
  [[nodiscard]] const std::vector<Diagnostic>& pending() const { return pending_; }
  [[nodiscard]] std::vector<Diagnostic> take() { return std::exchange(pending_, {}); }

  // How many were reported so far, taken or not.
  [[nodiscard]] std::uint64_t count(Severity severity) const {
    return counts_[static_cast<std::size_t>(severity)];
  }

  // Sets the language and the words for diagnostics reported from here on.
  void speak(Language language, ControlWords words) {
    language_ = language;
    words_ = words;
  }

  // The units of the program, filled in by its reader.
  [[nodiscard]] ProgramUnits& units() { return own_places_.units; }
  // The calls of a program that computes, filled in as it is executed.
  [[nodiscard]] CallPlaces& calls() { return own_places_.calls; }
  [[nodiscard]] const ProgramPlaces& places() const { return own_places_; }
  // Uses the places of another log of the same program, which outlive this one.
  void count_as(const ProgramPlaces& places) { places_ = &places; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(counts_, stopped_, own_places_.units);
  }

 private:
  ProgramPlaces own_places_;
  const ProgramPlaces* places_ = nullptr;  // none: its own
  Language language_ = Language::english;
  ControlWords words_ = ControlWords::isg;
  std::vector<Diagnostic> pending_;
  std::array<std::uint64_t, 3> counts_{};
  bool stopped_ = false;
};

}  // namespace trc
