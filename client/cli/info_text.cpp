#include "client/cli/info_text.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "core/nc/dialect/dialect.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

using Row = std::vector<std::string>;

// The first row holds the headings.
struct Table {
  std::vector<Row> rows;
};

std::string number(double value) {
  std::string text;
  append_units(text, to_units(value, 6), 6);
  return text;
}

std::string severity_word(v1::Diagnostic::Severity severity) {
  switch (severity) {
    case v1::Diagnostic::NOTE:
      return "note";
    case v1::Diagnostic::WARNING:
      return "warning";
    default:
      return "error";
  }
}

// Nothing for words that take no number.
std::string range_of(const v1::TrcKeyword& keyword) {
  if (keyword.min() == keyword.max()) return "";
  return number(keyword.min()) + " … " + number(keyword.max()) +
         (keyword.unit().empty() ? "" : " " + keyword.unit());
}

Table options_of(const v1::GetServerInfoResponse& info) {
  Table table{{{"Option", "Range", "Default", "Available", "Meaning"}}};
  for (const v1::TrcKeyword& keyword : info.trc_keywords())
    table.rows.push_back({keyword.name(), range_of(keyword),
                          range_of(keyword).empty() ? "" : number(keyword.default_value()),
                          keyword.available() ? "yes" : "no, refused", keyword.meaning()});
  return table;
}

Table functions_of(const v1::GetServerInfoResponse& info) {
  Table table{{{"Function", "Group", "Initial", "Meaning"}}};
  for (const v1::GFunction& function : info.g_functions())
    table.rows.push_back(
        {function.name(), function.group(), function.initial() ? "yes" : "", function.meaning()});
  return table;
}

Table diagnostics_of(const v1::GetServerInfoResponse& info) {
  Table table{{{"Code", "Severity", "Cause", "Remedy"}}};
  for (const v1::DiagnosticRow& row : info.diagnostics())
    table.rows.push_back(
        {std::to_string(row.code()), severity_word(row.severity()), row.cause(), row.remedy()});
  return table;
}

Table limits_of(const v1::Limits& limits) {
  return {{{"Limit", "Value"},
           {"request message", std::to_string(limits.max_message_bytes()) + " bytes"},
           {"blocks in a batch", std::to_string(limits.max_blocks_per_batch())},
           {"batches in flight", std::to_string(limits.max_batches_in_flight())},
           {"blocks in a selection", std::to_string(limits.max_selection_blocks())},
           {"memory of all streams", std::to_string(limits.max_memory_bytes()) + " bytes"},
           {"streams of a connection", std::to_string(limits.max_streams_per_connection())},
           {"streams of the server", std::to_string(limits.max_streams())},
           {"line of NC text", std::to_string(limits.max_line_bytes()) + " bytes"},
           {"idle stream", std::to_string(limits.idle_timeout_seconds()) + " s"},
           {"coordinate", number(limits.max_coordinate()) + " mm"}}};
}

Table radius_terms_of(const v1::GetServerInfoResponse& info) {
  Table table{{{"Term", "Range", "Default", "Meaning"}}};
  for (const v1::RadiusTerm& term : info.radius_terms())
    table.rows.push_back({term.name(), number(term.min()) + " … " + number(term.max()) + " mm",
                          number(term.default_value()), term.meaning()});
  return table;
}

// Letters, not bytes: UTF-8 continuation bytes take no room.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string aligned(const Table& table) {
  std::vector<std::size_t> widths;
  for (const Row& row : table.rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const Row& row : table.rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i)
      line += " " + row[i] + std::string(widths[i] - width_of(row[i]) + 1, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string cell(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string markdown(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (const std::string& column : table.rows[i]) text += "| " + cell(column) + " ";
    text += "|\n";
    if (i > 0) continue;
    for (std::size_t column = 0; column < table.rows[0].size(); ++column) text += "|---";
    text += "|\n";
  }
  return text;
}

// What becomes of a function while TRC is off.
std::string_view state_of(const GFunction& function) {
  constexpr int inverse_time = 93;
  switch (function.group) {
    case GGroup::technology:
    case GGroup::axis_technology:
    case GGroup::dwell:
      return "passed on";
    case GGroup::feed_mode:
      return function.number == inverse_time ? "passed on while TRC is off" : "passed on";
    case GGroup::zero_shift:
    case GGroup::cycle:
    case GGroup::single_move:
    case GGroup::frame:
    case GGroup::tool_data:
    case GGroup::unfollowed:
    case GGroup::unfollowed_end:
      return "copied while TRC is off";
    case GGroup::call:
      return "resolved";
    case GGroup::turning:
    case GGroup::refused:
    case GGroup::spatial_circle:
      return "refused";
    default:
      return "followed";
  }
}

std::string name_of(const GFunction& function) {
  std::string name = "G" + std::to_string(function.number);
  if (function.tenth != 0) name += "." + std::to_string(function.tenth);
  return name;
}

Table dialects_of() {
  Table table{{{"Function"}}};
  std::map<int, std::map<DialectName, const GFunction*>> functions;
  for (const Dialect& dialect : all_dialects()) {
    if (!dialect.available) continue;
    table.rows.front().push_back(std::string(dialect.spelling));
    for (const GFunction& function : dialect.functions)
      functions[function.tenths()][dialect.name] = &function;
  }
  for (const auto& [tenths, known] : functions) {
    Row row{name_of(*known.begin()->second)};
    for (const Dialect& dialect : all_dialects()) {
      if (!dialect.available) continue;
      const auto found = known.find(dialect.name);
      row.push_back(found == known.end() ? std::string()
                                         : std::string(found->second->meaning) + ": " +
                                               std::string(state_of(*found->second)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::string markdown_dialects() { return markdown(dialects_of()); }

std::string text_of(const v1::GetServerInfoResponse& info) {
  std::string text = "trc " + info.version() + " (" + info.commit() + ")\n";
  if (!info.build().empty()) text += info.build() + "\n";
  text += "\nLimits\n" + aligned(limits_of(info.limits()));
  if (!info.radius_terms().empty())
    text += "\nThe tool radius, the sum of\n" + aligned(radius_terms_of(info));
  text += "\n#TRC options\n" + aligned(options_of(info));
  text += "\nG functions\n" + aligned(functions_of(info));
  text += "\nDiagnostics\n" + aligned(diagnostics_of(info));
  return text;
}

std::string markdown_options(const v1::GetServerInfoResponse& info) {
  return markdown(options_of(info));
}

std::string markdown_functions(const v1::GetServerInfoResponse& info) {
  return markdown(functions_of(info));
}

std::string markdown_diagnostics(const v1::GetServerInfoResponse& info) {
  return markdown(diagnostics_of(info));
}

}  // namespace trc::cli
