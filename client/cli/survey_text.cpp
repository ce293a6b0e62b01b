#include "client/cli/survey_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "client/cli/fixed_text.h"
#include "core/base/text_width.h"

namespace trc::cli {
struct SurveyText::Words {
  std::array<const char*, column_count> head;
  const char* block;
  const char* line;
  const char* both;
  const char* refused;
  const char* at_line;
  const char* too_near;
  const char* reaches_all;
  const char* leaves_out;
  const char* of_wall_uncut;
  const char* if_removed;
  const char* all_before;
  const char* all_behind;
  const char* limited_by;
  const char* none;
  const char* is_largest;
};

constexpr SurveyText::Words SurveyText::english{
    .head = {"radius", "tool", "result", "masked", "clearance", "uncut", "path", "in the way"},
    .block = "block ",
    .line = "line ",
    .both = " and ",
    .refused = "refused ",
    .at_line = " at line ",
    .too_near = "too near",
    .reaches_all = "reaches all",
    .leaves_out = "leaves out",
    .of_wall_uncut = " of wall uncut",
    .if_removed = " if loops are removed",
    .all_before = "every radius up to ",
    .all_behind = " fits",
    .limited_by = ", limited by ",
    .none = "no radius reaches every wall",
    .is_largest = " is the largest radius that reaches every wall",
};

constexpr SurveyText::Words SurveyText::german{
    .head = {"Radius", "Werkzeug", "Ergebnis", "ausgeblendet", "Abstand", "Rest", "Bahn", "im Weg"},
    .block = "Satz ",
    .line = "Zeile ",
    .both = " und ",
    .refused = "abgelehnt ",
    .at_line = " in Zeile ",
    .too_near = "zu nah",
    .reaches_all = "erreicht alles",
    .leaves_out = "lässt aus",
    .of_wall_uncut = " Wand bleiben stehen",
    .if_removed = ", wenn Schleifen entfernt werden",
    .all_before = "jeder Radius bis ",
    .all_behind = " passt",
    .limited_by = ", begrenzt durch ",
    .none = "kein Radius erreicht alle Wände",
    .is_largest = " ist der größte Radius, der alle Wände erreicht",
};

SurveyText::SurveyText(Language language, LengthUnit unit, const ToolNames& names)
    : words_(language == Language::german ? german : english), unit_(unit), names_(names) {}

std::string SurveyText::length(double mm) const { return length_in(unit_, mm, 3); }
std::string SurveyText::with_unit(double mm) const { return length(mm) + name_of_unit(unit_); }

std::string SurveyText::name_of(const v1::SurveyPlace& place) const {
  if (place.line() == 0) return words_.block + std::to_string(place.source_index());
  return words_.line + std::to_string(place.line()) +
         (place.has_source_number() ? " (N" + std::to_string(place.source_number()) + ")" : "");
}

template <class Places>
std::string SurveyText::names_of(const Places& places) const {
  std::string text;
  for (const v1::SurveyPlace& place : places)
    text += (text.empty() ? "" : words_.both) + name_of(place);
  return text;
}

std::string SurveyText::outcome_of(const v1::SurveyedRadius& found) const {
  if (!found.accepted()) {
    const v1::Diagnostic& why = found.refusal();
    return words_.refused + std::to_string(why.code()) +
           (why.line() > 0 ? words_.at_line + std::to_string(why.line()) : "");
  }
  if (found.certificate().blocks_gouging() > 0) return words_.too_near;
  return found.reaches_every_wall() ? words_.reaches_all : words_.leaves_out;
}

SurveyText::Row SurveyText::row_of(const v1::SurveyedRadius& found) const {
  const bool done = found.accepted();
  const bool measured = found.has_certificate();
  return {length(found.radius()),
          names_.of(found.radius()),
          outcome_of(found),
          done ? fixed(100 * found.masked_share(), 1) + " %" : "-",
          measured ? length(found.certificate().clearance()) : "-",
          found.has_uncut_length() ? length(found.uncut_length()) : "-",
          done ? length(found.compensated_length()) : "-",
          names_of(found.limits())};
}

void ToolNames::add(double radius, std::uint32_t number) {
  std::string& name = names_[radius];
  name += (name.empty() ? "T" : " T") + std::to_string(number);
}

std::string ToolNames::of(double radius) const {
  const auto found = names_.find(radius);
  return found == names_.end() ? std::string() : found->second;
}

std::string SurveyText::table_of(const v1::SurveyAnswer& answer) const {
  Row head;
  std::copy(words_.head.begin(), words_.head.end(), head.begin());
  head[0] += unit_ == LengthUnit::inch ? ", in" : ", mm";
  if (names_.empty()) head[1].clear();
  std::vector<Row> rows{head};
  for (const v1::SurveyedRadius& found : answer.radii()) rows.push_back(row_of(found));
  std::array<std::size_t, column_count> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < column_count; ++i)
      widths[i] = std::max(widths[i], width_of(row[i]));
  // Words are aligned left, numbers right.
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

std::string SurveyText::legend_of(const v1::SurveyedRadius& found) const {
  std::string text = "R " + length(found.radius());
  if (const std::string name = names_.of(found.radius()); !name.empty()) text += " (" + name + ")";
  text += ": " + outcome_of(found);
  if (found.has_uncut_length())
    text += ", " + with_unit(found.uncut_length()) + words_.of_wall_uncut;
  if (found.uncut_by_removal()) text += words_.if_removed;
  return text;
}

std::string SurveyText::sentence_of(const v1::LargestRadius& largest) const {
  if (!largest.is_limited())
    return words_.all_before + with_unit(largest.radius()) + words_.all_behind;
  const std::string limits = names_of(largest.limits());
  const std::string by = limits.empty() ? std::string() : words_.limited_by + limits;
  if (largest.radius() == 0) return words_.none + by;
  return with_unit(largest.radius()) + words_.is_largest + by;
}

}  // namespace trc::cli
