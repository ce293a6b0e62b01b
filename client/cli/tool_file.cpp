#include "client/cli/tool_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "client/cli/files.h"
#include "client/cli/table_text.h"
#include "core/base/utf8.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

// A tool by its number, or by its name alone, and which of its edges.
struct Key {
  std::uint32_t number = 0;
  std::string name{};  // empty: the number tells
  std::uint32_t edge = 1;

  auto operator<=>(const Key&) const = default;
};

struct Sizes {
  double radius = 0;
  double wear = 0;
  bool has_radius = true;

  bool operator==(const Sizes&) const = default;
};

class Table {
 public:
  explicit Table(v1::ProgramSetup& setup)
      : setup_(setup), unit_(setup.unit() == v1::LENGTH_UNIT_INCH ? mm_per_inch : 1) {}

  std::string read(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
      return "it is text in UTF-16; save it as CSV UTF-8";
    // As spreadsheets begin UTF-8.
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    std::size_t line_number = 0;
    while (!text.empty()) {
      const auto end = text.find('\n');
      const std::string_view as_written = text.substr(0, end);
      const std::string_view line = trimmed(as_written);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line_number;
      if (line.empty() || line.front() == '#' || line.front() == ';') continue;
      if (const std::string fault = read_line(line, as_written); !fault.empty())
        return "line " + std::to_string(line_number) + ": " + fault;
    }
    take_edges();
    if (tools_.empty()) return "it names no tool with a radius";
    if (!columns_.empty())
      unit_unsaid_ = !table_unit_ && std::ranges::find(columns_, "UNIT") == columns_.end();
    else
      unit_unsaid_ = !heidenhain_ && !unit_said_ && setup_.unit() == v1::LENGTH_UNIT_UNSPECIFIED;
    for (const auto& [key, sizes] : tools_) {
      if (!sizes.has_radius) return text_of(key) + " has wear, but no radius";
      v1::Tool& tool = *setup_.add_tools();
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

  [[nodiscard]] bool unit_unsaid() const { return unit_unsaid_; }

 private:
  static constexpr char comma = ',';
  static constexpr char semicolon = ';';

  static std::string text_of(const Key& key) {
    const std::string tool = key.name.empty() ? std::to_string(key.number) : "\"" + key.name + "\"";
    return "tool " + tool + (key.edge == 1 ? "" : ", edge " + std::to_string(key.edge));
  }
  // The sizes of a tool that stands in one row; what is wrong, else.
  std::string take(const Key& key, const Sizes& sizes) {
    return tools_.try_emplace(key, sizes).second ? std::string() : text_of(key) + " a second time";
  }

  // Of a CSV.
  static bool is_header(std::string_view line, char separator) {
    const auto columns = split(line, separator);
    return std::ranges::any_of(columns, [](std::string_view column) {
      const std::string name = in_upper_case(column);
      return name == "NUMBER" || name == "NAME";
    });
  }
  static std::optional<double> unit_named(std::string_view name) {
    if (in_upper_case(name) == "MM") return 1;
    if (in_upper_case(name) == "INCH") return mm_per_inch;
    return {};
  }

  // As it stands in the file: blanks in front count where columns do.
  std::string read_line(std::string_view line, std::string_view as_written) {
    if (const std::string words = in_upper_case(line);
        words.starts_with("BEGIN ") && words.find(".T") != std::string::npos) {
      heidenhain_ = true;
      unit_ = words.ends_with("INCH") ? mm_per_inch : 1;
      return {};
    }
    if (heidenhain_) return line == "[END]" ? std::string() : row_of_places(as_written);
    if (columns_.empty()) separator_ = line.find(';') < line.find(',') ? semicolon : comma;
    if (columns_.empty() && in_upper_case(line).starts_with(std::string("UNIT") + separator_) &&
        !is_header(line, separator_)) {
      const auto cells = split(line, separator_);
      table_unit_ = unit_named(cells[1]);
      return table_unit_ ? std::string()
                         : "unit is \"" + std::string(cells[1]) + "\", not mm or inch";
    }
    if (columns_.empty() && is_header(line, separator_)) return header(line);
    if (!columns_.empty()) return row(line);
    if (in_upper_case(line).starts_with("%_N_")) {
      sinumerik_ = true;
      return {};
    }
    if (in_upper_case(line).find("$TC_") < line.find_first_of(";=")) return data_of_edge(line);
    if (sinumerik_) return {};
    const std::multimap<char, double> words = words_of(line);
    const auto has = [&](char letter) { return words.contains(letter); };
    const auto has_function = [&](double number) {
      const auto [first, last] = words.equal_range('G');
      return std::any_of(first, last, [&](const auto& word) { return word.second == number; });
    };
    if (has_function(20) || has_function(21)) {
      unit_ = has_function(20) ? mm_per_inch : 1;
      unit_said_ = true;
    }
    if (has_function(90) || has_function(91)) adds_ = has_function(91);
    if (has_function(10)) return data_of_memory(words, line);
    if (has('T') && has('D')) {
      const auto number = tool_number(words.find('T')->second);
      if (!number) return "T is no number of a tool";
      return take({.number = *number}, {.radius = words.find('D')->second / 2 * unit_});
    }
    return has('G') || line == "%" || has('O') || has('M') || has('T')
               ? std::string()
               : "\"" + std::string(line) +
                     "\" is no row of a table of tools; a CSV begins with a "
                     "header such as number,radius";
  }

  // Of the word with that letter.
  static bool has_point(std::string_view line, char letter) {
    const std::size_t at = in_upper_case(line).find(letter);
    if (at == std::string::npos) return false;
    const std::string_view value = line.substr(at + 1);
    return value.substr(0, value.find_first_not_of("+-0123456789. \t")).find('.') !=
           std::string_view::npos;
  }

  // G10 L12 P1 R5 of Fanuc.
  std::string data_of_memory(const std::multimap<char, double>& words, std::string_view line) {
    const auto value = [&](char letter) { return words.find(letter)->second; };
    if (!words.contains('L') || !words.contains('P') || !words.contains('R')) return {};
    const bool wear = value('L') == 13;
    if (!wear && value('L') != 12) return {};
    const auto number = tool_number(value('P'));
    if (!number) return "P is no number of a tool";
    if (adds_) return "under G91 its R is added to what the memory holds: give it under G90";
    double size = value('R') * unit_;
    if (!has_point(line, 'R')) {
      constexpr double doubtful = 1000;  // mm
      if (setup_.whole_numbers() == v1::WHOLE_NUMBERS_INCREMENTS)
        size /= unit_ == 1 ? 1e3 : 1e4;
      else if (setup_.whole_numbers() == v1::WHOLE_NUMBERS_UNSPECIFIED && std::abs(size) > doubtful)
        return "R has no decimal point: say what it counts in with --whole-numbers";
    }
    Sizes& sizes =
        tools_.try_emplace({.number = *number}, Sizes{.has_radius = false}).first->second;
    (wear ? sizes.wear : sizes.radius) = size;
    sizes.has_radius |= !wear;
    return {};
  }

  // $TC_DP6[1,1]=5 of Sinumerik.
  std::string data_of_edge(std::string_view line) {
    sinumerik_ = true;
    line = trimmed(line.substr(line.find('$'), line.find(';', line.find('=')) - line.find('$')));
    const std::size_t open = std::min(line.find('['), line.size());
    const std::string name = in_upper_case(trimmed(line.substr(0, open)));
    const bool radius = name == "$TC_DP6";
    const bool wear = name == "$TC_DP15";
    const bool names = name == "$TC_TP2";
    if (!radius && !wear && !names && name != "$TC_DP1") return {};
    const std::size_t close = std::min(line.find(']', open), line.size());
    const auto places =
        split(open < close ? line.substr(open + 1, close - open - 1) : std::string_view(), ',');
    const std::size_t equals = std::min(line.find('=', close), line.size());
    const auto tool = tool_number(number_from(places[0]));
    if (names && tool && equals < line.size()) {
      names_[*tool] = in_capitals_as_utf8(trimmed(line.substr(equals + 1)));
      return {};
    }
    const auto edge = places.size() == 2 ? tool_number(number_from(places[1])) : std::nullopt;
    if (!tool || !edge || equals == line.size())
      return "\"" + std::string(line) + "\" names no tool and edge, as in " + name + "[1,1]";
    const std::string_view given = trimmed(line.substr(equals + 1));
    const auto value = number_from(given);
    if (!value)
      return std::string(trimmed(line.substr(0, equals))) + " is \"" + std::string(given) +
             "\", which is no number";
    constexpr double first_turning_type = 500;
    constexpr double last_turning_type = 599;
    if (name == "$TC_DP1") {
      if (*value >= first_turning_type && *value <= last_turning_type) turning_.insert(*tool);
      return {};
    }
    Sizes& sizes = edges_.try_emplace({.number = *tool, .edge = *edge}, Sizes{.has_radius = false})
                       .first->second;
    (wear ? sizes.wear : sizes.radius) = *value * unit_;
    sizes.has_radius |= radius;
    return {};
  }

  // Of Sinumerik, but for those of turning.
  void take_edges() {
    for (const auto& [key, sizes] : edges_) {
      // What stands nowhere is 0 there.
      const bool empty = !sizes.has_radius && sizes.wear == 0;
      if (!empty && !turning_.contains(key.number)) tools_.emplace(key, sizes);
    }
  }

  // TOOL.T of Heidenhain: the first line names the columns, each cell begins below its name.
  std::string row_of_places(std::string_view line) {
    if (places_.empty()) {
      for (std::size_t at = line.find_first_not_of(" \t\r"); at != std::string_view::npos;) {
        const auto end = std::min(line.find_first_of(" \t\r", at), line.size());
        places_.emplace_back(in_upper_case(line.substr(at, end - at)), at);
        at = line.find_first_not_of(" \t\r", end);
      }
      for (const char* name : {"T", "R"})
        if (!column_of(name)) return std::string("the table has no column ") + name;
      return {};
    }
    const std::string_view place = cell(line, "T");
    const auto number = tool_number(number_from(place.substr(0, place.find('.'))));
    // 5.2: the second index of tool 5.
    const auto index = place.find('.') < place.size()
                           ? tool_number(number_from(place.substr(place.find('.') + 1)))
                           : std::optional<std::uint32_t>(0);
    if (!number || !index) return "T is no number of a tool";
    const std::string_view name = cell(line, "NAME");
    if (!name.empty() && *index == 0) names_[*number] = in_capitals_as_utf8(name);
    const std::string_view radius = cell(line, "R");
    const std::string_view wear = cell(line, "DR");
    // Places without a tool.
    if (radius.empty() && wear.empty()) return {};
    const auto read_radius = number_from(radius);
    const auto read_wear = wear.empty() ? std::optional(0.0) : number_from(wear);
    if (!read_radius || !read_wear)
      return (read_radius ? "DR is \"" + std::string(wear) : "R is \"" + std::string(radius)) +
             "\", which is no number";
    return take({.number = *number, .edge = *index + 1},
                {.radius = *read_radius * unit_, .wear = *read_wear * unit_});
  }

  [[nodiscard]] std::optional<std::size_t> column_of(std::string_view name) const {
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (places_[i].first == name) return i;
    return std::nullopt;
  }

  // Columns count characters.
  static std::size_t byte_of_character(std::string_view line, std::size_t character) {
    if (!is_utf8(line)) return std::min(character, line.size());
    std::size_t byte = 0;
    for (; character > 0 && byte < line.size(); --character)
      byte += utf8_character(line.substr(byte));
    return byte;
  }

  [[nodiscard]] std::string_view cell(std::string_view line, std::string_view name) const {
    const auto column = column_of(name);
    if (!column) return {};
    const std::size_t begin = byte_of_character(line, places_[*column].second);
    const std::size_t end = *column + 1 < places_.size()
                                ? byte_of_character(line, places_[*column + 1].second)
                                : line.size();
    return trimmed(line.substr(begin, end - begin));
  }

  // Where semicolons part the columns, a comma stands for the decimal point.
  [[nodiscard]] std::optional<double> number_in(std::string_view cell) const {
    std::string number(cell);
    if (separator_ == semicolon) std::ranges::replace(number, ',', '.');
    return number_from(number);
  }

  std::string header(std::string_view line) {
    for (const std::string_view name : split(line, separator_))
      columns_.push_back(in_upper_case(name));
    const auto has = [&](std::string_view wanted) {
      for (const std::string& column : columns_)
        if (column == wanted) return true;
      return false;
    };
    for (const std::string& column : columns_)
      if (column != "NUMBER" && column != "RADIUS" && column != "DIAMETER" && column != "WEAR" &&
          column != "NAME" && column != "EDGE" && column != "HOLDS" && column != "UNIT")
        return "unknown column \"" + column + "\"";
    if (!(has("NUMBER") || has("NAME")) || has("RADIUS") == has("DIAMETER"))
      return "the header needs number or name, and one of radius, diameter";
    return {};
  }

  std::string row(std::string_view line) {
    const auto cells = split(line, separator_);
    // A decimal comma makes two cells of one number, and the first of them would count.
    for (std::size_t i = columns_.size(); i < cells.size(); ++i)
      if (!cells[i].empty())
        return "it has more values than the header; decimals have a point, or semicolons stand "
               "between the values";
    std::optional<double> number;
    std::string name;
    std::uint32_t edge = 1;
    double value = 0;
    double wear = 0;
    bool diameter = false;
    double unit = table_unit_.value_or(1);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string_view cell = i < cells.size() ? cells[i] : std::string_view();
      const std::string& column = columns_[i];
      if (column == "NAME") {
        name = in_capitals_as_utf8(cell);
        continue;
      }
      if (column == "NUMBER" && cell.empty()) continue;  // the name tells
      if (column == "EDGE") {
        const auto given =
            cell.empty() ? std::optional<std::uint32_t>(1) : tool_number(number_from(cell));
        if (!given || *given == 0) return "edge is \"" + std::string(cell) + "\", which is none";
        edge = *given;
        continue;
      }
      if (column == "UNIT") {
        const auto named = unit_named(cell);
        if (!named && !cell.empty()) return "unit is \"" + std::string(cell) + "\", not mm or inch";
        unit = named.value_or(unit);
        continue;
      }
      if (column == "HOLDS") {
        const std::string holds = in_upper_case(cell);
        if (!holds.empty() && holds != "RADIUS" && holds != "DIAMETER")
          return "holds is \"" + holds + "\", not RADIUS or DIAMETER";
        diameter |= holds == "DIAMETER";
        continue;
      }
      const auto read = number_in(cell);
      if (!read && !(column == "WEAR" && cell.empty()))
        return column + " is \"" + std::string(cell) + "\", which is no number";
      if (column == "NUMBER") number = read;
      if (column == "WEAR") wear = read.value_or(0);
      if (column == "RADIUS" || column == "DIAMETER") value = *read;
      diameter |= column == "DIAMETER";
    }
    const auto tool = number ? tool_number(number) : std::optional<std::uint32_t>(0);
    if (!tool) return "number is no number of a tool";
    if (!number && name.empty()) return "the tool has neither number nor name";
    if (number && !name.empty()) names_[*tool] = std::exchange(name, {});
    const double factor = unit * (diameter ? 0.5 : 1);
    return take({.number = *tool, .name = name, .edge = edge},
                {.radius = factor * value, .wear = factor * wear});
  }

  v1::ProgramSetup& setup_;
  double unit_;
  std::optional<double> table_unit_{};  // of a CSV, for all of its rows
  bool unit_unsaid_ = false;
  bool unit_said_ = false;  // by G20 or G21 of Fanuc
  bool adds_ = false;       // G91
  std::vector<std::string> columns_{};
  char separator_ = comma;  // of columns, as the first line of the CSV has it
  bool heidenhain_ = false;
  std::vector<std::pair<std::string, std::size_t>> places_{};  // of its columns: name and begin
  bool sinumerik_ = false;
  std::map<Key, Sizes> edges_{};
  std::set<std::uint32_t> turning_{};
  std::map<std::uint32_t, std::string> names_{};  // of tools with numbers
  std::map<Key, Sizes> tools_{};
};

}  // namespace

