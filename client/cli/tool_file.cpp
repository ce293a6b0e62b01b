#include "client/cli/tool_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "client/cli/csv_tools.h"
#include "client/cli/files.h"
#include "client/cli/heidenhain_tools.h"
#include "client/cli/isg_tools.h"
#include "client/cli/table_text.h"
#include "client/cli/tool_table.h"
#include "core/base/length_unit.h"
#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

// Reads the lines of a table in any of the formats.
class ToolFile {
 public:
  explicit ToolFile(v1::ProgramSetup& setup)
      : setup_(setup), unit_(setup.unit() == v1::LENGTH_UNIT_INCH ? mm_per_inch : 1) {}

  std::string read(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
      return "it is text in UTF-16; save it as CSV UTF-8";
    // Spreadsheets begin UTF-8 with this mark.
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    std::size_t line_number = 0;
    while (!text.empty() && !is_no_table_) {
      const auto end = text.find('\n');
      const std::string_view as_written = text.substr(0, end);
      const std::string_view line = without_quotes(as_written);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line_number;
      if (line.empty() || line.front() == '#' || line.front() == ';') continue;
      if (const std::string fault = read_line(line, as_written); !fault.empty())
        note(line_number, fault);
    }
    if (faults_ > 0) return told_faults();
    take_edges();
    isg_.take_tools();
    if (table_.empty()) return "it names no tool with a radius";
    if (csv_.has_header())
      unit_unsaid_ = csv_.unit_unsaid();
    else
      unit_unsaid_ = !heidenhain_.has_begun() && !isg_.has_begun() && !unit_said_ &&
                     setup_.unit() == v1::LENGTH_UNIT_UNSPECIFIED;
    return table_.write(setup_);
  }

  [[nodiscard]] bool unit_unsaid() const { return unit_unsaid_; }

 private:
  void note(std::size_t line_number, const std::string& fault) {
    ++faults_;
    if (faults_ <= most_faults_told)
      told_ += (told_.empty() ? "" : "\n") + ("line " + std::to_string(line_number)) + ": " + fault;
  }

  [[nodiscard]] std::string told_faults() const {
    const std::size_t left_out = faults_ - std::min(faults_, most_faults_told);
    if (left_out == 0) return told_;
    return told_ + "\n" + std::to_string(left_out) +
           (left_out == 1 ? " more line is wrong" : " more lines are wrong");
  }

  // The fault of a line without which the others cannot be read.
  std::string of_the_head(std::string fault) {
    is_no_table_ = !fault.empty();
    return fault;
  }

  // `as_written` keeps the leading blanks, which matter in tables with fixed columns, and the
  // quotation marks of a CSV.
  std::string read_line(std::string_view line, std::string_view as_written) {
    if (const std::string words = in_upper_case(line); HeidenhainTools::begins_with(words))
      return of_the_head(heidenhain_.begin(words));
    if (heidenhain_.has_begun() && !heidenhain_.has_columns())
      return of_the_head(heidenhain_.read(as_written));
    if (heidenhain_.has_begun())
      return line == "[END]" ? std::string() : heidenhain_.read(as_written);
    if (IsgTools::is_row(line)) return isg_.read(line);
    if (csv_.has_header()) return csv_.read(as_written);
    if (const auto begun = csv_.begin(as_written)) return of_the_head(*begun);
    return read_words(line);
  }

  // Reads a line of words, as in a program.
  std::string read_words(std::string_view line) {
    if (in_upper_case(line).starts_with("%_N_")) {
      sinumerik_ = true;
      return {};
    }
    if (in_upper_case(line).find("$TC_") < line.find_first_of(";=")) return data_of_edge(line);
    if (sinumerik_) return {};
    const LineOfWords words(line);
    if (const bool inch = words.has_function(20); inch || words.has_function(21)) {
      unit_ = inch ? mm_per_inch : 1;
      unit_said_ = true;
    }
    if (const bool adds = words.has_function(91); adds || words.has_function(90)) adds_ = adds;
    const bool is_modal = std::ranges::any_of(
        std::array{20, 21, 90, 91}, [&](int function) { return words.has_function(function); });
    if (is_modal && words.is_skippable()) return words.fault_but_for("");
    if (words.has_function(10)) return data_of_memory(words);
    // A value that a row of LinuxCNC omits is 0.
    const bool is_row = words.names('D') ||
                        (words.names('P') && !words.has('G') && !words.has('M') && !words.has('O'));
    if (words.names('T') && is_row) return row_of_linuxcnc(words);
    if (words.has('G') || line == "%" || words.has('O') || words.has('M') || words.has('T'))
      return {};
    return of_the_head("\"" + std::string(line) +
                       "\" is no row of a table of tools; a CSV begins with a header such as "
                       "number,radius");
  }

