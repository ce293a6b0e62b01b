#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/cli/tool_table.h"

namespace trc::cli {

// The rows of a CSV of tools, below the header that names their columns.
class CsvTools {
 public:
  explicit CsvTools(ToolTable& table) : table_(table) {}

  // Reads a line up to the header: it gives the unit of all rows, or is the header. Nothing: it is
  // neither; else its fault, empty for none.
  [[nodiscard]] std::optional<std::string> begin(std::string_view line);
  [[nodiscard]] bool has_header() const { return !columns_.empty(); }
  // Reads a row. Returns its fault; empty: there is none.
  std::string read(std::string_view line);
  // Neither the rows nor a line above them name their unit.
  [[nodiscard]] bool unit_unsaid() const;

 private:
  // The data of a tool in a row.
  struct Row {
    std::optional<double> number{};
    std::string name{};
    std::uint32_t edge = 1;
    double value = 0;
    double wear = 0;
    bool diameter = false;
    double unit = 1;
  };

  std::string read_header(const std::vector<std::string>& cells);
  std::string read_cell(const std::string& column, std::string_view cell, Row& row) const;
  std::string read_number(const std::string& column, std::string_view cell, Row& row) const;
  [[nodiscard]] std::optional<double> number_in(std::string_view cell) const;

  ToolTable& table_;
  std::optional<double> unit_{};  // of all rows
  std::vector<std::string> columns_{};
  char separator_ = ',';  // as the first line has it
};

}  // namespace trc::cli
