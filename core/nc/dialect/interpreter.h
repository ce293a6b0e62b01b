#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"

namespace trc {

// Reads NC text of the dialect of the setup and tells `state` what it means; blocks come
// out there. The text may be cut anywhere, also inside a word, a line end or a
// UTF-8 character: lines, blocks and diagnostics are the same.
//
// What cannot be handled safely is an error with line, column and remedy. After an error nothing
// more is read, except to find further faults of reading (ReaderLimits::most_faults).
//
// Of ISG:
//
//   - The words of a block act together, whatever their order: modes, radius,
//     G40 … G42, technology, motion, stop. A function excludes all others of its
//     group in one block, itself included.
//   - Values are plain decimal numbers. Variables, expressions and jumps are resolved before
//     (nc/program); `/` as ProgramSetup::block_skip says. R and I J K outside circles are refused:
//     R is not modal here.
//   - While TRC is off calls of subprograms (L NAME), assignments to variables
//     (V.P. = …), coordinate systems and the like pass as they stand. The position
//     is unknown then; after a call it is known again once G00 … G03 and G90 or
//     G91 have been programmed anew.
//   - G70 counts coordinates, centres, radii and F in inch, also the tool radius
//     that a program writes; the radii of the tool table are mm.
//   - Zero shifts and G92 pass while TRC is off. The position is unknown then, with
//     axis words after G92 on those axes, after G53 also after the motion of its
//     block: ProgramState::forget_position.
//   - F is a feed per minute under G94 only; under G93, G95 and G194 it passes as
//     technology and blocks have no feed. TRC cannot be active under G93, nor G11
//     under any of them.
//   - After M02, M30 and between #COMMENT BEGIN and END lines are text only; G41 and G42 after the
//     end are refused (900015), since nothing would resolve them.
class Interpreter {
 public:
  Interpreter(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics)
      : reading_(limits, state, diagnostics) {}

  // Appends to `lines` every line that is complete. Returns whether the stream
  // goes on.
  bool feed(std::string_view text, std::vector<LinePointer>& lines);
  // As `feed`, of whole lines: a carriage return at the end of the text is a line end.
  bool feed_lines(std::string_view text, std::vector<LinePointer>& lines);
  // End of the text: reads a last line without line end and ends the program in `state`, unless M02
  // or M30 has done so. `why_empty`: what to say of a text without any block.
  bool finish(std::vector<LinePointer>& lines, std::string_view why_empty = {});

  // A line of the flat program made from a program that computes.
  struct FlatLine {
    std::string_view text{};
    std::string_view line_end{};
    std::uint32_t number = 0;        // of the line it comes from, 1-based
    bool is_as_written = true;       // that line itself: columns say where in it
    bool sets_variables = false;     // for a call of the machine: copied as it stands
    bool calls_the_machine = false;  // of what only the machine has: copied as it stands
    bool machine_follows = false;    // a macro of the machine, after the motion of the line
    std::optional<KlartextEffects> call_leaves{};  // after the label that it calls
  };
  // Reads the line as `feed` reads a whole line.
  bool read(const FlatLine& line, std::vector<LinePointer>& lines);
  // Reports the error, with all faults of reading found so far. Returns false.
  bool stop(Diagnostic error);
  // Records the error as a fault of reading, reported together with those found before and after
  // it. Returns whether reading goes on.
  bool note(Diagnostic error);

  // Blocks read so far, the index of the next one (Source::index).
  [[nodiscard]] std::uint64_t blocks_read() const { return reading_.blocks_read; }
  // Physical lines read so far.
  [[nodiscard]] std::uint64_t lines_read() const { return reading_.lines_read; }
  // The modes in force after the lines read.
  [[nodiscard]] LengthUnit unit_in_force() const { return reading_.unit; }
  [[nodiscard]] bool is_incremental() const { return reading_.incremental; }
  [[nodiscard]] MotionKind motion_in_force() const { return reading_.motion; }
  [[nodiscard]] Plane plane_in_force() const { return reading_.state.programmed_plane(); }
  [[nodiscard]] std::optional<double> radius_in_force() const {
    return reading_.state.tool().radius();
  }
  // The diameter of the tool that M6 has put into the spindle, wear included, mm.
  [[nodiscard]] std::optional<double> spindle_diameter() const;
  [[nodiscard]] bool is_in_contour() const { return reading_.state.contour_open(); }
  // Whether M02 or M30 has been read.
  [[nodiscard]] bool has_ended() const { return reading_.ended; }

  // Takes a line that is no longer needed, so that its memory serves a later one.
  void recycle(LinePointer line);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(has_begun_, partial_, continued_, carriage_return_, may_go_on_, reading_);
  }

 private:
  bool take_line(std::string_view text, std::string_view line_end, std::vector<LinePointer>& lines);
  bool take_block(std::string_view text, std::string_view line_end, std::uint32_t lines_of_it,
                  std::vector<LinePointer>& lines);
  // Klartext: partial_ is a block that turns out to end before its last line.
  bool take_block_before(std::string_view last_line, std::vector<LinePointer>& lines);
  [[nodiscard]] bool may_go_on(std::string_view block) const;
  ProgramLine& append_line(std::string_view text, std::string_view line_end,
                           std::vector<LinePointer>& lines);
  void enter_modes(ProgramLine& line) const;
  bool refuse_long_line();
  bool refuse_open_line();

  Reading reading_;
  bool has_begun_ = false;  // a line has been taken
  // The text of a line whose end is still to come; it may hold the lines that
  // are continued.
  std::string partial_{};
  std::uint32_t continued_ = 0;   // line ends within partial_
  bool may_go_on_ = false;        // partial_ is a whole block of Klartext in columns
  bool carriage_return_ = false;  // partial_ is complete, a line feed may follow
  std::vector<LinePointer> spare_{};
};

}  // namespace trc
