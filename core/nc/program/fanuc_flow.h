#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/nc/program/fanuc_programs.h"
#include "core/nc/program/gcode_flow.h"
#include "core/nc/program/said_words.h"

namespace trc::program {

// Whether the line has a variable, an expression, a jump, a loop or a call.
[[nodiscard]] bool fanuc_computes(std::string_view line);

// Custom macros of Fanuc, with the extensions of Haas.
//
//   - The main program may stand after the programs that it calls: it begins in the line
//     of its O. Programs that no followed call reaches come out after its end, as they
//     stand.
//   - #1 … #33 belong to the main program and to each G65 call; M98 and M97 share those of their
//     caller. #100 … #499 begin vacant. #500 … #999 outlast the machine's power: one that the
//     program has not set is known from the setup alone, as everything from #1000 on.
//   - A word whose variable is vacant is ignored.
//   - GOTO looks for its N after it first, then from the beginning, in its own O program.
//   - M98 P31001 is O31001, or O1001 three times where there is no such program.
//   - M99 P goes on in the caller (Fanuc) or in the subprogram itself (Haas): where both have the
//     N, it is refused.
class FanucFlow : public GcodeFlow {
 public:
  FanucFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text, std::size_t start);

 private:
  [[nodiscard]] Step execute_next(std::string& flat) override;
  [[nodiscard]] bool execute_line(std::string& flat) override;
  void keep_variables(std::size_t levels) override { locals_.resize(levels); }
  // Programs with a name get numbers from here on.
  static constexpr std::int64_t first_named = 1'000'000'000'000;
  // #0 is not used; nothing: vacant.
  struct Locals : std::array<std::optional<double>, 34> {
    bool are_lost = false;               // the machine may have set any of them
    std::set<std::size_t> of_machine{};  // depend on values given for the machine
  };
  // An O program, or the one without number that a text begins with.
  struct Unit {
    std::size_t text = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
    std::int64_t number = -1;
  };
  // Where its jumps and loops lead.
  struct Outline {
    std::map<std::int64_t, std::vector<std::size_t>> labels{};  // lines of an N, ascending
    std::map<std::size_t, std::size_t> feet{};                  // of loops, by their heads
    std::map<std::size_t, std::size_t> heads{};                 // by their feet
  };

  // fanuc_flow.cpp: programs and the order of their lines. The number for O1001 or O<NAME>; -1: the
  // line begins no program.
  std::int64_t number_of_program(const ProgramHead& head);
  std::int64_t number_of_named(std::string_view name);
  [[nodiscard]] std::string name_of(std::int64_t number) const;
  void add_units(std::size_t text);
  bool execute(std::string& flat);
  bool execute_behind_head(std::string& flat, const ProgramHead& head);
  bool end_of_unit(std::string& flat);
  bool end_main_program(std::string& flat);
  [[nodiscard]] std::size_t end_of_text_behind(const Frame& main) const;
  [[nodiscard]] std::vector<bool> resolved(const std::vector<ProgramOfText>& programs) const;
  void keep_what_is_not_resolved();
  Step copy_next(std::string& flat);
  void note_what_is_said(std::string_view flat);
  void note_line(std::string_view line);
  void note_registers(std::string_view line);
  void forget_registers();
  void note_returns(const Unit& main);

  // fanuc_control.cpp: branches, loops and jumps.
  [[nodiscard]] const Outline& outline_of(const Frame& frame);
  [[nodiscard]] std::size_t number_of_loop(std::string_view line, std::size_t at) const;
  bool execute_statement(std::string& flat);
  bool branch(std::string& flat, ExpressionReader& expression);
  enum class LoopHead : std::uint8_t { with_condition, endless };  // WHILE [ ] DO, DO
  bool loop(std::string& flat, ExpressionReader& expression, LoopHead head);
  // Goes to the line after the ELSE or ENDIF that belongs to the current line.
  bool go_behind_foot(const char* missing);
  bool end_loop(std::string& flat, ExpressionReader& expression);
  bool jump(ExpressionReader& expression);
  bool go_to(std::int64_t number, std::size_t begin);
  [[nodiscard]] std::optional<std::size_t> line_of(const Frame& frame, std::int64_t number);

