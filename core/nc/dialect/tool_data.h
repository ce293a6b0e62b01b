#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

namespace trc {

// The tool of T="5" where no tool of the table has that name: tool 5. 0: it is no number.
[[nodiscard]] std::int64_t number_of_tool_named(std::string_view name, const ToolInForce& tools);

// "MILL" in quotes.
[[nodiscard]] std::string quoted(const std::string& name);

// The name, with the similar name of the table that was probably meant, if there is one.
[[nodiscard]] std::string name_not_in_table(const Reading& reading, const std::string& name);

// $TC_DP6[1,1]=5: the radius of edge 1 of tool 1; $TC_DP15 is its wear (D-75).
bool read_edge_data(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

// G10 L12 P R of Fanuc, G10 L1 P R of LinuxCNC: the program gives a tool its radius, L13 P R of
// Fanuc its wear (D-118).
bool take_tool_data(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