std::string read_tool_table(std::string_view text, v1::ProgramSetup& setup) {
  return Table(setup).read(text);
}

std::string read_tool_file(const std::string& path, v1::ProgramSetup& setup, bool& unit_unsaid) {
  constexpr std::size_t most_bytes = std::size_t{16} << 20U;
  std::string text;
  if (!read_bounded(path, most_bytes, text)) return "cannot read " + path;
  if (text.size() > most_bytes) return path + ": it is larger than 16 MiB";
  Table table(setup);
  const std::string fault = table.read(text);
  unit_unsaid = table.unit_unsaid();
  return fault.empty() ? fault : path + ": " + as_utf8(fault);
}

bool switches_to_inch(std::string_view program, v1::Dialect dialect) {
  while (!program.empty()) {
    const auto end = program.find('\n');
    const std::string line = in_upper_case(trimmed(program.substr(0, end)));
    program.remove_prefix(end == std::string_view::npos ? program.size() : end + 1);
    if (dialect == v1::DIALECT_HEIDENHAIN) {
      if (line.find("BEGIN PGM") != std::string::npos) return line.ends_with(" INCH");
      continue;
    }
    const std::string words = line.substr(0, line.find_first_of(";("));
    const bool twenty = dialect == v1::DIALECT_FANUC || dialect == v1::DIALECT_LINUXCNC;
    for (const std::string_view word : {twenty ? "G20" : "G70", twenty ? "G20" : "G700"}) {
      const auto at = words.find(word);
      if (at == std::string::npos) continue;
      const char behind = at + word.size() < words.size() ? words[at + word.size()] : ' ';
      if ((behind < '0' || behind > '9') && behind != '.') return true;
    }
  }
  return false;
}

}  // namespace trc::cli
