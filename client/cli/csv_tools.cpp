#include "client/cli/csv_tools.h"

#include <algorithm>
#include <array>

#include "client/cli/table_text.h"
#include "core/base/length_unit.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

constexpr char comma = ',';
constexpr char semicolon = ';';
constexpr std::array<std::string_view, 8> known_columns{"NUMBER", "RADIUS", "DIAMETER", "WEAR",
                                                        "NAME",   "EDGE",   "HOLDS",    "UNIT"};

std::string column_named(std::string_view name) {
  std::string column = in_upper_case(name);
  return column == "TOOL" || column == "T" ? "NUMBER" : column;
}

bool is_header(const std::vector<std::string>& cells) {
  return std::ranges::any_of(cells, [](std::string_view name) {
    const std::string column = column_named(name);
    return column == "NUMBER" || column == "NAME";
  });
}

std::string unknown_column(std::string_view name) {
  return "unknown column \"" + std::string(name) +
         "\"; a table may have number, radius, diameter, wear, name, edge, holds, unit";
}

std::optional<double> unit_named(std::string_view name) {
  if (in_upper_case(name) == "MM") return 1;
  if (in_upper_case(name) == "INCH") return mm_per_inch;
  return {};
}

std::string unknown_unit(std::string_view name) {
  return "unit is \"" + std::string(name) + "\", not mm or inch";
}

}  // namespace

std::optional<std::string> CsvTools::begin(std::string_view line) {
  separator_ = line.find(semicolon) < line.find(comma) ? semicolon : comma;
  const auto [cells, fault] = csv_cells(line, separator_);
  if (is_header(cells)) return fault.empty() ? read_header(cells) : fault;
  if (cells.size() < 2 || in_upper_case(cells[0]) != "UNIT") return std::nullopt;
  unit_ = unit_named(cells[1]);
  return unit_ ? std::string() : unknown_unit(cells[1]);
}

std::string CsvTools::read_header(const std::vector<std::string>& cells) {
  for (const std::string& name : cells) columns_.push_back(column_named(name));
  const auto has = [&](std::string_view wanted) {
    return std::ranges::find(columns_, wanted) != columns_.end();
  };
  for (const std::string& column : columns_) {
    if (column.empty()) continue;
    if (std::ranges::find(known_columns, column) == known_columns.end())
      return unknown_column(column);
    if (std::ranges::count(columns_, column) > 1) return "column " + column + " a second time";
  }
  if (!(has("NUMBER") || has("NAME")) || has("RADIUS") == has("DIAMETER"))
    return "the header needs number or name, and one of radius, diameter";
  return {};
}

// If semicolons separate the columns, a comma is a decimal point.
std::optional<double> CsvTools::number_in(std::string_view cell) const {
  std::string number(cell);
  if (separator_ == semicolon) std::ranges::replace(number, ',', '.');
  return number_from(number);
}

std::string CsvTools::read(std::string_view line) {
  const auto [cells, fault] = csv_cells(line, separator_);
  if (!fault.empty()) return fault;
  // A decimal comma splits a number into two cells, and only the first would count.
  for (std::size_t i = columns_.size(); i < cells.size(); ++i)
    if (!cells[i].empty())
      return "it has more values than the header; decimals have a point, or semicolons stand "
             "between the values";
  Row row{.unit = unit_.value_or(1)};
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string_view cell = i < cells.size() ? cells[i] : std::string_view();
    if (std::string wrong = read_cell(columns_[i], cell, row); !wrong.empty()) return wrong;
  }
  const auto tool = row.number ? tool_number(row.number) : std::optional<std::uint32_t>(0);
  if (!tool) return "number is no number of a tool";
  if (!row.number && row.name.empty()) return "the tool has neither number nor name";
  const bool has_both = row.number && !row.name.empty();
  if (has_both) table_.name(*tool, row.name);
  const double factor = row.unit * (row.diameter ? 0.5 : 1);
  return table_.take({.number = *tool, .name = has_both ? "" : row.name, .edge = row.edge},
                     {.radius = factor * row.value, .wear = factor * row.wear});
}

std::string CsvTools::read_cell(const std::string& column, std::string_view cell, Row& row) const {
  if (column.empty()) {
    if (!cell.empty())
      return '"' + std::string(cell) +
             "\" stands in a column that has no name; decimals have a point, or semicolons stand "
             "between the values";
  } else if (column == "NAME") {
    row.name = in_capitals_as_utf8(cell);
  } else if (column == "EDGE") {
    const auto given =
        cell.empty() ? std::optional<std::uint32_t>(1) : tool_number(number_from(cell));
    if (!given || *given == 0) return "edge is \"" + std::string(cell) + "\", which is none";
    row.edge = *given;
  } else if (column == "UNIT") {
    const auto named = unit_named(cell);
    if (!named && !cell.empty()) return unknown_unit(cell);
    row.unit = named.value_or(row.unit);
  } else if (column == "HOLDS") {
    const std::string holds = in_upper_case(cell);
    if (!holds.empty() && holds != "RADIUS" && holds != "DIAMETER")
      return "holds is \"" + holds + "\", not RADIUS or DIAMETER";
    row.diameter |= holds == "DIAMETER";
  } else {
    return read_number(column, cell, row);
  }
  return {};
}

std::string CsvTools::read_number(const std::string& column, std::string_view cell,
                                  Row& row) const {
  if (column == "NUMBER" && cell.empty()) return {};  // the name identifies the tool
  const auto read = number_in(cell);
  if (!read && !(column == "WEAR" && cell.empty()))
    return column + " is \"" + std::string(cell) + "\", which is no number";
  if (column == "NUMBER") row.number = read;
  if (column == "WEAR") row.wear = read.value_or(0);
  if (column == "RADIUS" || column == "DIAMETER") row.value = *read;
  row.diameter |= column == "DIAMETER";
  return {};
}

bool CsvTools::unit_unsaid() const {
  return !unit_ && std::ranges::find(columns_, "UNIT") == columns_.end();
}

}  // namespace trc::cli
