#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/length_unit.h"
#include "core/nc/state/block.h"
#include "core/nc/state/circle.h"
#include "core/nc/state/dialect_name.h"
#include "core/nc/state/radius_terms.h"

namespace trc {

inline constexpr std::int64_t no_tool_number = -1;
// Tools with a name only get numbers from here on, beyond those of D and T words.
inline constexpr std::int64_t first_named_tool = std::int64_t{1} << 31U;
// The key of a tool and its edge in the tool table. `edge`: D of Sinumerik, from 1 on; 3 for
// Heidenhain's tool 5.2.
[[nodiscard]] constexpr std::int64_t row_of_edge(std::int64_t tool, std::int64_t edge) {
  return tool + (edge - 1) * (std::int64_t{1} << 32U);
}
// The edge and the tool of such a key.
[[nodiscard]] constexpr std::int64_t edge_of_row(std::int64_t row) { return (row >> 32U) + 1; }
[[nodiscard]] constexpr std::int64_t tool_of_row(std::int64_t row) {
  return row - row_of_edge(0, edge_of_row(row));
}

// The unit of a FANUC coordinate without a decimal point.
enum class WholeNumbers : std::uint8_t {
  unsaid,      // as `units`, but far beyond any machine it is refused (900008)
  units,       // X10 is 10 mm, or 10 in
  increments,  // X10 is 0.010 mm, 0.0010 in or 0.010 degrees: the least input increment
};

// How the switch for block skip stands: lines with `/` (D-59).
enum class BlockSkip : std::uint8_t {
  refuse,     // unknown: whatever depends on it is refused (900017)
  execute,    // off: they are lines like any other
  leave_out,  // on: they are none
};

// What bytes comments may hold. Outside of them text is ASCII in any case.
enum class Encoding : std::uint8_t {
  of_dialect,  // ISG: UTF-8; the others: any
  utf8,
  any,  // they are kept as they are
};

// What holds before the first block.
struct ProgramSetup {
  TrcMode mode{};    // plane, mode, radius, options; side must be off
  Position start{};  // mm
  // `start` was not given: no contour may begin there by chance (900106).
  bool start_is_assumed = false;
  bool absolute_center = false;  // G161; G162 is the initial state (rule 10.4)
  CircleCheck circle{};
  std::vector<std::string> tracking_axes{"A", "B", "C", "U", "V", "W"};
  std::map<std::int64_t, ToolRow> tools{};                        // by row_of_edge()
  std::map<std::string, std::int64_t, std::less<>> tool_names{};  // the tool, as in row_of_edge()
  // The tool radius of `mode` was given. A radius other than 0 always was; a radius of 0 without
  // this means none at all (D-40), except in wear mode.
  bool tool_radius_given = false;
  double wear = 0;            // mm, of the tool whose radius `mode` has; a D word brings its own
  double allowance = 0;       // mm; positive leaves stock on the part
  double nominal_radius = 0;  // mm; above 0: wear mode (RadiusTerms::nominal)
  double max_wear = 1;        // mm; beyond that in size 900222
  // Replaces every radius that setup, tools and program give, mm, keeping its sign; in wear mode it
  // is the difference. Tools then have the wear of the setup, and every D but D0 names a tool.
  std::optional<double> every_radius{};
  // P-CHAN-00284 = 0: G141 and G140 switch KERF_MASKING, the last writer wins (D-33).
  bool masking_switches_kerf = false;
  DialectName dialect = DialectName::isg;  // of NC text
  bool inch = false;                       // NC text counts in inch before it says
  bool unit_is_assumed = false;            // nobody has said `inch`: D-167
  bool copies_unknown_words = false;       // lines with unknown G functions, while TRC is off
  // For programs that compute: the values of variables that the program does not set itself, by
  // name as it writes them; and the texts of subprograms that it calls, by file name.
  std::map<std::string, double> variables{};
  std::map<std::string, std::string> subprograms{};
  std::uint64_t max_executed_lines = 10'000'000;  // 900301 beyond
  WholeNumbers whole_numbers = WholeNumbers::unsaid;
  BlockSkip block_skip = BlockSkip::refuse;
  // Words unknown here that do not affect the path, in capitals: `POPEN`, `G777`, `SOFTA`.
  // fault_of_pass_word() says which words are allowed.
  std::set<std::string, std::less<>> pass_words{};
  Encoding encoding = Encoding::of_dialect;
  bool renumbers = false;  // the blocks of NC text that comes out
  // Of its coordinates, mm; one more for inch. Nothing: 4, and as many as the program has where
  // that is more (D-180).
  std::optional<int> decimals{};

  [[nodiscard]] LengthUnit length_unit() const { return inch ? LengthUnit::inch : LengthUnit::mm; }
  [[nodiscard]] bool demands_utf8() const {
    return encoding == Encoding::utf8 ||
           (encoding == Encoding::of_dialect && dialect == DialectName::isg);
  }
};

}  // namespace trc
