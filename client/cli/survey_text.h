#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "trc/v1/http.pb.h"
#include "trc/v1/survey.pb.h"

namespace trc::cli {

// Which tools of a table have a radius.
class ToolNames {
 public:
  void add(double radius, std::uint32_t number);
  // "T1 T7"; empty: none.
  [[nodiscard]] std::string of(double radius) const;
  [[nodiscard]] bool empty() const { return names_.empty(); }

 private:
  std::map<double, std::string> names_;
};

// What was found, a line for each radius, and the largest one.
[[nodiscard]] std::string table_of(const v1::SurveyAnswer& answer, const ToolNames& names);

// One radius in a few words, for the legend of a picture.
[[nodiscard]] std::string legend_of(const v1::SurveyedRadius& found, const ToolNames& names);

// "5.25 mm is the largest radius that reaches every wall, limited by line 7 (N70) and line 9".
[[nodiscard]] std::string sentence_of(const v1::LargestRadius& largest);

}  // namespace trc::cli
