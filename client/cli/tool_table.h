#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "trc/v1/setup.pb.h"

namespace trc::cli {

// A tool by its number, or by its name alone, and which of its edges.
struct ToolKey {
  std::uint32_t number = 0;
  std::string name{};  // empty: the number tells
  std::uint32_t edge = 1;

  auto operator<=>(const ToolKey&) const = default;
};

struct ToolSizes {
  double radius = 0;  // mm
  double wear = 0;    // mm
  bool has_radius = true;

  bool operator==(const ToolSizes&) const = default;
};

// The tools of a table, whatever its format. Faults are returned as a sentence; empty: none.
class ToolTable {
 public:
  // A tool all of whose sizes stand in one row.
  std::string take(const ToolKey& key, const ToolSizes& sizes);
  // The sizes of a tool that stand in several lines, without a radius until one of them says it.
  ToolSizes& sizes_of(const ToolKey& key);
  // Adds the tool unless it is there already.
  void add(const ToolKey& key, const ToolSizes& sizes) { tools_.emplace(key, sizes); }
  // Of a tool with a number, in capitals.
  void name(std::uint32_t number, std::string in_capitals) {
    names_[number] = std::move(in_capitals);
  }

  [[nodiscard]] bool empty() const { return tools_.empty(); }
  std::string write(v1::ProgramSetup& setup) const;

 private:
  std::map<std::uint32_t, std::string> names_;  // of tools with numbers
  std::map<ToolKey, ToolSizes> tools_;
};

}  // namespace trc::cli