  // fanuc_words.cpp: lines of words, and calls.
  bool execute_words(std::string& flat);
  bool call(std::string& flat, ComputedWord& word);
  // M98 <NAME>; nothing: the line is no such call.
  [[nodiscard]] std::optional<bool> call_by_name(std::string& flat);
  // DPRNT and BPRNT of variables; nothing: the line is no such output.
  [[nodiscard]] std::optional<bool> print(std::string& flat);
  bool call_own_lines(std::string& flat, const ProgramCall& call);
  bool call_macro(std::string& flat, const ComputedWord& word);
  [[nodiscard]] bool moves() const;
  bool take_arguments(const ComputedWord& word, Locals& locals);
  bool return_from(std::string& flat, ComputedWord& word);
  // M99 P of the main program.
  bool return_within_main(std::string& flat, std::int64_t number, std::size_t begin);
  [[nodiscard]] bool never_leaves(std::size_t first, std::size_t last) const;
  [[nodiscard]] bool repeats_from(std::size_t line, std::int64_t number) const;
  bool enter_unit(std::string& flat, const Unit& unit, std::uint64_t times, Locals* locals);
  [[nodiscard]] std::optional<Unit> unit_of(std::int64_t number, std::size_t begin);
  // Whether the macro is not in the program but on the machine: O8000 to O9999, or as declared.
  [[nodiscard]] bool is_of_the_machine(std::int64_t number) const;
  bool call_modally(std::string& flat);
  // M98: a subprogram sees the local variables of its caller; G65, G66: a macro has its own.
  enum class Called : std::uint8_t { subprogram, macro };
  bool pass_call(std::int64_t number, Called called);
  void forget_what_the_machine_may_set(std::int64_t number);
  // Write lines that set what the program has set, for a macro of the machine that is called next.
  void write_value(std::string& flat, std::int64_t number, const std::optional<double>& content);
  void write_values(std::string& flat, Called called);
  void write_lasting_values(std::string& flat);

  // fanuc_variables.cpp
  bool assign(std::string& flat, std::size_t at);
  [[nodiscard]] std::string data_setting(std::int64_t number, const Value& value) const;
  bool set(std::int64_t number, const Value& value, std::size_t begin);
  [[nodiscard]] Value value_of(ExpressionReader& expression, std::int64_t number,
                               std::size_t begin);
  // Whether the variable outlasts the power of the machine.
  [[nodiscard]] static bool is_kept(std::int64_t number) { return number >= 500 && number < 1000; }
  // "#10100", with its meaning where two controls differ.
  [[nodiscard]] static std::string told_variable(std::int64_t number);
  // A system variable that trc follows: its value, and whether the program has changed it.
  struct Followed {
    bool is_followed = false;
    bool is_changed = false;
    std::optional<double> value{};
  };
  [[nodiscard]] Followed followed(std::int64_t number) const;
  [[nodiscard]] Followed followed_place(std::int64_t number) const;
  [[nodiscard]] Value value_followed(ExpressionReader& expression, std::int64_t number,
                                     std::size_t begin, const Followed& state);
  Value lost(ExpressionReader& expression, std::int64_t number, std::size_t begin);
  [[nodiscard]] Value content_or_vacant(const std::optional<double>& content) const;
  Value read(ExpressionReader& expression) override;
  bool exists(ExpressionReader& expression) override;
  [[nodiscard]] std::int64_t number_of_variable(ExpressionReader& expression);

  std::string behind_head_{};        // of the line that is executed
  bool head_came_out_ = false;       // of the main program
  std::vector<std::size_t> copied_;  // lines of the program that come out as they stand
  std::size_t next_copied_ = 0;
  bool has_ended_ = false;  // but for what is copied
  std::vector<Unit> units_{};
  std::vector<std::string> names_{};  // of programs without a number, in capitals
  std::map<std::string, std::int64_t> numbers_of_names_{};
  std::map<std::int64_t, std::vector<std::size_t>> units_of_number_{};
  std::map<std::pair<std::size_t, std::size_t>, Outline> outlines_{};
  std::vector<bool> entered_{};  // by unit
  std::vector<Locals> locals_{1};
  std::map<std::int64_t, std::optional<double>> common_{};
  std::set<std::int64_t> unwritten_{};  // common variables set since they were last written
  // G66
  struct ModalCall {
    std::int64_t number = 0;
    std::uint64_t times = 1;
    Locals locals{};
    std::size_t depth = 0;  // of the frame it holds in
    bool is_of_machine = false;
  };
  std::optional<ModalCall> modal_call_{};
  SaidWords said_{};
  // The variables where a loop by M99 P begins.
  struct Variables {
    Locals locals{};
    std::map<std::int64_t, std::optional<double>> common{};
  };
  std::map<std::int64_t, std::uint64_t> returns_to_{};  // N of M99 P: how often it came out
  Variables at_start_{};
  std::map<std::size_t, Variables> at_line_{};
  std::size_t start_ = 0;
  std::string lost_to_{};  // the last macro of the machine, which may have set all common ones
};

}  // namespace trc::program
