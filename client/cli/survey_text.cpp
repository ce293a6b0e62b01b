#include "client/cli/survey_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

constexpr std::size_t column_count = 8;
using Row = std::array<std::string, column_count>;

std::string fixed(double value, int decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}
std::string mm(double value) { return fixed(value, 3); }

std::string name_of(const v1::SurveyPlace& place) {
  if (place.line() == 0) return "block " + std::to_string(place.source_index());
  return "line " + std::to_string(place.line()) +
         (place.has_source_number() ? " (N" + std::to_string(place.source_number()) + ")" : "");
}

template <class Places>
std::string names_of(const Places& places) {
  std::string text;
  for (const v1::SurveyPlace& place : places)
    text += (text.empty() ? "" : " and ") + name_of(place);
  return text;
}

std::string outcome_of(const v1::SurveyedRadius& found) {
  if (!found.accepted()) {
    const v1::Diagnostic& why = found.refusal();
    return "refused " + std::to_string(why.code()) +
           (why.line() > 0 ? " at line " + std::to_string(why.line()) : "");
  }
  if (found.certificate().blocks_gouging() > 0) return "too near";
  if (found.reaches_every_wall()) return "reaches all";
  return "leaves out";
}

Row row_of(const v1::SurveyedRadius& found, const ToolNames& names) {
  const bool done = found.accepted();
  const bool measured = found.has_certificate();
  return {mm(found.radius()),
          names.of(found.radius()),
          outcome_of(found),
          done ? fixed(100 * found.masked_share(), 1) + " %" : "-",
          measured ? mm(found.certificate().clearance()) : "-",
          found.has_uncut_length() ? mm(found.uncut_length()) : "-",
          done ? mm(found.compensated_length()) : "-",
          names_of(found.limits())};
}

// Its width on the screen: letters of more than one byte count once.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char letter) {
    return (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U;
  }));
}

}  // namespace

void ToolNames::add(double radius, std::uint32_t number) {
  std::string& name = names_[radius];
  name += (name.empty() ? "T" : " T") + std::to_string(number);
}

std::string ToolNames::of(double radius) const {
  const auto found = names_.find(radius);
  return found == names_.end() ? std::string() : found->second;
}

std::string table_of(const v1::SurveyAnswer& answer, const ToolNames& names) {
  std::vector<Row> rows{{"radius", names.empty() ? "" : "tool", "result", "masked", "clearance",
                         "uncut", "path", "in the way"}};
  for (const v1::SurveyedRadius& found : answer.radii()) rows.push_back(row_of(found, names));
  std::array<std::size_t, column_count> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < column_count; ++i)
      widths[i] = std::max(widths[i], width_of(row[i]));
  // Words stand at the left, numbers at the right.
  constexpr std::array<bool, column_count> is_text{false, true,  true,  false,
                                                   false, false, false, true};
  std::string text;
  if (rows.size() > 1)
    for (const Row& row : rows) {
      std::string line;
      for (std::size_t i = 0; i < column_count; ++i) {
        if (widths[i] == 0) continue;
        const std::string blanks(widths[i] - width_of(row[i]), ' ');
        line += (line.empty() ? "" : "  ") + (is_text[i] ? row[i] + blanks : blanks + row[i]);
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  if (answer.summary().has_largest()) text += sentence_of(answer.summary().largest()) + "\n";
  return text;
}

std::string legend_of(const v1::SurveyedRadius& found, const ToolNames& names) {
  std::string text = "R " + mm(found.radius());
  if (const std::string name = names.of(found.radius()); !name.empty()) text += " (" + name + ")";
  text += ": " + outcome_of(found);
  if (found.has_uncut_length()) text += ", " + mm(found.uncut_length()) + " mm of wall uncut";
  if (found.uncut_by_removal()) text += " if loops are removed";
  return text;
}

std::string sentence_of(const v1::LargestRadius& largest) {
  if (!largest.is_limited()) return "every radius up to " + mm(largest.radius()) + " mm fits";
  const std::string limits = names_of(largest.limits());
  const std::string by = limits.empty() ? std::string() : ", limited by " + limits;
  if (largest.radius() == 0) return "no radius reaches every wall" + by;
  return mm(largest.radius()) + " mm is the largest radius that reaches every wall" + by;
}

}  // namespace trc::cli
