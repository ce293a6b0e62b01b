#pragma once

#include <cstdint>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

namespace trc {

// L NAME, V.P. = … and the like of ISG, which pass as they stand. Whether it is such a line.
bool read_passing_line(Reading& reading, ProgramLine& line, BlockWords& block);

// T5 LM06: a call behind words that do not move. `begin` is where it stands.
bool read_call_behind_words(Reading& reading, std::uint32_t begin, ProgramLine& line,
                            BlockWords& block);

// What a program that computes calls and only the machine has.
bool read_call_of_machine(Reading& reading, ProgramLine& line, BlockWords& block);

// Position, modes and tool, as far as pass_words does not say that they stay.
void forget_what_a_call_may_change(Reading& reading, ProgramLine& line, BlockWords& block,
                                   std::string_view call);

// Of those that pass_words declares none changes the tool.
void take_call(Reading& reading, const ProgramLine& line, std::string_view call);

// Whether G00 or G01, G90 or G91 holds behind a call, the subprogram has decided: until the program
// says it anew a motion leads to where only the control knows.
bool restate_modes(Reading& reading, ProgramLine& line, BlockWords& block);

// Whether another tool may be in the spindle than at the last contour: 900225.
bool watch_tool(Reading& reading, const ProgramLine& line, const BlockWords& block);

// At the begin of a contour (D-78).
bool warn_of_other_tool(Reading& reading, const ProgramLine& line, std::uint32_t begin);

// Once (D-81): what holds behind a call is what held before it, unless the program says it anew.
bool note_unknown_call(Reading& reading, const ProgramLine& line, const BlockWords& block);

}  // namespace trc
