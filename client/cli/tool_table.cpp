#include "client/cli/tool_table.h"

namespace trc::cli {
namespace {

std::string text_of(const ToolKey& key) {
  const std::string tool = key.name.empty() ? std::to_string(key.number) : "\"" + key.name + "\"";
  return "tool " + tool + (key.edge == 1 ? "" : ", edge " + std::to_string(key.edge));
}

}  // namespace

std::string ToolTable::take(const ToolKey& key, const ToolSizes& sizes) {
  return tools_.try_emplace(key, sizes).second ? std::string() : text_of(key) + " a second time";
}

ToolSizes& ToolTable::sizes_of(const ToolKey& key) {
  return tools_.try_emplace(key, ToolSizes{.has_radius = false}).first->second;
}

std::string ToolTable::write(v1::ProgramSetup& setup) const {
  for (const auto& [key, sizes] : tools_) {
    if (!sizes.has_radius) return text_of(key) + " has wear, but no radius";
    v1::Tool& tool = *setup.add_tools();
    tool.set_number(key.number);
    const auto name = names_.find(key.number);
    if (!key.name.empty() || name != names_.end())
      tool.set_name(key.name.empty() ? name->second : key.name);
    if (key.edge != 1) tool.set_edge(key.edge);
    tool.set_radius(sizes.radius);
    tool.set_wear(sizes.wear);
  }
  return {};
}

}  // namespace trc::cli
