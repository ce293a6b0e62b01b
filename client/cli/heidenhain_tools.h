#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/cli/tool_table.h"

namespace trc::cli {

// TOOL.T of Heidenhain: the first line names the columns, each cell begins below its name.
class HeidenhainTools {
 public:
  explicit HeidenhainTools(ToolTable& table) : table_(table) {}

  // Whether the line, in capitals, is the one such a file begins with.
  [[nodiscard]] static bool begins_with(std::string_view line);
  // That line, which says what the lengths count in. Returns its fault; empty: there is none.
  std::string begin(std::string_view line);
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  [[nodiscard]] bool has_columns() const { return !columns_.empty(); }
  // The line as it stands in the file: leading blanks count. What is wrong with it; empty:
  // nothing.
  std::string read(std::string_view line);

 private:
  std::string read_columns(std::string_view line);
  [[nodiscard]] std::optional<std::size_t> column_of(std::string_view name) const;
  // Whether the value of this column begins below its name and is not cut where a column begins.
  [[nodiscard]] bool lines_up(std::string_view line, std::string_view name) const;
  [[nodiscard]] std::string_view cell(std::string_view line, std::string_view name) const;

  ToolTable& table_;
  bool has_begun_ = false;
  double unit_ = 1;                                             // mm
  std::vector<std::pair<std::string, std::size_t>> columns_{};  // name and start
};

}  // namespace trc::cli
