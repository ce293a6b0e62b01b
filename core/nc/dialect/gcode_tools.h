#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

namespace trc {

// What G41 and G42 need, and D words.
bool check_gcode_selection(Reading& reading, ProgramLine& line, BlockWords& block);

// The radius of the setup stands for the one register that the program selects with, where it has
// no tools (D-65). D0 may have taken it out of force.
bool take_only_register(Reading& reading, const ProgramLine& line, BlockWords& block,
                        std::int64_t number);

// With the name of the table that it is a slip of, if there is one.
[[nodiscard]] std::string name_not_in_table(const Reading& reading, const std::string& name);

// $TC_DP6[1,1]=5: the radius of edge 1 of tool 1; $TC_DP15 is its wear (D-75).
bool read_edge_data(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

// G10 L12 P R of Fanuc, G10 L1 P R of LinuxCNC: the program gives a tool its radius, L13 P R of
// Fanuc its wear (D-118).
bool take_tool_data(Reading& reading, ProgramLine& line, BlockWords& block);

// Of the tool that M6 has put there, wear included, mm.
[[nodiscard]] std::optional<double> spindle_diameter(const Reading& reading);

}  // namespace trc
