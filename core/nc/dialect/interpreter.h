#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/dialect/plain_motion.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"
#include "core/nc/text/number_format.h"
#include "core/nc/text/words.h"

namespace trc {

struct ReaderLimits {
  std::size_t longest_line = 64 * 1024;  // bytes, continued lines together; 900006 beyond
};

// Reads NC text of the ISG dialect and tells `state` what it means; blocks come
// out there. The text may be cut anywhere, also inside a word, a line end or a
// UTF-8 character: lines, blocks and diagnostics are the same.
//
// What cannot be carried safely is an error with line, column and remedy. After
// an error nothing more is read.
//
//   - The words of a block act together, whatever their order: modes, radius,
//     G40 … G42, technology, motion, stop. A function excludes all others of its
//     group in one block, itself included.
//   - Values are plain decimal numbers. Variables, expressions, jumps,
//     subprograms and blocks to skip are refused, so are R and I J K outside
//     circles: R is not modal here.
//   - G70 counts coordinates, centres, radii and F in inch, also the tool radius
//     that a program writes; the radii of the tool table are mm.
//   - Zero shifts and G92 pass while TRC is off. The position is unknown then:
//     ProgramState::forget_position.
//   - F is a feed per minute under G94 only; under G93, G95 and G194 it passes as
//     technology and blocks have no feed. TRC cannot be active under G93, nor G11
//     under any of them.
//   - Behind M02, M30 and between #COMMENT BEGIN and END lines are text only.
class Interpreter {
 public:
  Interpreter(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics);

  // Appends to `lines` every line that is complete. Returns whether the stream
  // goes on.
  bool feed(std::string_view text, std::vector<LinePointer>& lines);
  // End of the text: reads a last line without line end and ends the program in
  // `state`, unless M02 or M30 has done so.
  bool finish(std::vector<LinePointer>& lines);

  // Takes a line that is no longer needed, so that its memory serves a later one.
  void recycle(LinePointer line);

  // Physical lines read so far.
  [[nodiscard]] std::uint64_t lines_read() const { return lines_read_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(partial_, continued_, carriage_return_, lines_read_, blocks_read_, comment_block_,
            ended_, motion_, incremental_, inch_, absolute_center_, feed_mode_, feed_);
  }

 private:
  struct BlockWords;

  bool take_line(std::string_view text, std::string_view line_end, std::vector<LinePointer>& lines);
  ProgramLine& append_line(std::string_view text, std::string_view line_end,
                           std::vector<LinePointer>& lines);
  void enter_modes(ProgramLine& line) const;
  bool read_line(ProgramLine& line);
  bool read_comment_block(ProgramLine& line);
  bool read_block(ProgramLine& line);
  [[nodiscard]] bool is_plain(ProgramLine& line, PlainMotion& plain) const;

  bool read_words(ProgramLine& line, BlockWords& block);
  bool read_g_function(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_address(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_axis(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_number(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_command(const Word& word, ProgramLine& line, BlockWords& block);
  bool check_block(ProgramLine& line, const BlockWords& block);

  bool apply(ProgramLine& line, const PlainMotion& plain);
  bool apply(ProgramLine& line, BlockWords& block);
  bool apply_modes(const ProgramLine& line, const BlockWords& block);
  bool apply_trc(const ProgramLine& line, const BlockWords& block);
  bool apply_motion(ProgramLine& line, BlockWords& block);
  bool move(ProgramLine& line, MoveRequest& request);
  void scale(MoveRequest& request) const;
  bool pass_words(const ProgramLine& line, WordRole role);

  bool refuse(const ProgramLine& line, const TextFault& fault);
  bool refuse(const ProgramLine& line, const Word& word, Code code, std::string detail = {});
  bool refuse_long_line();
  bool refuse_open_line();
  void place(const ProgramLine& line, std::uint32_t begin);
  [[nodiscard]] double length_unit() const { return inch_ ? mm_per_inch : 1; }

  ReaderLimits limits_;
  ProgramState& state_;
  Diagnostics& diagnostics_;
  std::array<std::int16_t, 26> axis_of_letter_{};  // 0 … 2 X Y Z, then tracking axes; -1: none

  // The text of a line whose end is still to come; it may hold the lines that
  // are continued.
  std::string partial_{};
  std::uint32_t continued_ = 0;   // line ends within partial_
  bool carriage_return_ = false;  // partial_ is complete, a line feed may follow
  std::vector<LinePointer> spare_{};
  std::uint64_t lines_read_ = 0;
  std::uint64_t blocks_read_ = 0;
  std::uint32_t comment_block_ = 0;  // line of #COMMENT BEGIN; 0: not in one
  bool ended_ = false;

  MotionKind motion_ = MotionKind::rapid;
  bool incremental_ = false;
  bool inch_ = false;
  bool absolute_center_ = false;
  std::int16_t feed_mode_ = 94;
  double feed_ = 0;  // mm/min
};

}  // namespace trc
