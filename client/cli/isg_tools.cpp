#include "client/cli/isg_tools.h"

#include <algorithm>
#include <cmath>

#include "client/cli/table_text.h"
#include "core/base/ascii.h"
#include "core/base/length_unit.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

constexpr std::string_view head = "WZ[";
constexpr std::string_view blanks = " \t\r";

}  // namespace

bool IsgTools::is_row(std::string_view line) { return in_upper_case(line).starts_with(head); }

std::string IsgTools::read(std::string_view line) {
  has_begun_ = true;
  line = trimmed(line.substr(0, line.find('#')), blanks);
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const std::string name = in_upper_case(line.substr(0, end));
  const std::string_view given = trimmed(line.substr(end), blanks);
  const std::size_t close = std::min(name.find(']'), name.size());
  const auto number =
      tool_number(number_from(std::string_view(name).substr(head.size(), close - head.size())));
  if (!number || name.compare(close, 2, "].") != 0)
    return "\"" + std::string(line.substr(0, end)) + "\" names no tool, as in wz[1].radius";
  if (!seen_.insert(name).second) return std::string(line.substr(0, end)) + " a second time";
  const std::string field = name.substr(close + 2);
  const bool matters = field == "RADIUS" || field == "MASS_EINHEIT" || field == "GUELTIG" ||
                       field == "TYP" || field.starts_with("TOOL_ID.") ||
                       (field.starts_with("PATH[") && field.ends_with("].RADIUS"));
  if (!matters) return {};
  const auto value = number_from(given);
  if (!value || *value != std::floor(*value))
    return std::string(line.substr(0, end)) + " is \"" + std::string(given) +
           "\", which is no whole number";
  return read_field(tools_[*number], *number, field, *value);
}

std::string IsgTools::read_field(Tool& tool, std::uint32_t number, const std::string& field,
                                 double value) {
  const std::string name = "wz[" + std::to_string(number) + "]";
  if (field == "RADIUS") {
    tool.radius = value;
  } else if (field == "MASS_EINHEIT") {
    if (value != 0 && value != 1) return name + ".mass_einheit is neither 0 (mm) nor 1 (inch)";
    tool.inch = value == 1;
  } else if (field == "GUELTIG") {
    tool.is_left_out |= value == 0;
  } else if (field == "TYP") {
    tool.is_left_out |= value != 0;
  } else if (field.starts_with("PATH[")) {
    if (value != 0) return name + " has a radius for each path, and one is read";
  } else if (value != 0 && !(field == "TOOL_ID.BASIC" && value == number)) {
    return name + " has another number by its tool_id: give such tools as a CSV";
  }
  return {};
}

void IsgTools::take_tools() {
  constexpr double per_unit = 1e4;
  for (const auto& [number, tool] : tools_)
    // D0 selects no tool, whatever the list says of it.
    if (number != 0 && tool.radius && !tool.is_left_out)
      table_.add({.number = number},
                 {.radius = *tool.radius / per_unit * (tool.inch ? mm_per_inch : 1)});
}

}  // namespace trc::cli
