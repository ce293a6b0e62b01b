#include "client/cli/info_text.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "client/cli/info_words.h"
#include "core/base/text_width.h"
#include "core/messages/german.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/text/number_format.h"
#include "proto/wire/german_settings.h"

namespace trc::cli {
namespace {

using Row = std::vector<std::string>;

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

std::string between(double least, double most, std::string_view unit) {
  return number(least) + " … " + number(most) + (unit.empty() ? "" : " ") + std::string(unit);
}

// Empty for words that take no number.
std::string range_of(const v1::TrcKeyword& keyword) {
  if (keyword.min() == keyword.max()) return "";
  return between(keyword.min(), keyword.max(), keyword.unit());
}

// For example of "options.split.axis", for the keyword AXIS.
std::string_view german_meaning_of_keyword(std::string name) {
  for (char& letter : name)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter + 'a' - 'A');
  const std::string_view meaning = wire::german_meaning_of("options." + name);
  return meaning.empty() ? wire::german_meaning_of("options.split." + name) : meaning;
}

// The tables of an answer, in one language.
class Tables {
 public:
  Tables(const v1::GetServerInfoResponse& info, Language language)
      : info_(info), german_(language == Language::german), language_(language) {}

  [[nodiscard]] std::string heading(std::string_view english) const {
    return cell_in(language_, english);
  }

  [[nodiscard]] Table limits() const {
    const v1::Limits& limits = info_.limits();
    Table table = headed({"Limit", "Value"});
    const auto add = [&](std::string_view name, const std::string& value) {
      table.rows.push_back({cell_in(language_, name), cell_in(language_, value)});
    };
    add("request message", std::to_string(limits.max_message_bytes()) + " bytes");
    add("blocks in a batch", std::to_string(limits.max_blocks_per_batch()));
    add("batches in flight", std::to_string(limits.max_batches_in_flight()));
    add("blocks in a selection", std::to_string(limits.max_selection_blocks()));
    add("memory of all streams", std::to_string(limits.max_memory_bytes()) + " bytes");
    add("streams of a connection", std::to_string(limits.max_streams_per_connection()));
    add("streams of the server", std::to_string(limits.max_streams()));
    add("line of NC text", std::to_string(limits.max_line_bytes()) + " bytes");
    add("idle stream", std::to_string(limits.idle_timeout_seconds()) + " s");
    add("coordinate", number(limits.max_coordinate()) + " mm");
    return table;
  }

  [[nodiscard]] Table radius_terms() const {
    Table table = headed({"Term", "Range", "Default", "Meaning"});
    for (const v1::RadiusTerm& term : info_.radius_terms())
      table.rows.push_back({term.name(), between(term.min(), term.max(), "mm"),
                            number(term.default_value()),
                            meaning(wire::german_meaning_of(term.name()), term.meaning())});
    return table;
  }

  [[nodiscard]] Table settings() const {
    Table table = headed({"Setting", "Default", "Meaning"});
    for (const v1::Setting& setting : info_.settings()) {
      const std::string takes =
          setting.has_min() && setting.min() < setting.max()
              ? between(setting.min(), setting.max(),
                        german_ ? wire::german_values_of(setting.unit()) : setting.unit())
              : std::string(german_ ? wire::german_values_of(setting.values()) : setting.values());
      table.rows.push_back(
          {setting.name(), setting.default_value(),
           meaning(wire::german_meaning_of(setting.name()), setting.meaning()) + ": " + takes});
    }
    return table;
  }

  [[nodiscard]] Table options() const {
    Table table = headed({"Option", "Range", "Default", "Available", "Meaning"});
    for (const v1::TrcKeyword& keyword : info_.trc_keywords()) {
      const std::string range = range_of(keyword);
      table.rows.push_back({keyword.name(), cell_in(language_, range),
                            range.empty() ? "" : number(keyword.default_value()),
                            cell_in(language_, keyword.available() ? "yes" : "no, refused"),
                            meaning(german_meaning_of_keyword(keyword.name()), keyword.meaning())});
    }
    return table;
  }

  [[nodiscard]] Table functions() const {
    Table table = headed({"Function", "Group", "Initial", "Meaning"});
    for (const v1::GFunction& function : info_.g_functions())
      table.rows.push_back({function.name(), cell_in(language_, function.group()),
                            function.initial() ? cell_in(language_, "yes") : "",
                            cell_in(language_, function.meaning())});
    return table;
  }

  [[nodiscard]] Table diagnostics() const {
    Table table = headed({"Code", "Severity", "Cause", "Remedy"});
    for (const v1::DiagnosticRow& row : info_.diagnostics()) {
      // The client has no words of its own for the code of a newer server.
      const GermanRow& own = german_row_of(static_cast<Code>(row.code()));
      const bool is_known = static_cast<int>(own.code) == row.code();
      table.rows.push_back({std::to_string(row.code()),
                            cell_in(language_, severity_word(row.severity())),
                            meaning(is_known ? own.title : std::string_view(), row.cause()),
                            meaning(is_known ? own.help : std::string_view(), row.remedy())});
    }
    return table;
  }

 private:
  [[nodiscard]] Table headed(const Row& columns) const {
    Table table{{{}}};
    for (const std::string& column : columns)
      table.rows.front().push_back(cell_in(language_, column));
    return table;
  }

  [[nodiscard]] std::string meaning(std::string_view german, const std::string& english) const {
    return german_ && !german.empty() ? std::string(german) : cell_in(language_, english);
  }

  const v1::GetServerInfoResponse& info_;
  bool german_;
  Language language_;
};

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

// What happens to a function while TRC is off.
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
    table.rows.front().push_back(std::string(dialect.spelling));
    for (const GFunction& function : dialect.functions)
      functions[function.tenths()][dialect.name] = &function;
  }
  for (const auto& [tenths, known] : functions) {
    Row row{name_of(*known.begin()->second)};
    for (const Dialect& dialect : all_dialects()) {
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

std::string text_of(const v1::GetServerInfoResponse& info, Language language) {
  const Tables tables(info, language);
  const auto part = [&](std::string_view title, const Table& table) {
    return table.rows.size() < 2 ? std::string()
                                 : "\n" + tables.heading(title) + "\n" + aligned(table);
  };
  std::string text = "trc " + info.version() + " (" + info.commit() + ")\n";
  if (!info.build().empty()) text += info.build() + "\n";
  text += part("Limits", tables.limits());
  text += part("The tool radius, the sum of", tables.radius_terms());
  text += part("Settings", tables.settings());
  text += part("#TRC options", tables.options());
  text += part("G functions", tables.functions());
  return text + part("Diagnostics", tables.diagnostics());
}

std::string markdown_options(const v1::GetServerInfoResponse& info) {
  return markdown(Tables(info, Language::english).options());
}

std::string markdown_functions(const v1::GetServerInfoResponse& info) {
  return markdown(Tables(info, Language::english).functions());
}

std::string markdown_diagnostics(const v1::GetServerInfoResponse& info) {
  return markdown(Tables(info, Language::english).diagnostics());
}

}  // namespace trc::cli
