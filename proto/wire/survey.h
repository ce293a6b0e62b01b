#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/survey/survey.h"
#include "proto/wire/field_fault.h"
#include "proto/wire/setup.h"
#include "trc/v1/survey.pb.h"

namespace trc::wire {

// What is asked about a program or a path.
struct SurveySettings {
  ProgramSettings program{};  // of a path its `path` alone
  bool is_path = false;
  std::vector<double> radii{};  // mm
  bool wants_largest = true;
  bool wants_uncut = false;
};

[[nodiscard]] SurveySettings from_proto(const v1::SurveySetup& message, const FieldPath& path,
                                        FieldFaults& faults);

// "3,5,8" or "3:8:0.5", from, to and step; mm. What is wrong with the text instead.
[[nodiscard]] std::string read_radii(std::string_view text, v1::SurveySetup& setup);

// Each replaces the content of the message.
void to_proto(const survey::Surveyed& found, v1::SurveyedRadius& message);
void to_proto(const survey::Largest& found, v1::LargestRadius& message);

}  // namespace trc::wire
