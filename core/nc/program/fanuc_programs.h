#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/program/program_text.h"

// The programs in a text of Fanuc, and which of them call each other. The checkpoint is passed for
// each line.

namespace trc::program {

// O1001, :1001, O<PART1> at the beginning of a line, <PART1> alone in it. The O is a word of its
// block as N is: what stands after it is executed.
struct ProgramHead {
  std::string name{};        // "1001", "<PART1>" in capitals; empty: the line begins no program
  std::int64_t number = -1;  // -1: it has a name
  std::size_t begin = 0;     // bytes of the line
  std::size_t behind = 0;

  [[nodiscard]] bool is_there() const { return !name.empty(); }
  // The head as people write it: O0100, O<PART1>.
  [[nodiscard]] std::string told() const;
};
[[nodiscard]] ProgramHead program_head_of(std::string_view line);

// A quick test, made for every line, whether it may begin a program.
[[nodiscard]] bool may_begin_program(std::string_view line);
// The line with blanks in place of the O, so that its columns stay.
[[nodiscard]] std::string without_head(std::string_view line, const ProgramHead& head);

// The programs that lines call by M98, G65 and G66, by the name of their head.
struct ProgramCalls {
  std::set<std::string> names{};
  std::set<std::string> milled{};  // by G150 of Haas, which stays a call of the machine
  bool is_computed = false;        // one depends on a value: it may be any

  [[nodiscard]] bool say(const std::string& name) const {
    return names.contains(name) || milled.contains(name);
  }
  [[nodiscard]] bool may_lead_to(const std::string& name) const { return is_computed || say(name); }
};
void add_calls(std::string_view line, ProgramCalls& calls);

// A program of a text, from the line of its O on; the first one may have none.
struct ProgramOfText {
  ProgramHead head{};
  std::size_t begin = 0;
  std::size_t end = 0;
  bool ends_all = false;  // it has M02 or M30
  bool returns = false;   // it has M99
  ProgramCalls calls{};
};
[[nodiscard]] std::vector<ProgramOfText> programs_of(const ProgramText& text,
                                                     Checkpoint& checkpoint);

// Controls store programs by number, so a subprogram may stand before its caller.
struct MainProgram {
  std::size_t line = 0;     // of its O
  bool is_first = true;     // of the text
  std::string first{};      // of the text, as it is told, where that is another one
  std::string ambiguous{};  // why the main program is not known; empty: it is
};
// `begun`: the first program, where its O stands before the text.
[[nodiscard]] MainProgram main_program_of(const ProgramText& text, const ProgramHead& begun,
                                          Checkpoint& checkpoint);

// Whether the line has a word that main programs begin or end with: a tool, a work offset, a unit,
// a reference point, M02, M30.
[[nodiscard]] bool tells_main_program(std::string_view line);

}  // namespace trc::program
