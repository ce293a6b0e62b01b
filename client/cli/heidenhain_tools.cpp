#include "client/cli/heidenhain_tools.h"

#include <algorithm>

#include "client/cli/table_text.h"
#include "core/base/ascii.h"
#include "core/base/length_unit.h"
#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

// The columns are counted in characters.
std::size_t byte_of_character(std::string_view line, std::size_t character) {
  if (!is_utf8(line)) return std::min(character, line.size());
  std::size_t byte = 0;
  for (; character > 0 && byte < line.size(); --character)
    byte += utf8_character(line.substr(byte));
  return byte;
}

bool is_blank(char sign) { return sign == ' ' || sign == '\r'; }

// The places of the columns separate them: a comma is a decimal point.
std::optional<double> length_from(std::string_view cell) {
  std::string number(cell);
  std::ranges::replace(number, ',', '.');
  return number_from(number);
}

// Where the name of the table ends, such as TOOL    .T; npos: nowhere.
std::size_t end_of_name(std::string_view line) {
  constexpr std::string_view type = ".T";
  for (std::size_t at = line.find(type); at != std::string_view::npos; at = line.find(type, at + 1))
    if (at + type.size() == line.size() || is_blank(line[at + type.size()]))
      return at + type.size();
  return std::string_view::npos;
}

}  // namespace

bool HeidenhainTools::begins_with(std::string_view line) {
  return line.starts_with("BEGIN ") && end_of_name(line) != std::string_view::npos;
}

std::string HeidenhainTools::begin(std::string_view line) {
  has_begun_ = true;
  const std::string_view after = trimmed(line.substr(end_of_name(line)), " \t\r");
  const std::string_view word = after.substr(0, after.find(' '));
  if (word != "MM" && word != "INCH")
    return "its first line has neither MM nor INCH after the name of the table";
  unit_ = word == "INCH" ? mm_per_inch : 1;
  return {};
}

std::string HeidenhainTools::read_columns(std::string_view line) {
  for (std::size_t at = line.find_first_not_of(" \t\r"); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(" \t\r", at), line.size());
    columns_.emplace_back(in_upper_case(line.substr(at, end - at)), at);
    at = line.find_first_not_of(" \t\r", end);
  }
  for (const char* name : {"T", "R"})
    if (!column_of(name)) return std::string("the table has no column ") + name;
  return {};
}

std::string HeidenhainTools::read(std::string_view line) {
  if (without_quotes(line).find('\t') != std::string_view::npos)
    return "it has tabs, and columns are found by their place: replace each with blanks, or make "
           "it a CSV";
  if (columns_.empty()) return read_columns(line);
  for (const char* name : {"T", "NAME", "R", "DR"})
    if (!lines_up(line, name))
      return std::string("its values do not begin below the name of column ") + name +
             ": restore the blanks between the columns, or make it a CSV";
  const std::string_view place = cell(line, "T");
  const auto number = tool_number(number_from(place.substr(0, place.find('.'))));
  // 5.2 is the second index of tool 5.
  const auto index = place.find('.') < place.size()
                         ? tool_number(number_from(place.substr(place.find('.') + 1)))
                         : std::optional<std::uint32_t>(0);
  if (!number || !index) return "T is no number of a tool";
  const std::string_view name = cell(line, "NAME");
  if (!name.empty() && *index == 0) table_.name(*number, in_capitals_as_utf8(name));
  const std::string_view radius = cell(line, "R");
  const std::string_view wear = cell(line, "DR");
  // An empty place in the magazine.
  if (radius.empty() && wear.empty()) return {};
  const auto read_radius = length_from(radius);
  const auto read_wear = wear.empty() ? std::optional(0.0) : length_from(wear);
  if (!read_radius || !read_wear)
    return (read_radius ? "DR is \"" + std::string(wear) : "R is \"" + std::string(radius)) +
           "\", which is no number";
  return table_.take({.number = *number, .edge = *index + 1},
                     {.radius = *read_radius * unit_, .wear = *read_wear * unit_});
}

std::optional<std::size_t> HeidenhainTools::column_of(std::string_view name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].first == name) return i;
  return std::nullopt;
}

bool HeidenhainTools::lines_up(std::string_view line, std::string_view name) const {
  const auto column = column_of(name);
  if (!column) return true;
  const auto is_cut = [&](std::size_t at) {
    if (at >= columns_.size()) return false;
    const std::size_t begin = byte_of_character(line, columns_[at].second);
    // A sign begins a number: a name may fill its column up to it.
    return begin > 0 && begin < line.size() && !is_blank(line[begin - 1]) &&
           !is_blank(line[begin]) && line[begin] != '+' && line[begin] != '-';
  };
  if (is_cut(*column) || is_cut(*column + 1)) return false;
  const std::size_t begin = byte_of_character(line, columns_[*column].second);
  const bool begins_late =
      begin < line.size() && is_blank(line[begin]) && !cell(line, name).empty();
  // Nothing stands before the numbers of the tools: they may be aligned to the right.
  return !begins_late || name == "T";
}

std::string_view HeidenhainTools::cell(std::string_view line, std::string_view name) const {
  const auto column = column_of(name);
  if (!column) return {};
  const std::size_t begin = byte_of_character(line, columns_[*column].second);
  const std::size_t end = *column + 1 < columns_.size()
                              ? byte_of_character(line, columns_[*column + 1].second)
                              : line.size();
  return without_quotes(line.substr(begin, end - begin));
}

}  // namespace trc::cli
