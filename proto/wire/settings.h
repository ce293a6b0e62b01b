#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trc/v1/setup.pb.h"

namespace trc::wire {

// Applies one "key=value" to the setup. Keys are the names of the fields of
// PathSetup, with "." into a field of fields (`options.stretch_factor`); the last
// part alone will do where it is the only one of that name. `block_skip`, `pass_words`, `encoding`,
// `renumber` and `max_executed_lines` are those of ProgramSetup, `tools` the tool table,
// "1:5,2:3.5" (D word: radius in mm; after it may follow the wear, "1:5:-0.02"), `variables` what
// variables hold, "#500=12.5,#501=3".
//
// Values: numbers; true, false, 1, 0, on, off; a word of an enum without its
// prefix, or the G function it stands for (`selection_mode=G239`); "x,y,z" for a
// position; names with commas between for a list.
//
// Returns what is wrong, as a sentence; empty when the field is set. Whether a
// value lies in its range is the service's business.
[[nodiscard]] std::string apply_setting(std::string_view assignment, v1::ProgramSetup& setup);

// The whole key of a setting, where it is one of PathSetup: `options.stretch_factor` of
// `stretch_factor`. Other keys are given back as they are, in lower case.
[[nodiscard]] std::string whole_key(std::string_view key);

// The settings that somebody has given: one that comes twice, under any of its names, says two
// things, and which of them was meant nobody knows.
class GivenSettings {
 public:
  // Returns what is wrong with one more, as a sentence; empty: nothing is.
  [[nodiscard]] std::string take(std::string_view key);

 private:
  std::vector<std::string> keys_;
};

// Enters what a variable of a program that computes holds, "NAME=VALUE". Returns what is wrong, as
// a sentence; empty when it is entered. None is entered twice.
[[nodiscard]] std::string apply_variable(std::string_view assignment, v1::ProgramSetup& setup);

// What the setup holds, as apply_setting takes it, in the order of the fields: "tool_radius=5". The
// tool table is the last.
[[nodiscard]] std::vector<std::string> assignments_of(const v1::ProgramSetup& setup);

// Every key with what it takes, in the order of the fields.
struct SettingRow {
  std::string key;
  std::string values;
};
[[nodiscard]] std::vector<SettingRow> settings();

}  // namespace trc::wire
