#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/program_line.h"
#include "core/nc/program_state.h"
#include "core/nc/words.h"

namespace trc {

struct ReaderLimits {
  std::size_t longest_line = 64 * 1024;  // bytes, continued lines together; 900006 beyond
};

// Reads NC text of the ISG dialect and tells `state` what it means; blocks come
// out there. The text may be cut anywhere, also inside a word, a line end or a
// UTF-8 character: lines, blocks and diagnostics are the same.
//
// What cannot be carried safely is an error with line, column and remedy. After
// an error nothing more is read. core/README.md lists the dialect.
class Interpreter {
 public:
  Interpreter(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics);

  // Appends to `lines` every line that is complete. Returns whether the stream
  // goes on.
  bool feed(std::string_view text, std::vector<ProgramLine>& lines);
  // End of the text: reads a last line without line end and ends the program in
  // `state`, unless M02 or M30 has done so.
  bool finish(std::vector<ProgramLine>& lines);

  // Takes a line that is no longer needed, so that its memory serves a later one.
  void recycle(ProgramLine&& line);

  // Physical lines read so far.
  [[nodiscard]] std::uint64_t lines_read() const { return lines_read_; }

 private:
  struct Block;

  bool read_line(std::string_view text, std::string_view line_end, std::vector<ProgramLine>& lines);
  bool read_block(ProgramLine& line);
  bool read_words(ProgramLine& line, Block& block);
  bool read_g_function(const Word& word, ProgramLine& line, Block& block);
  bool read_address(const Word& word, ProgramLine& line, Block& block);
  bool read_command(const Word& word, ProgramLine& line, Block& block);
  bool apply(ProgramLine& line, Block& block);
  bool refuse(const ProgramLine& line, const TextFault& fault);

  ProgramLine& append_line(std::string_view text, std::string_view line_end,
                           std::vector<ProgramLine>& lines);

  ReaderLimits limits_;
  ProgramState& state_;
  Diagnostics& diagnostics_;
};

}  // namespace trc
