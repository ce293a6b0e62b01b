#pragma once

#include <string>
#include <string_view>

#include "trc/v1/setup.pb.h"

namespace trc::cli {

// Reads a table of tools into the setup. The formats, told apart by what they hold:
//
//   - CSV with a header that names its columns, in any order: `number,radius` in mm, and as wanted
//     `diameter` in place of `radius`, `wear` (what the tool is larger by), `holds` (RADIUS or
//     DIAMETER: what the radius column and the wear are), `name`; `#` begins a comment.
//   - LinuxCNC: lines with T and D words, D the diameter in the unit of the setup; `;` begins a
//     comment.
//   - Fanuc: lines `G10 L12 P2 R5.` (radius) and `G10 L13 P2 R-0.02` (wear), in the
//     unit of the setup; other lines are passed over.
//   - Heidenhain: TOOL.T with its columns T, R and DR, the wear.
//
// Returns what is wrong, as a sentence; empty when all is read.
[[nodiscard]] std::string read_tool_table(std::string_view text, v1::ProgramSetup& setup);

// The same for a file; - reads nothing here.
[[nodiscard]] std::string read_tool_file(const std::string& path, v1::ProgramSetup& setup);

}  // namespace trc::cli
