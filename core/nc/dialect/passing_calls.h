#pragma once

#include <cstdint>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// Reads L NAME, V.P. = … and the like of ISG, which pass as they stand. Whether it is such a line.
bool read_passing_line(Reading& reading, ProgramLine& line, BlockWords& block);

// T5 LM06: a call after words that do not move. `begin` is where it stands.
bool read_call_behind_words(Reading& reading, std::uint32_t begin, ProgramLine& line,
                            BlockWords& block);

// A call, by a program that computes, of a text that only the machine has.
bool read_call_of_machine(Reading& reading, ProgramLine& line, BlockWords& block);

// Position, modes and tool become unknown, except those that stay by pass_words.
void forget_what_a_call_may_change(Reading& reading, ProgramLine& line, BlockWords& block,
                                   std::string_view call);

// Takes a call into account. Calls declared in pass_words do not change the tool.
void take_call(Reading& reading, const ProgramLine& line, std::string_view call);

// After a call the subprogram has decided whether G00 or G01, G90 or G91 holds: until the program
// says so anew, only the control knows where a motion leads.
bool restate_modes(Reading& reading, ProgramLine& line, BlockWords& block);

// Watches whether the tool may differ from that of the last contour: 900225.
bool watch_tool(Reading& reading, const ProgramLine& line, const BlockWords& block);

// At the start of a contour (D-78).
bool warn_of_other_tool(Reading& reading, const ProgramLine& line, std::uint32_t begin);

// Reports once (D-81): the modes before a call are taken to hold after it, unless programmed anew.
bool note_unknown_call(Reading& reading, const ProgramLine& line, const BlockWords& block);

}  // namespace trc
