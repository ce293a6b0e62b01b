#pragma once

#include <string>
#include <string_view>

#include "trc/v1/setup.pb.h"

namespace trc::cli {

// Reads a table of tools into the setup. The formats, told apart by what they hold:
//
//   - CSV with a header that names its columns, in any order: `number,radius` in mm, and as wanted
//     `name` (beside or in place of `number`), `edge` (D of Sinumerik), `diameter` in place of
//     `radius`, `wear` (what the tool is larger by), `holds` (RADIUS or DIAMETER: what the radius
//     column and the wear are), `unit` (mm or inch: what the row counts in); `#` begins a comment.
//     A line `unit,inch` above the header counts for all rows.
//   - LinuxCNC: lines with T and D words, D the diameter in the unit of the setup; `;` begins a
//     comment.
//   - Fanuc: lines `G10 L12 P2 R5.` (radius) and `G10 L13 P2 R-0.02` (wear), in the unit that a
//     line with G20 or G21 before it says, else in that of the setup; R without a decimal point as
//     `whole_numbers` of the setup says; other lines are passed over.
//   - Sinumerik: lines `$TC_DP6[t,d]=5` (radius) and `$TC_DP15[t,d]=-0.02` (wear) in the unit of
//     the setup, t the tool and d its edge, `$TC_TP2[t]="NAME"`, as a TOA file has them; other
//     lines are passed over. Tools of turning (`$TC_DP1` 500 to 599) are left out.
//   - Heidenhain: TOOL.T with its columns T (5.2 is index 2 of tool 5), NAME, R and DR, the wear.
//   - ISG: lines `wz[5].radius 54000` in 0.1 um, in 0.0001 inch where `wz[5].mass_einheit` is 1.
//     Tools of turning and grinding (`typ`), and those with `gueltig 0`, are left out.
//
// Returns what is wrong, a sentence a line: the first faulty lines of the table and how many more
// there are. Empty when all is read.
[[nodiscard]] std::string read_tool_table(std::string_view text, v1::ProgramSetup& setup);

// Reads a file as such a table; - reads nothing here. `unit_unsaid`: it was read in mm as neither
// it nor the setup names a unit.
[[nodiscard]] std::string read_tool_file(const std::string& path, v1::ProgramSetup& setup,
                                         bool& unit_unsaid);

// Whether a program counts in inch, at least in part: its text says so (G20, G70, G700, INCH in
// Klartext), or it names no unit and the one it is `given` with is the inch. For a note, never for
// reading it.
[[nodiscard]] bool says_inch(std::string_view program, v1::Dialect dialect, v1::LengthUnit given);

}  // namespace trc::cli
