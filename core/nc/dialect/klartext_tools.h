#pragma once

#include <cstddef>
#include <string_view>

#include "core/nc/dialect/reading.h"

namespace trc {

// TOOL CALL: the tool, its axis and its oversizes.
bool read_tool_call(Reading& reading, ProgramLine& line, std::size_t begin,
                    std::string_view statement);

// Q5 = +0.05, FN 0: Q5 = +0.05 (D-79), also of a formula (D-85). Values computed otherwise, read
// from the machine or set in a line that may be skipped are not followed.
void take_assignment(Reading& reading, const ProgramLine& line, std::string_view statement);

// Cycles set the parameters given to them and those they measure; called programs may set any.
void forget_parameters(Reading& reading, std::string_view statement);

// TOOL DEF 5 L+0 R+4 gives a tool its radius; TOOL DEF 5 and TOOL DEF "MILL" prepare it.
bool read_tool_definition(Reading& reading, ProgramLine& line, std::size_t begin,
                          std::string_view statement);

// Selects RL, RR or R0, with the radius of the tool that has been called.
bool select_in_klartext(Reading& reading, const ProgramLine& line, Side side, std::size_t begin);

}  // namespace trc
