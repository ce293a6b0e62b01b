#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "client/cli/entry_help_text.h"
#include "client/cli/files.h"
#include "client/cli/given_subprograms.h"
#include "client/cli/progress.h"
#include "client/cli/report.h"
#include "client/cli/source_lines.h"
#include "core/base/diagnostic.h"
#include "core/nc/state/dialect_name.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// The dialect of the program that belongs to the setup.
[[nodiscard]] DialectName dialect_of(const v1::ProgramSetup& setup);

// The diagnostic with its help in words of the command line, if it is that of its code: the sender
// names fields of the setup.
[[nodiscard]] Diagnostic for_command_line(Diagnostic found, DialectName dialect);

// Reports the diagnostics of one program on standard error. Those equal to an earlier one, apart
// from the place, are counted and summed up at the end; beyond very many different texts, as for a
// path with a million warnings, only codes are counted.
class Reporter {
 public:
  // Different texts that are shown.
  static constexpr std::size_t most_texts = 1000;

  // Before anything of the program is read. All three outlive it.
  // `quiet`: errors alone are shown.
  Reporter(Input& input, const v1::ProgramSetup& setup, Progress& progress, bool quiet = false);
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  void report(const std::vector<Diagnostic>& diagnostics);
  // No more will be found.
  void finish();

  // Whether an error was among them.
  [[nodiscard]] bool refused() const { return refused_; }
  [[nodiscard]] bool is_quiet() const { return quiet_; }
  [[nodiscard]] Progress& progress() { return progress_; }

 private:
  using Kind = std::pair<Severity, Code>;
  using Text = std::tuple<Severity, Code, std::string>;  // of a message, without its place

  void show(const Diagnostic& found);

  const Input& input_;
  SourceLines lines_;
  GivenSubprograms subprograms_;
  Writing writing_;
  bool in_colour_;
  bool quiet_;
  Progress& progress_;
  bool refused_ = false;
  std::map<Text, Counted> like_shown_{};
  std::vector<Text> order_{};  // as they were found first
  // Diagnostics beyond the limit of texts.
  std::map<Kind, Counted> of_other_texts_{};
};

}  // namespace trc::cli
