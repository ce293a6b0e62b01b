#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/nc/program/gcode_flow.h"

namespace trc::program {

// Whether the line has a parameter, an expression, an O word with a statement, or a call.
[[nodiscard]] bool linuxcnc_computes(std::string_view line);

// The name of a parameter or a label: in lower case, without blanks.
[[nodiscard]] std::string plain_name(std::string_view name);

// Parameters and O words of LinuxCNC.
//
//   - #1 … #30 and #<name> belong to the main program and to each O call; a call begins with the
//     numbered ones of its caller, but for its arguments. #31 … #5000 and #<_name> are everyone's.
//   - Assignments in a line take effect after the line.
//   - A parameter that was never assigned is refused, also a numbered one, which the control takes
//     for 0 unless its parameter file says otherwise.
//   - O words of one label belong together within one subprogram.
//   - M98 and M99 as of Fanuc, with the parameters of the caller.
class LinuxcncFlow : public GcodeFlow {
 public:
  LinuxcncFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text, std::size_t start);

 private:
  [[nodiscard]] Step execute_next(std::string& flat) override;
  [[nodiscard]] bool execute_line(std::string& flat) override;
  void keep_variables(std::size_t levels) override { locals_.resize(levels); }
  enum class Statement : std::uint8_t {
    none,  // the number of a program
    sub,
    endsub,
    call,
    give_back,  // return
    if_true,
    elseif,
    otherwise,
    endif,
    while_true,
    endwhile,
    do_once,
    repeat,
    endrepeat,
    leave,  // break
    go_on,  // continue
  };
  struct OWord {
    std::size_t line = 0;
    Statement statement = Statement::none;
  };
  struct Locals {
    std::array<std::optional<double>, 31> numbered{};
    std::map<std::string, double, std::less<>> named{};
    std::set<std::string, std::less<>> of_machine{};  // depend on values given for the machine
    // Repetitions left, by text and line of `repeat`.
    std::map<std::pair<std::size_t, std::size_t>, std::int64_t> repetitions{};
  };
  struct Target {
    std::string name{};  // empty: a number
    std::int64_t number = 0;
  };
  struct Assignment {
    Target target{};
    double value = 0;
    std::size_t begin = 0;
    KeptText kept{};     // what the value hangs on
    std::string text{};  // of the value, where the control computes it (D-88)
  };

  // Where the arguments of a call stand in the line.
  struct Arguments {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  static Statement statement_at(std::string_view line, std::size_t& at);
  void add_o_words(std::size_t text);
  // The label after the O at `at`; `at` moves past the label. Nothing where it is refused.
  std::optional<std::string> label_at(std::size_t& at);
  // The lines of a text with this statement of the label, "100" or "<name>", in the scope: the line
  // after its `sub`, 0 outside of all.
  [[nodiscard]] std::span<const std::size_t> lines_of(std::size_t text, std::size_t scope,
                                                      const std::string& label,
                                                      Statement statement) const;
  // The next O word of the label and the scope after (or before) the current line whose
  // statement is one of these.
  [[nodiscard]] std::optional<OWord> next_of(const std::string& label,
                                             std::initializer_list<Statement> statements) const;
  [[nodiscard]] std::optional<OWord> last_of(const std::string& label,
                                             std::initializer_list<Statement> statements) const;

  [[nodiscard]] std::int64_t& repetitions_of(std::size_t line) {
    return locals_.back().repetitions[{frame().text, line}];
  }

  bool end_main_program(std::string& flat);
  bool execute(std::string& flat);
  bool execute_words(std::string& flat);
  bool execute_statement(std::string& flat);
  bool follow(Statement statement, const std::string& label, std::size_t at, std::string& flat);
  bool choose(const std::string& label);
  bool loop_while(const std::string& label, bool holds);
  bool leave_or_go_on(Statement statement, const std::string& label);
  bool skip_behind(const std::optional<OWord>& word, std::string_view statement);
  bool condition(std::size_t& at, bool& holds);
  bool call_sub(const std::string& label, std::size_t at, std::string& flat);
  bool enter_sub(Frame sub, std::size_t at, Locals locals, std::string& flat);
  void call_sub_of_machine(const std::string& label, const Arguments& arguments,
                           std::span<const std::optional<double>> values, std::string& flat);
  bool call_program(ComputedWord& word, std::string& flat);
  bool return_from_sub(std::size_t at, std::string& flat);
  bool return_from_program(ComputedWord& word, std::string& flat);

  // linuxcnc_messages.cpp: output to screen, files and the machine.
  [[nodiscard]] std::string with_values(std::string_view comments) override;
  void append_message(std::string& out, std::string_view message) const;
  void write_values();
  void write_kept_assignments();

  bool scan_assignment(std::size_t& at) override;
  bool assign(const Assignment& assignment);
  [[nodiscard]] Target target_at(ExpressionReader& expression);
  [[nodiscard]] bool is_own(const Target& target) const;
  [[nodiscard]] static bool is_state(const Target& target);
  // Whether the control keeps the parameter beyond the end of the program.
  [[nodiscard]] bool outlives_program(const Target& target) const {
    return !is_own(target) && !is_state(target);
  }
  [[nodiscard]] const double* given_to(const Target& target) const;
  [[nodiscard]] bool is_of_machine(const Target& target) const;
  [[nodiscard]] bool is_given_state(const Target& target) const;
  [[nodiscard]] static std::string spelled(const Target& target);
  [[nodiscard]] Value value_of(ExpressionReader& expression, const Target& target,
                               std::size_t begin);
  [[nodiscard]] std::optional<double> content_of(const Target& target) const;
  Value read(ExpressionReader& expression) override;
  bool exists(ExpressionReader& expression) override;

  using Labelled =
      std::map<std::tuple<std::size_t, std::string, Statement>, std::vector<std::size_t>>;
  std::vector<Labelled> o_words_{};  // of each text: lines by scope, label and statement
  std::vector<Locals> locals_{1};
  std::map<std::int64_t, double> common_{};
  std::map<std::string, double, std::less<>> globals_{};
  // Of both kinds: those set since they were last written.
  std::set<std::int64_t> unwritten_numbers_{};
  std::set<std::string> unwritten_names_{};
  std::vector<Assignment> assignments_{};  // of the line
  std::string lost_to_{};  // a call of the machine, which may have set what is everyone's
};

}  // namespace trc::program
