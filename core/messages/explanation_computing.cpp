#include <algorithm>
#include <array>

#include "core/messages/explanation_tables.h"

namespace trc {
namespace {

constexpr auto rows = std::to_array<Explanation>({
    {.code = Code::too_many_lines_executed,
     .meaning = "Loops, jumps and calls are followed, and every line that is executed becomes a "
                "line of the flat program. A bound keeps a loop without end from running forever.",
     .causes = {"The count of a loop is not raised, or is compared the wrong way round.",
                "A jump back without a condition, as for a bar feeder or a warm-up."},
     .on_command_line = "Look for a loop that never ends. A program that is meant to be so long: "
                        "--max-executed-lines.",
     .example = "N10 G0 X0 Y0\n"
                "GOTO 10\n",
     .options = "--dialect fanuc --max-executed-lines 1000"},
    {.code = Code::calls_too_deep,
     .meaning = "Each call is executed within the one before. Controls allow 4 to 10 levels, and "
                "32 are followed here.",
     .causes = {"A subprogram calls itself, by itself or by way of another one."},
     .example = "G0 X0 Y0\n"
                "M98 P100\n"
                "M30\n"
                "O100\n"
                "M98 P100\n"
                "M99\n",
     .options = "--dialect fanuc"},
    {.code = Code::variable_unset,
     .meaning = "What the variable holds is known to the machine alone, or to nobody. Nothing is "
                "put in its place.",
     .causes = {"A variable that keeps its value at the machine (#500 and above of Fanuc) is set "
                "by hand there.",
                "A slip in its number or name.",
                "A subprogram is called without an argument that it needs."},
     .on_command_line = "Set it in the program, or give its value: --variable NAME=VALUE.",
     .example = "G0 X#500 Y0\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::division_by_zero,
     .meaning = "The divisor of a division or of MOD is 0 when the line is executed.",
     .causes = {"A variable in the divisor is vacant, which counts as 0.",
                "A count of 0 was given, as of holes or of passes."},
     .example = "#1=0\n"
                "G0 X[10/#1]\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::jump_target_unknown,
     .meaning = "A jump needs one place to go on. A subprogram has numbers of its own, which "
                "jumps from outside do not reach.",
     .causes = {"The number was lost when the program was numbered anew.",
                "The target stands in another program of the file.",
                "After M99 P both the subprogram and its caller have the number: Fanuc means "
                "the caller, Haas the subprogram."},
     .example = "G0 X0 Y0\n"
                "GOTO 500\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::subprogram_unknown,
     .meaning = "What the subprogram moves is part of the path. Files are not looked for unless "
                "they are given.",
     .causes = {"The subprogram is in the memory of the control, or in a file of its own.",
                "A slip in its number or name."},
     .on_command_line = "Put it into the same file, where the dialect has it (ISG: before "
                        "the program, after %L NAME), or give its file: --subprograms FILE, or "
                        "the folder.",
     .example = "G0 X0 Y0\n"
                "M98 P1001\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::machine_state,
     .meaning = "Positions, offsets, times, signals and the result of a probe are known when the "
                "program runs, not before.",
     .causes = {"A system variable, as #5041 or #5021.",
                "A line that writes an offset of the machine.", "A program that measures."},
     .on_command_line = "Where its value is known, give it: --variable NAME=VALUE; else take the "
                        "line out.",
     .example = "#100=#5041\n"
                "G0 X#100\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::expression_invalid,
     .meaning = "Something stands where a number, a variable, an operator or the end of the line "
                "belongs.",
     .causes = {"A bracket is missing.",
                "Arithmetic after an address without brackets, X#1+5 for X[#1+5].",
                "Parentheses, which are comments here, in place of brackets."},
     .example = "#1=5\n"
                "G0 X#1+5\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::value_invalid,
     .meaning = "The root of a negative number, the arc sine of more than 1, a variable or a "
                "program whose number is no whole one: no control can go on with that.",
     .causes = {"The data of a macro do not fit one another, as a chord longer than the diameter.",
                "A variable was mistaken for another one."},
     .example = "#1=2\n"
                "G0 X[ASIN[#1]]\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::block_structure,
     .meaning = "Loops and branches are pairs of lines, and a subprogram ends where it returns.",
     .causes = {"The numbers after DO and END differ.",
                "Loops overlap in place of lying within one another.",
                "M99 is missing at the end of a subprogram."},
     .example = "#1=0\n"
                "WHILE [#1 LT 3] DO1\n"
                "#1=#1+1\n"
                "END2\n"
                "M30\n",
     .options = "--dialect fanuc"},
    {.code = Code::computing_text_too_long,
     .meaning = "From its first line with a variable, a jump or a call on a program is held as a "
                "whole, as any line may be jumped to.",
     .causes = {"One line that computes before the output of a CAM system."},
     .example = "#1=0\n"
                "G01 X1 F500\n"
                "M30\n",
     .options = "--dialect fanuc",
     .repeated = "G01 X1 F500\n",
     .times = 1'500'000},
    {.code = Code::program_alarm,
     .meaning = "#3000 stops a machine with a text. A program uses it where its data are not as "
                "it needs them.",
     .causes = {"An argument of a macro is missing or not allowed."},
     .example = "#3000=1 (NO DEPTH)\n"
                "M30\n",
     .options = "--dialect fanuc"},
});

static_assert(std::ranges::is_sorted(rows, {}, &Explanation::code));

}  // namespace

std::span<const Explanation> explanations_of_computing() { return rows; }

}  // namespace trc
