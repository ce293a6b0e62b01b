#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/state/program_setup.h"

namespace trc::program {

// The beginning of a line of ISG: a `/`, a block number, a target of jumps.
struct IsgHead {
  bool to_skip = false;
  std::int64_t number = -1;  // -1: none
  std::size_t number_begin = 0;
  std::size_t number_end = 0;
  bool is_target = false;  // N10:
  std::string label{};     // of [NAME], in capitals; empty: none
  std::size_t behind = 0;  // the first sign after all
};
[[nodiscard]] IsgHead isg_head_of(std::string_view line);

// The position after the comment that begins at `at`, which may nest; 0: it has no end.
[[nodiscard]] std::size_t behind_isg_comment(std::string_view line, std::size_t at);
// Where the command ends that begins with the `#` at `at`, without blanks after it.
[[nodiscard]] std::size_t end_of_isg_command(std::string_view line, std::size_t at);
// Whether nothing but comments stands from `at` on.
[[nodiscard]] bool is_isg_line_over(std::string_view line, std::size_t at);
// The word after the sign at `at`, in capitals: IF of $IF, VAR of #VAR.
[[nodiscard]] std::string word_behind_sign(std::string_view line, std::size_t at);

// Whether a parameter (P1, PP1, P[P1]) or a variable (V.P.NAME) begins there.
[[nodiscard]] bool is_isg_parameter_at(std::string_view line, std::size_t at);
[[nodiscard]] bool is_isg_variable_at(std::string_view line, std::size_t at);
// Whether text from a zero offset on (V.G.NP[1].V.X = P1) is to be computed: the machine knows its
// own values, but neither those of the program nor the radii that TRC resolves.
[[nodiscard]] bool zero_offset_hangs_on_program(std::string_view text);
// Whether the value there has to be computed: a variable, a bracket or a
// function, with a sign or without. Whether a variable stands in S[M3
// REV=P1].
[[nodiscard]] bool computes_spindle(std::string_view words);
[[nodiscard]] bool is_isg_expression_at(std::string_view line, std::size_t at);

// %L NAME: a subprogram before its program. Empty: the line is none.
[[nodiscard]] std::string isg_subprogram_of(std::string_view line);
[[nodiscard]] bool begins_isg_program(std::string_view line);

// L NAME, LL NAME.
struct IsgCall {
  bool is_call = false;
  bool is_local = false;
  bool is_joined = false;  // no blank before the name: of LLNAME both L may be the call
  std::string name{};      // in capitals, without folder; with its ending
  std::size_t begin = 0;   // of the name
  std::size_t end = 0;
};
[[nodiscard]] IsgCall isg_call_at(std::string_view line, std::size_t at);
// T5 LM06: where the call begins that is the last word of a block; npos: none.
[[nodiscard]] std::size_t isg_call_behind_words(std::string_view line, std::size_t at);
// The text of the setup that a call names, by the name of its file; null: none.
[[nodiscard]] const std::string* given_subprogram(const ProgramSetup& setup, std::string_view name);
// The name in capitals, without folder and without its ending.
[[nodiscard]] std::string plain_file_name(std::string_view name);

// Whether the line has a variable, an expression, a control statement or a call that is followed.
[[nodiscard]] bool isg_computes(const ProgramSetup& setup, std::string_view line);
// Whether #COMMENT BEGIN or END stands in the line.
[[nodiscard]] bool bounds_isg_comment(std::string_view line);
// For such a line: whether it is BEGIN.
[[nodiscard]] bool begins_isg_comment(std::string_view line);
// For a line that computes nothing: whether later lines depend on it (assignment, comment).
[[nodiscard]] bool isg_tells_state(std::string_view line);
// Whether a text has none of the signs that such lines are written with.
[[nodiscard]] bool is_plain_isg(std::string_view text);

// Whether a value goes on with this sign, or closes a bracket that was not opened.
[[nodiscard]] inline bool is_isg_operator(char sign) {
  return sign != '\0' && std::string_view("+-*<>=&|^!]").find(sign) != std::string_view::npos;
}

}  // namespace trc::program