  // Reads T1 P1 D10.
  std::string row_of_linuxcnc(const LineOfWords& words) {
    if (std::string fault = words.fault_but_for(""); !fault.empty()) return fault;
    constexpr std::string_view letters_of_row = "TPDXYZABCUVWIJQ";
    const std::size_t other = words.letters().find_first_not_of(letters_of_row);
    if (other != std::string::npos)
      return std::string(1, words.letters()[other]) + " is no word of a table of LinuxCNC";
    const auto number = tool_number(words.find('T')->number);
    if (!number) return "T is no number of a tool";
    const double diameter = words.has('D') ? words.find('D')->number : 0;
    return table_.take({.number = *number}, {.radius = diameter / 2 * unit_});
  }

  // Reads G10 L12 P1 R5 of Fanuc.
  std::string data_of_memory(const LineOfWords& words) {
    const bool wear = words.has('L') && words.find('L')->number == 13;
    const bool may_be_radius = words.has('L') ? words.find('L')->number == 12 : words.names('L');
    if (!wear && !may_be_radius) return {};
    // A line may have several functions.
    if (std::string fault = words.fault_but_for("GM"); !fault.empty()) return fault;
    if (!words.has('P') || !words.has('R')) return "G10 L12 and G10 L13 need P and R";
    const auto number = tool_number(words.find('P')->number);
    if (!number) return "P is no number of a tool";
    if (adds_) return "under G91 its R is added to what the memory holds: give it under G90";
    const LineOfWords::Word& given = *words.find('R');
    double size = given.number * unit_;
    if (given.text.find('.') == std::string_view::npos) {
      constexpr double doubtful = 50;  // mm (D-50)
      if (setup_.whole_numbers() == v1::WHOLE_NUMBERS_INCREMENTS)
        size /= unit_ == 1 ? 1e3 : 1e4;
      else if (setup_.whole_numbers() == v1::WHOLE_NUMBERS_UNSPECIFIED &&
               (wear ? size != 0 : std::abs(size) >= doubtful))
        return "R has no decimal point: say what it counts in with --whole-numbers";
    }
    ToolSizes& sizes = table_.sizes_of({.number = *number});
    (wear ? sizes.wear : sizes.radius) = size;
    sizes.has_radius |= !wear;
    return {};
  }

