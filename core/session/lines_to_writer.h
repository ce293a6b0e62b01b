#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/nc/program/program_reader.h"
#include "core/nc/writer/nc_writer.h"
#include "core/session/answers.h"
#include "core/session/path_session.h"

namespace trc {

// Passes the lines of a program to the writer: each goes there with its meaning, and waits for
// its blocks, which come out of the path. The path is compensated as far as lines have been
// taken. Where no NC text is wanted, the path answers to the caller, and the lines go no
// further.
class LinesToWriter {
 public:
  enum class Form { nc_text, blocks };

  LinesToWriter(const ProgramSetup& setup, Form form, PathSession& path, ProgramReader& reader);
  LinesToWriter(const LinesToWriter&) = delete;
  LinesToWriter& operator=(const LinesToWriter&) = delete;

  // Sends output that becomes certain to `out`, until another one is named.
  void answer_to(Answers& out) { output_ = &out; }
  // Lines that were read and not taken yet; their blocks wait in the path.
  [[nodiscard]] std::vector<LinePointer>& read() { return lines_; }
  // Takes them, but for those of a corner that waits for its second motion; compensates and writes.
  void advance();
  // The path ends with the lines taken.
  void end();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(writer_, lines_, next_item_, meaning_, silent_lines_, ended_);
  }

 private:
  bool take(LinePointer& given);
  // Enters the meaning of the next line, whose first block is the first that waits.
  void enter_meaning(const ProgramLine& line);
  bool write_line(LinePointer& given);
  bool release_silent_lines(const ProgramLine& line);
  bool end_program(const ProgramLine& line);
  bool write(Answer& part);
  // The control does not take the line that the writer has just made.
  void refuse_line(const Source& source);
  [[nodiscard]] bool writes_text() const { return form_ == Form::nc_text; }
  // The answers that the path appends to.
  [[nodiscard]] Answers& path_out() { return writes_text() ? to_writer_ : *output_; }

  Form form_;
  PathSession& path_;
  ProgramReader& reader_;  // uses the memory of lines again
  NcWriter writer_;

  std::vector<LinePointer> lines_;
  std::size_t blocks_taken_ = 0;    // of those that wait for the path: of the lines taken
  std::uint64_t next_item_ = 0;     // after the lines taken
  NcWriter::Meaning meaning_;       // of the last line taken
  std::uint64_t silent_lines_ = 0;  // taken in a row
  bool ended_ = false;              // by M02 or M30
  Answers to_writer_;
  Answers* output_ = nullptr;
};

}  // namespace trc
