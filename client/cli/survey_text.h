#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/base/language.h"
#include "core/base/length_unit.h"
#include "trc/v1/http.pb.h"
#include "trc/v1/survey.pb.h"

namespace trc::cli {

// The names of the tools with each radius.
class ToolNames {
 public:
  void add(double radius, std::uint32_t number);
  // "T1 T7"; empty: none.
  [[nodiscard]] std::string of(double radius) const;
  [[nodiscard]] bool empty() const { return names_.empty(); }

 private:
  std::map<double, std::string> names_;
};

// The findings of a survey in words, in a language and in the unit of the program.
class SurveyText {
 public:
  SurveyText(Language language, LengthUnit unit, const ToolNames& names);

  // A line for each radius, and the largest one.
  [[nodiscard]] std::string table_of(const v1::SurveyAnswer& answer) const;

  // One radius in a few words, for the legend of a picture.
  [[nodiscard]] std::string legend_of(const v1::SurveyedRadius& found) const;

  // "5.250 mm is the largest radius that reaches every wall, limited by line 7 (N70) and line 9".
  [[nodiscard]] std::string sentence_of(const v1::LargestRadius& largest) const;

 private:
  struct Words;
  static const Words english;
  static const Words german;
  static constexpr std::size_t column_count = 8;
  using Row = std::array<std::string, column_count>;

  // In the unit of the program, with three decimals of mm or four of inch.
  [[nodiscard]] std::string length(double mm) const;
  [[nodiscard]] std::string with_unit(double mm) const;
  [[nodiscard]] std::string name_of(const v1::SurveyPlace& place) const;
  template <class Places>
  [[nodiscard]] std::string names_of(const Places& places) const;
  [[nodiscard]] std::string outcome_of(const v1::SurveyedRadius& found) const;
  [[nodiscard]] Row row_of(const v1::SurveyedRadius& found) const;

  const Words& words_;
  const LengthUnit unit_;
  const ToolNames& names_;
};

}  // namespace trc::cli
