#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/nc/dialect/interpreter.h"
#include "core/nc/program/fanuc_programs.h"
#include "core/nc/program/flow.h"

namespace trc {

// Reads NC text, also of programs that compute: its Interpreter sees the flat program.
//
// Text goes straight on to the Interpreter up to the first line that computes (a variable, a jump,
// a call). From there on it is collected, and executed at the end of the text. Of the text before
// that line up to `most_text_before` bytes are kept for jumps and calls; of a longer text none, and
// such a jump is refused (900305). Of ISG only lines that set variables are.
//
// A text of Fanuc that begins with an O may begin with a subprogram, whose main program stands
// after it. Its lines wait until one of them says that it is a main program (a tool, a work
// offset, a unit, M30), `most_text_before` bytes at most. Where none does, and it ends with M99 or
// computes, the whole text is collected, and the main program is looked for in it.
class ProgramReader {
 public:
  // Whoever feeds a long text asks after this much of it whether anybody still waits for the
  // result: reading it takes less than a millisecond.
  static constexpr std::size_t bytes_between_questions = 16U * 1024U;
  static constexpr std::size_t most_text_before = 64U * 1024U;
  // 900311 beyond.
  static constexpr std::size_t most_computing_text = 16U * 1024U * 1024U;

  // The interrupt is called from time to time while a program is executed.
  ProgramReader(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics,
                Checkpoint::Interrupt interrupt = {});
  ~ProgramReader();
  ProgramReader(const ProgramReader&) = delete;
  ProgramReader& operator=(const ProgramReader&) = delete;

  // As of Interpreter.
  bool feed(std::string_view text, std::vector<LinePointer>& lines);
  // After the last text: executes part of a program that computes. Returns whether more is
  // left.
  bool resolve(std::vector<LinePointer>& lines);
  // As of Interpreter; executes what is left.
  bool finish(std::vector<LinePointer>& lines);
  void recycle(LinePointer line) { interpreter_.recycle(std::move(line)); }

  // Lines of the text that was given.
  [[nodiscard]] std::uint64_t lines_read() const;
  // A line that computes has been seen.
  [[nodiscard]] bool is_computing() const { return computing_; }
  // 0 as long as nothing is computed.
  [[nodiscard]] std::uint64_t executed_lines() const { return flow_ ? flow_->executed_lines() : 0; }

  // Saves the collected text too; not allowed once it is executed.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(interpreter_, has_begun_, partial_, before_, lines_before_, before_is_whole_, passes_,
            computing_, text_, waits_, waiting_, first_program_, first_file_);
  }

 private:
  // Whether the lines of a text of Fanuc wait: nothing but comments was seen yet, or an O was.
  enum class Waits : std::uint8_t { for_head, for_main, not_any_more };

  [[nodiscard]] bool has_to_wait() const {
    return waits_ != Waits::not_any_more && setup_.dialect == DialectName::fanuc;
  }
  [[nodiscard]] std::size_t behind_next_line(std::string_view text, std::size_t at) const;
  bool begin(std::vector<LinePointer>& lines);
  bool take(std::string_view text, std::vector<LinePointer>& lines);
  bool end_text(std::vector<LinePointer>& lines);
  std::size_t wait(std::string_view text);
  bool lets_wait(std::string_view text);
  bool stop_waiting(std::string_view text, std::vector<LinePointer>& lines);
  bool find_main_program();
  bool refuse_order_of_programs(std::string detail, std::uint64_t line);
  bool check_order_of_files(std::string_view line, std::uint64_t number);
  [[nodiscard]] bool calls_what_stands_first(std::string_view line);
  bool split(std::string_view text, std::vector<LinePointer>& lines);
  bool pass_plain(std::string_view text, std::vector<LinePointer>& lines);
  void keep_what_tells(std::string_view text);
  bool keep_partial(std::string_view text, std::vector<LinePointer>& lines);
  bool pass(std::string_view text, std::vector<LinePointer>& lines);
  bool collect(std::string_view text, std::vector<LinePointer>& lines);
  bool check_last_line();
  bool begin_to_execute(std::vector<LinePointer>& lines);
  [[nodiscard]] bool has_rest() const { return rest_at_ < rest_.size(); }
  bool read_rest(std::vector<LinePointer>& lines);
  bool execute_next(std::vector<LinePointer>& lines);
  [[nodiscard]] program::ModalState modes() const;
  // The parts of what a line becomes: assignments for the machine, then the rest.
  enum class FlatText : std::uint8_t { settings, rest };
  // Reads lines from `at` on, until there are `most` in `lines`, and moves `at` past them.
  bool read_flat_lines(std::string_view flat, std::size_t& at, FlatText kind, std::size_t most,
                       std::vector<LinePointer>& lines);
  bool take_refusals();
  [[nodiscard]] Diagnostic with_place(Diagnostic found) const;

  ReaderLimits limits_;
  const ProgramState& state_;
  const ProgramSetup& setup_;
  Diagnostics& diagnostics_;
  Interpreter interpreter_;
  Checkpoint checkpoint_;

  bool has_begun_ = false;          // whether a byte order mark is there is known
  bool text_has_ended_ = false;     // the last line needs no line end
  bool passes_ = false;             // nothing of it may compute, or not any more
  std::string partial_{};           // of a line whose end is still to come; goes before other text
  std::string before_{};            // what went to the Interpreter, of ISG lines that tell a state
  std::uint64_t lines_before_ = 0;  // whole lines that did
  bool before_is_whole_ = true;     // it holds all of them

  Waits waits_ = Waits::for_head;
  std::string waiting_{};        // text that waits
  std::string first_program_{};  // the line of its O, where it need not be the main one
  std::string first_file_{};     // of an archive of Sinumerik: PART_MPF
  bool starts_at_main_ = false;  // which stands after what it calls
  std::size_t main_line_ = 0;
  bool main_is_known_ = false;
  std::string rest_{};  // collected, but nothing before it computes
  std::size_t rest_at_ = 0;

  bool computing_ = false;
  std::string text_{};  // collected
  std::unique_ptr<program::Flow> flow_;
  std::uint64_t lines_of_text_ = 0;
  bool executed_ = false;
  bool ended_ = false;  // with the line that is executed
  std::string flat_{};  // which it has become, the text after the end with it
  std::size_t flat_at_ = 0;
};

}  // namespace trc
