#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/length_unit.h"
#include "core/nc/dialect/block_skip.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/gcode_modes.h"
#include "core/nc/dialect/klartext_modes.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"
#include "core/nc/text/words.h"

namespace trc {

struct ReaderLimits {
  std::size_t longest_line = 64 * 1024;  // bytes, continued lines together; 900006 beyond
  // The number of different faults of reading reported together, at the end of the text at the
  // latest. No output follows the first one.
  std::size_t most_faults = 1;
};

// The state of reading: the modes that decide how the words of the next line count, and the
// faults found so far. The functions that read the words of each dialect share it, and tell
// `state` what the words mean. A bool that they return without further comment is whether reading
// goes on.
struct Reading {
  // A fault of reading: the first of its kind, with the number of further ones.
  struct Fault {
    Code code{};
    Source source{};
    std::uint32_t column = 0;
    std::string detail{};
    Slip slip{};
    std::uint64_t lines = 1;
    std::uint32_t last_line = 0;
    // Only for programs that compute, whose state is never saved while they are executed.
    std::vector<CallPlace> calls{};
    std::vector<DiagnosticValue> values{};
    std::optional<std::uint64_t> told_after{};
    // The lines counted in `lines`, by number, of the program ("") and of each subprogram with a
    // text of its own: lines may be executed more than once.
    std::map<std::string, std::vector<bool>> counted{};

    // Marks the line as counted; false: it is so already.
    bool counts(std::uint32_t line, const std::vector<CallPlace>& chain);
    template <class Archive>
    void serialize(Archive& archive) {
      archive(code, source, column, detail, slip.kind, slip.instead, lines, last_line, told_after);
    }
  };

  Reading(const ReaderLimits& limits_of_text, ProgramState& state_of_program,
          Diagnostics& diagnostics_of_program);

  // Reports what cannot be read, at its place in the line. Returns false.
  bool refuse(const ProgramLine& line, const TextFault& given);
  bool refuse(const ProgramLine& line, const Word& word, Code code, std::string detail = {});
  bool refuse_at(const WordPlace& place, Code code, std::string detail);
  // Faults with the same word and reason are one fault with the number of its lines.
  bool collect(Diagnostic fault);
  // At the end of the text.
  bool report_faults();
  [[nodiscard]] std::vector<Diagnostic> told_faults() const;

  // Gives diagnostics of the state their column, where the block is one line.
  void place(const ProgramLine& line, std::uint32_t begin);
  [[nodiscard]] WordPlace place_of_word(const ProgramLine& line, std::uint32_t begin) const;
  // The unit of lengths from this line on.
  void count_in(const ProgramLine& line, LengthUnit lengths);
  // A length of the program stays in force, in a unit that may only be assumed (D-167).
  void keep_length(const ProgramLine& line, std::string_view what);
  // The program says the unit. 900003 where it is another one than a length that is kept was read
  // in; false then.
  bool say_unit(const ProgramLine& line, std::uint32_t begin, LengthUnit lengths);
  [[nodiscard]] double length_unit() const { return mm_of(unit); }
  // One unit of feed, mm/min. Under G70 of Sinumerik feeds stay in mm.
  [[nodiscard]] double feed_unit(LengthUnit lengths) const {
    return feed_in_mm ? 1 : mm_of(lengths);
  }
  [[nodiscard]] LengthUnit unit_of(const GFunction& function) const {
    const bool inch = function.number == dialect.inch_function || function.number == 700;
    return inch ? LengthUnit::inch : LengthUnit::mm;
  }

  // TRC is active, or its retract motion is still to come, as far as the text has been read.
  [[nodiscard]] bool contour_open() const {
    return faults.empty() ? state.contour_open() : scanned_trc;
  }
  [[nodiscard]] bool trc_active() const {
    return faults.empty() ? state.mode().active() : scanned_trc;
  }
  [[nodiscard]] bool has_one_radius() const {
    const ProgramSetup& setup = state.setup();
    return setup.tools.empty() &&
           (setup.mode.tool_radius != 0 || setup.tool_radius_given || setup.nominal_radius > 0);
  }
  // A table, or one radius for all.
  [[nodiscard]] bool gives_radii() const {
    return has_one_radius() || !state.setup().tools.empty();
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lines_read, blocks_read, comment_block, ended, motion, motion_given, incremental, unit,
            feed_mode, feed, isg_word_seen, reads_plain_lines, feed_in_mm, gcode, klartext_modes,
            faults, scanned_trc, in_front_of_tape, called_motion, called_dimension, in_subprogram,
            ending_percent);
  }

  ReaderLimits limits;
  const Dialect& dialect;
  ProgramState& state;
  Diagnostics& diagnostics;
  std::array<std::int16_t, 26> axis_of_letter{};  // 0 … 2 X Y Z, then tracking axes; -1: none

  std::uint64_t lines_read = 0;   // physical ones
  std::uint64_t blocks_read = 0;  // the index of the next one (Source::index)
  bool knows_columns = true;      // of the text that was given
  SkipSign cut{};                 // out of the line that is read

  std::uint32_t comment_block = 0;   // line of #COMMENT BEGIN; 0: not in one
  bool ended = false;                // after M02, M30 or the `%` that ends a tape
  std::uint32_t ending_percent = 0;  // line of that `%`; 0: none has ended the program
  bool in_subprogram = false;        // of a %L before the program
  // No line so far was a block: lines that cannot be read may stand before the tape.
  bool in_front_of_tape = false;

  // Modes in force.
  MotionKind motion = MotionKind::rapid;
  bool motion_given = false;  // by the program, or by its control at the start
  bool incremental = false;
  LengthUnit unit = LengthUnit::mm;
  bool feed_in_mm = false;  // whatever lengths count in
  std::int16_t feed_mode = 94;
  double feed = 0;  // mm/min
  // A subprogram has been called since the program last gave the motion function, or the kind of
  // dimensions.
  bool called_motion = false;
  bool called_dimension = false;
  GcodeModes gcode{};
  KlartextModes klartext_modes{};

  // A line with a motion and nothing else means what its words say.
  bool reads_plain_lines = true;
  bool isg_word_seen = false;  // one that no other dialect has
  // About the line that is read, where it comes from a program that computes.
  bool sets_variables = false;
  bool calls_the_machine = false;
  bool machine_follows = false;
  std::optional<KlartextEffects> call_leaves{};  // after the label that it calls
  bool reads_flat = false;                       // all lines are such

  std::vector<Fault> faults{};
  bool scanned_trc = false;  // after the first fault: TRC is active

 private:
  [[nodiscard]] bool is_within_slip(const Diagnostic& found) const;
  void guard_against_other_dialects(const ProgramLine& line, Diagnostic& fault) const;
  // 0 after the first line of a block of several lines.
  [[nodiscard]] std::uint32_t column_in(const ProgramLine& line, std::uint32_t begin) const {
    const bool one_line = line.source.line == lines_read;
    const bool in_first_line = one_line || line.text.find_first_of("\r\n") >= begin;
    return in_first_line && knows_columns ? column_of(begin) : 0;
  }
  // 1-based column of a byte in the first line as it was given.
  [[nodiscard]] std::uint32_t column_of(std::size_t begin) const {
    const std::size_t removed = begin < cut.begin ? 0 : cut.end - cut.begin;
    return static_cast<std::uint32_t>(begin + removed + 1);
  }
};

}  // namespace trc
