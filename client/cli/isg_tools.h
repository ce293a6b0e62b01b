#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "client/cli/tool_table.h"

namespace trc::cli {

// The list of tool data of ISG controls (Beckhoff TF5200): rows `wz[5].radius 54000`, in 0.1 um, or
// in 0.0001 inch where `wz[5].mass_einheit` is 1.
class IsgTools {
 public:
  explicit IsgTools(ToolTable& table) : table_(table) {}

  [[nodiscard]] static bool is_row(std::string_view line);
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  // Reads a row. Returns its fault; empty: there is none.
  std::string read(std::string_view line);
  // Adds the milling tools of all rows to the table.
  void take_tools();

 private:
  struct Tool {
    std::optional<double> radius{};
    bool inch = false;
    bool is_left_out = false;  // no milling tool, or no valid one
  };

  std::string read_field(Tool& tool, std::uint32_t number, const std::string& field, double value);

  ToolTable& table_;
  bool has_begun_ = false;
  std::map<std::uint32_t, Tool> tools_{};
  std::set<std::string> seen_{};  // names of rows, in capitals
};

}  // namespace trc::cli
