#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/control_words.h"
#include "core/nc/dialect/g_function.h"
#include "core/nc/state/dialect_name.h"
#include "core/nc/state/program_state.h"
#include "core/nc/state/trc_mode.h"
#include "core/nc/text/line_limits.h"

namespace trc {

// The properties of a dialect: the reader asks this table where dialects differ.
struct Dialect {
  DialectName name = DialectName::isg;
  std::string_view spelling{};                     // on the command line and in messages
  ControlWords words = ControlWords::g_functions;  // that messages name
  std::span<const GFunction> functions{};          // ascending
  std::int16_t inch_function = 70;                 // counts in inch from here on
  Selection selection = Selection::indirect;       // how the tool reaches the contour
  Transition transition = Transition::linear;      // at outside corners
  FeedAdaptation feed_adaptation = FeedAdaptation::off;
  // The motion function before the program gives one; nothing: a contour there is refused (900019).
  std::optional<MotionKind> motion{};
  // Numbers are written with a decimal point: without it some controls count increments.
  bool writes_points = false;
  // G41 without a D word takes the tool that the last M06 brought.
  bool tool_of_spindle = false;
  // D0 is a register that always holds 0: a radius of 0 (900220). Elsewhere it is no tool (900219).
  bool zero_is_a_radius = false;
  // An arc may lead to the contour.
  bool arcs_to_the_contour = false;
  // What its controls take in a line that is written anew.
  LineLimits limits{};

  // Sets the modes that hold at the start of a program (D-62).
  void begin(TrcMode& mode) const;
  // Null when there is no such function.
  [[nodiscard]] const GFunction* function(double number) const;
};

[[nodiscard]] const Dialect& dialect_of(DialectName name);
// The limits for lines of the result in this dialect. Whoever gives `decimals` knows which numbers
// the control takes (D-180).
[[nodiscard]] LineLimits limits_of(const Dialect& dialect, const ProgramSetup& setup);
[[nodiscard]] std::span<const Dialect> all_dialects();
// By its spelling, whatever the case.
[[nodiscard]] std::optional<DialectName> dialect_spelled(std::string_view spelling);

// The tables of functions, in ascending order.
[[nodiscard]] std::span<const GFunction> fanuc_functions();
[[nodiscard]] std::span<const GFunction> linuxcnc_functions();
[[nodiscard]] std::span<const GFunction> sinumerik_functions();

// The dialect that a line seems to be written in, where it makes no sense under ISG or a dangerous
// one. Used in messages only, never to read the line.
[[nodiscard]] std::optional<DialectName> looks_like(std::string_view line);
// A block of the programs that Heidenhain writes in G functions, which are not read: it ends with
// an asterisk.
[[nodiscard]] bool is_heidenhain_iso(std::string_view line);
// A block as only Okuma has it: $PART.MIN%, CALL OSUB, G15 H1.
[[nodiscard]] bool is_of_okuma(std::string_view line);

}  // namespace trc