  // Reads $TC_DP6[1,1]=5 of Sinumerik.
  std::string data_of_edge(std::string_view line) {
    sinumerik_ = true;
    line = without_quotes(
        line.substr(line.find('$'), line.find(';', line.find('=')) - line.find('$')));
    const std::size_t open = std::min(line.find('['), line.size());
    const std::string name = in_upper_case(without_quotes(line.substr(0, open)));
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
      table_.name(*tool, in_capitals_as_utf8(without_quotes(line.substr(equals + 1))));
      return {};
    }
    const auto edge = places.size() == 2 ? tool_number(number_from(places[1])) : std::nullopt;
    if (!tool || !edge || equals == line.size())
      return "\"" + std::string(line) + "\" names no tool and edge, as in " + name + "[1,1]";
    const std::string_view given = without_quotes(line.substr(equals + 1));
    const auto value = number_from(given);
    if (!value)
      return std::string(without_quotes(line.substr(0, equals))) + " is \"" + std::string(given) +
             "\", which is no number";
    constexpr double first_turning_type = 500;
    constexpr double last_turning_type = 599;
    if (name == "$TC_DP1") {
      if (*value >= first_turning_type && *value <= last_turning_type) turning_.insert(*tool);
      return {};
    }
    ToolSizes& sizes =
        edges_.try_emplace({.number = *tool, .edge = *edge}, ToolSizes{.has_radius = false})
            .first->second;
    (wear ? sizes.wear : sizes.radius) = *value * unit_;
    sizes.has_radius |= radius;
    return {};
  }

  // Takes the edges of Sinumerik, except those of turning tools.
  void take_edges() {
    for (const auto& [key, sizes] : edges_) {
      // A size that the file does not give is 0.
      const bool empty = !sizes.has_radius && sizes.wear == 0;
      if (!empty && !turning_.contains(key.number)) table_.add(key, sizes);
    }
  }

  static constexpr std::size_t most_faults_told = 10;

  v1::ProgramSetup& setup_;
  double unit_;
  std::size_t faults_ = 0;
  std::string told_{};  // of them, a line each
  bool is_no_table_ = false;
  bool unit_unsaid_ = false;
  bool unit_said_ = false;  // by G20 or G21 of Fanuc
  bool adds_ = false;       // G91
  ToolTable table_;
  CsvTools csv_{table_};
  HeidenhainTools heidenhain_{table_};
  IsgTools isg_{table_};
  bool sinumerik_ = false;
  std::map<ToolKey, ToolSizes> edges_{};
  std::set<std::uint32_t> turning_{};
};

// The words that make a cycle of G70 and G71 of Fanuc, which are inch and mm without them.
bool names_a_cycle(std::string_view words) {
  return words.find_first_of("ABCIJKLPRUVWXYZ") != std::string_view::npos;
}

// Whether the words, in capitals, have this function.
bool has_function(std::string_view words, std::string_view function) {
  for (auto at = words.find(function); at != std::string_view::npos;
       at = words.find(function, at + 1)) {
    const char behind = sign_at(words, at + function.size());
    if (!is_digit(behind) && behind != '.') return true;
  }
  return false;
}

}  // namespace

std::string read_tool_table(std::string_view text, v1::ProgramSetup& setup) {
  return ToolFile(setup).read(text);
}

std::string read_tool_file(const std::string& path, v1::ProgramSetup& setup, bool& unit_unsaid) {
  constexpr std::size_t most_bytes = std::size_t{16} << 20U;
  std::string text;
  if (!read_bounded(path, most_bytes, text)) return "cannot read " + path;
  if (text.size() > most_bytes) return path + ": it is larger than 16 MiB";
  ToolFile file(setup);
  const std::string fault = file.read(text);
  unit_unsaid = file.unit_unsaid();
  std::string faults = fault.empty() ? fault : path + ": " + as_utf8(fault);
  const std::string between = "\n" + path + ": ";
  for (std::size_t at = faults.find('\n', path.size()); at != std::string::npos;
       at = faults.find('\n', at + between.size()))
    faults.replace(at, 1, between);
  return faults;
}

bool says_inch(std::string_view program, v1::Dialect dialect, v1::LengthUnit given) {
  const bool twenty = dialect == v1::DIALECT_FANUC || dialect == v1::DIALECT_LINUXCNC;
  bool says_mm = false;
  while (!program.empty()) {
    const auto end = program.find('\n');
    const std::string line = in_upper_case(without_quotes(program.substr(0, end)));
    program.remove_prefix(end == std::string_view::npos ? program.size() : end + 1);
    if (dialect == v1::DIALECT_HEIDENHAIN) {
      if (line.find("BEGIN PGM") != std::string::npos) return line.ends_with(" INCH");
      continue;
    }
    const std::string words = line.substr(0, line.find_first_of(";("));
    if (dialect == v1::DIALECT_FANUC && !names_a_cycle(words)) {
      if (has_function(words, "G70")) return true;
      says_mm |= has_function(words, "G71");
    }
    if (has_function(words, twenty ? "G20" : "G70") || has_function(words, twenty ? "G20" : "G700"))
      return true;
    says_mm |=
        has_function(words, twenty ? "G21" : "G71") || has_function(words, twenty ? "G21" : "G710");
  }
  return !says_mm && given == v1::LENGTH_UNIT_INCH;
}

}  // namespace trc::cli
