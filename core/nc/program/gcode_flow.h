#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/program/flow.h"
#include "core/nc/program/gcode_line.h"

namespace trc::program {

// The common part of Fanuc and LinuxCNC: lines of letters whose values may be computed, and the
// lines they become.
class GcodeFlow : public Flow, protected Variables {
 protected:
  GcodeFlow(const ProgramSetup& setup, const Lent& lent, const Grammar& grammar)
      : Flow(setup, lent), grammar_(grammar) {}

  // Takes the next line of the frame.
  void begin_line();
  [[nodiscard]] ExpressionReader expression_at(std::size_t at) {
    return {grammar_, line_, at, *this};
  }

  // Reads the words of the line, with their values.
  bool scan_words();
  // Comments with the values that they print; only LinuxCNC has them.
  [[nodiscard]] virtual std::string with_values(std::string_view comments) {
    return std::string(comments);
  }
  // Reads an assignment among words, which only LinuxCNC has; false where it is refused.
  virtual bool scan_assignment(std::size_t& at);
  [[nodiscard]] ComputedWord* word_of(char letter);
  // The value of the P or L of a call, whole and not negative.
  [[nodiscard]] std::optional<std::int64_t> whole_value(const ComputedWord* word,
                                                        const ComputedWord& of);
  // Whether the line has a word that is left in it.
  [[nodiscard]] bool has_words_left() const;

  // M98, M97: the program called, and how often.
  struct ProgramCall {
    std::int64_t number = 0;
    std::uint64_t times = 1;
    bool says_times = false;
    std::size_t begin = 0;  // byte of the line
  };
  // Takes the words of a call out of the line and writes the rest of the line, which is executed
  // first. Nothing where it is refused.
  [[nodiscard]] std::optional<ProgramCall> take_call(ComputedWord& word, std::string& flat);

  bool write_line(std::string& flat);
  void write_as_it_is(std::string& flat);
  // Writes the comment that introduces the lines of a subprogram, with the comments of the call.
  void write_call(std::string& flat, std::string_view name);
  // Writes the N word of the line, then `text`.
  void write_behind_number(std::string& flat, std::string_view text);
  // Keeps only the comments of a statement; refused where anything else follows it.
  bool finish_statement(std::string& flat, std::size_t at);
  // The end of these lines without the `%` that nothing but comments follows in them.
  [[nodiscard]] std::size_t without_end_of_tape(std::size_t begin, std::size_t end) const;
  // Ends the program with the end of the tape: its last `%` and the text after it (D-143).
  bool end_program(std::string& flat);

  // State of the line being executed.
  std::string_view line_{};
  LineHead head_{};
  std::vector<ComputedWord> words_{};
  bool called_alone_ = false;           // nothing but the call stands in it
  bool is_read_by_the_reader_ = false;  // it holds what is refused there by its name
  bool has_computed_ = false;           // a value, or an assignment
  std::size_t written_behind_ = 0;      // the end of the text after M02 or M30 that came out

 private:
  // The end of the text from a `%` on that nothing leads to.
  [[nodiscard]] std::size_t end_of_text_from(std::size_t percent) const;
  void write_lines(std::string& flat, std::size_t begin, std::size_t end);
  bool scan_value(ComputedWord& word, std::size_t& at);
  void round_whole_words();
  // For a word with a supposed value: takes a tool that exists.
  void suppose_tool(ComputedWord& word) const;
  [[nodiscard]] PointStyle style_of(char letter) const;
  // Whether positions in the line, which has been read, need no more decimals than the output has.
  [[nodiscard]] bool rounds_places() const;
  // Of the value of the word, at most as many as leave it the digits that the control takes.
  [[nodiscard]] int decimals_of(const ComputedWord& word) const;
  [[nodiscard]] int decimals_of(char letter) const;

  const Grammar& grammar_;
};

// Whether the tape begins or ends in the line.
[[nodiscard]] bool is_percent(std::string_view line);

}  // namespace trc::program
