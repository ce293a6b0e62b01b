#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/nc/program/flow.h"
#include "core/nc/program/sinumerik_line.h"

namespace trc::program {

// The language of Sinumerik.
//
//   - R parameters are everyone's and outlast the program: what it has not set itself is known
//     from the setup alone. What DEF and PROC declare belongs to the main program and to each
//     call, begins with 0 and has a type: INT is rounded, and nothing is kept beyond its range.
//   - A program, or a subprogram, is a text of its own, or begins with its %_N_NAME_SPF or PROC.
//   - Jumps, REPEAT and CASE look for labels and block numbers in their own program.
//   - The control structures have lines of their own.
//   - An unknown variable passes if it is the whole value of X, Y or Z: the reader copies such a
//     line while TRC is off (D-55).
class SinumerikFlow : public Flow, private Variables {
 public:
  SinumerikFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text, std::size_t start);

 private:
  [[nodiscard]] Step execute_next(std::string& flat) override;
  [[nodiscard]] bool execute_line(std::string& flat) override;
  void keep_variables(std::size_t levels) override { scopes_.resize(levels); }
  enum class Type : std::uint8_t { boolean, character, integer, real, text };
  // Where a value is stored: in an R parameter, or in an element of a declared variable.
  struct Place {
    std::int64_t parameter = -1;  // of R; -1: none
    std::size_t scope = 0;
    std::string name{};
    std::size_t element = 0;
  };
  struct Variable {
    Type type = Type::real;
    std::vector<std::size_t> sizes{};  // of an array, by dimension
    std::vector<Value> elements{};
    std::optional<Place> stands_for{};  // VAR: the variable of the caller
    bool is_lost = false;               // the machine may have set it
    bool of_machine = false;            // depends on values given for the machine
  };
  using Scope = std::map<std::string, Variable, std::less<>>;
  // Of PROC.
  struct Parameter {
    std::string name{};
    Type type = Type::real;
    bool by_reference = false;
    std::size_t default_begin = 0;  // of the line; 0: none
  };
  struct Unit {
    std::string name{};
    std::size_t text = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t head = 0;  // line of PROC
    bool has_head = false;
  };
  enum class Structure : std::uint8_t {
    none,
    branch,
    otherwise,
    end_branch,
    counting,
    end_counting,
    condition,
    end_condition,
    endless,
    end_endless,
    repetition,
    until,
  };
  // The structures around a line, with the lines that begin them.
  using OpenStructures = std::vector<std::pair<Structure, std::size_t>>;
  // Where the lines of a unit lead.
  struct Outline {
    void take(Structure structure, std::size_t line, OpenStructures& open);

    std::map<std::string, std::vector<std::size_t>, std::less<>> labels{};
    std::map<std::int64_t, std::vector<std::size_t>> numbers{};
    std::map<std::size_t, std::size_t> feet{};    // by head: the end; of IF the ELSE, if it has one
    std::map<std::size_t, std::size_t> behind{};  // by ELSE: its ENDIF
    std::map<std::size_t, std::size_t> heads{};   // by the end
  };
  // How a call takes an argument.
  enum class Passing : std::uint8_t { by_value, by_reference, unknown };
  enum class Direction : std::uint8_t { forward, backward, both, to_the_beginning };
  // Part of a line of words.
  struct Piece {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::optional<std::string> instead{};  // empty: left out
    bool is_comment = false;
  };
  struct Call {
    const Unit* unit = nullptr;
    std::size_t begin = 0;
    std::size_t arguments = 0;  // where the bracket opens; 0: none
    std::optional<std::uint64_t> times{};
  };

  // sinumerik_flow.cpp: programs and the order of their lines.
  void add_units(std::size_t text);
  [[nodiscard]] const Unit* unit_named(std::string_view name) const;
  [[nodiscard]] static Structure structure_of(std::string_view line, std::size_t at);
  [[nodiscard]] const Outline& outline_of(const Frame& frame);
  void take_line();
  bool end_of_frame(std::string& flat);
  bool end_of_program(std::string& flat);
  [[nodiscard]] bool computes_behind_end(std::string_view line) const override;
  bool execute(std::string& flat);
  bool execute_statement(std::string& flat, std::string_view word, bool& is_statement);
  bool declare_external(std::string& flat, std::size_t at);
  bool refuse_word(Code code, std::size_t begin, std::size_t end, std::string_view why);

  // sinumerik_control.cpp: branches, loops and jumps.
  bool follow_structure(std::string& flat, Structure structure);
  bool branch(std::string& flat, ExpressionReader& expression);
  // `structure`: counting, or its end.
  bool count(std::string& flat, Structure structure);
  bool until(std::string& flat, ExpressionReader& expression);
  [[nodiscard]] std::optional<std::size_t> partner(
      const std::map<std::size_t, std::size_t>& partners, std::string_view missing);
  bool choose_case(ExpressionReader& expression, std::string& flat);
  bool jump(ExpressionReader& expression);
  bool pass_jump(ExpressionReader& expression);
  enum class Repeated : std::uint8_t { block, section };  // REPEATB, REPEAT
  bool repeat(std::string& flat, std::size_t at, Repeated repeated);
  [[nodiscard]] static std::optional<Direction> direction_of(std::string_view word);
  [[nodiscard]] std::string target_at(ExpressionReader& expression);
  [[nodiscard]] std::optional<std::size_t> line_of(const std::string& target, Direction direction);
  bool finish_statement(std::string& flat, std::size_t at);
  void write_behind_number(std::string& flat, std::string_view text);

  // sinumerik_words.cpp: lines of words.
  bool execute_words(std::string& flat);
  bool scan_word(std::size_t& at, std::vector<Call>& calls);
  bool scan_address(std::size_t& at, std::vector<Call>& calls);
  bool scan_name(std::size_t& at, const std::string& name, std::vector<Call>& calls);
  bool scan_value(std::size_t begin, std::size_t& at);
  bool scan_setting(std::size_t& at);
  bool scan_variable_of_machine(const std::string& name, std::size_t& at);
  bool append_frame(std::size_t& at, std::string& text, bool& changes);
  bool append_value_of(std::size_t& at, std::string& text, bool& changes);
  bool scan_times(std::size_t& at, std::vector<Call>& calls);
  bool read_times(std::size_t& at, Call& call);
  bool complete_call(Call& call);
  bool scan_assignment(std::size_t& at);
  void keep(std::size_t begin, std::size_t end);
  void leave_out(std::size_t begin, std::size_t end);
  [[nodiscard]] std::string text_of_value(const Value& value) const;
  bool write_words(std::string& flat);

  // sinumerik_calls.cpp
  bool scan_call_of_text(std::size_t& at, std::vector<Call>& calls);
  bool scan_call_arguments(std::size_t begin, std::size_t& at);
  // `call`: whose arguments they are; empty: indices and the like.
  bool append_arguments(std::size_t open, std::size_t end, std::string& text, bool& changes,
                        std::string_view call = {});
  bool append_argument(std::size_t begin, std::size_t end, Passing passing, std::string& text,
                       bool& changes);
  bool call(std::string& flat, const Call& call);
  bool pass_arguments(const Call& call, Scope& scope);
  bool return_from(std::string& flat);

  // sinumerik_machine.cpp: calls that only the machine has, and variables.
  [[nodiscard]] Passing passing_to(std::string_view call, std::size_t place) const;
  void know_external(std::string_view line, std::size_t at);
  void find_what_calls_are_given(const Unit& main);
  [[nodiscard]] bool is_kept(std::string_view name) const;
  void note_setting(const Place& place);
  void write_setting(std::string_view name, const Value& value);
  void write_element(const std::string& name, std::size_t element);
  void write_values();
  void lose_values();

  // sinumerik_kept_parts.cpp: what stands after the program and stays.
  void note_named_by_cycles(std::string_view written);
  bool keep_parts_behind_end(const std::vector<bool>& called, std::string& flat);
  bool find_named_labels(const std::vector<std::string>& names, std::set<std::size_t>& lines);
  void find_named_units(const std::vector<std::string>& names, std::set<std::size_t>& lines) const;
  [[nodiscard]] std::vector<bool> said_by_others() const;
  void find_units_nobody_calls(const std::vector<bool>& called, std::set<std::size_t>& lines) const;
  void append_lines_of(const Unit& unit, std::set<std::size_t>& lines) const;
  bool keep_part(std::size_t line, std::string& flat);

  // sinumerik_declarations.cpp
  bool define(std::string& flat);
  bool define_one(ExpressionReader& expression, Type type);
  bool initialise(ExpressionReader& expression, Variable& variable, std::size_t element);
  bool read_head(const Unit& unit, std::vector<Parameter>& parameters);
  [[nodiscard]] std::optional<Type> type_at(ExpressionReader& expression);

  // sinumerik_variables.cpp
  [[nodiscard]] bool is_variable_at(std::size_t at) const;
  // Whether it is the name of an R parameter, given or not.
  [[nodiscard]] static bool is_variable_name(std::string_view name);
  [[nodiscard]] static std::int64_t number_of_parameter(std::string_view name);
  [[nodiscard]] std::optional<Place> place_at(ExpressionReader& expression);
  [[nodiscard]] std::size_t element_at(ExpressionReader& expression, const Variable& variable);
  [[nodiscard]] Variable* declared(std::string_view name);
  // The value that the setup gives, as long as the program has not assigned another one.
  [[nodiscard]] const double* given_by_setup(std::string_view name) const;
  bool assign_at(ExpressionReader& expression);
  bool store(const Place& place, const Value& value, std::size_t begin);
  bool convert(Value& value, Type type, std::size_t begin);
  [[nodiscard]] Value content_of(const Place& place, ExpressionReader& expression,
                                 std::size_t begin);
  Value value_of(const Place& place, ExpressionReader& expression, std::size_t begin);
  Value read(ExpressionReader& expression) override;
  Value read_system_variable(ExpressionReader& expression);
  bool exists(ExpressionReader& expression) override;

  [[nodiscard]] ExpressionReader expression_at(std::size_t at) {
    return {sinumerik_grammar(), line_, at, *this};
  }

  std::vector<Unit> units_{};
  std::map<std::string, std::size_t, std::less<>> unit_of_name_{};     // the first one
  std::map<std::pair<std::size_t, std::size_t>, Outline> outlines_{};  // by text and end
  std::vector<Scope> scopes_{1};
  std::map<std::int64_t, double> parameters_{};  // R
  std::set<std::int64_t> unwritten_{};           // of these, set since they were last written
  // Variables that DEF and PROC do not declare and the program has set.
  std::set<std::string, std::less<>> set_on_machine_{};
  // By the names that EXTERN declares: the positions of arguments by reference.
  std::map<std::string, std::set<std::size_t>, std::less<>> externals_{};
  // Variables of the main program that are arguments of calls which stay, and their elements set
  // since they were last written.
  std::set<std::string, std::less<>> kept_{};
  std::set<std::pair<std::string, std::size_t>> unwritten_elements_{};
  std::size_t start_ = 0;  // the lines before it have passed as they stand
  // Texts among the arguments of cycles that pass: they may name parts of the program.
  std::set<std::vector<std::string>> named_by_cycles_{};
  bool modal_call_reads_ = false;  // MCALL of what only the machine has
  // The last value of FOR, by depth of calls and line.
  std::map<std::pair<std::size_t, std::size_t>, double> counts_{};

  // State of the line being executed.
  std::string_view line_{};
  NamedHead head_{};
  std::vector<Piece> pieces_{};
  bool has_computed_ = false;                    // an assignment, or a call
  std::vector<std::string> calls_of_line_{};     // of what only the machine has
  std::vector<std::string> given_to_calls_{};    // variables, which such a call may change
  std::string called_{};                         // what they are given to
  bool reads_variables_ = false;                 // a call that stays may read them
  bool begins_modal_call_ = false;               // MCALL
  std::optional<std::size_t> times_in_front_{};  // the piece of P2 where no call was known yet
  std::string lost_to_{};  // the last of all of these, which may have set any R parameter
  // The place where a variable with the name of an address is assigned a value.
  std::optional<std::size_t> addressed_{};
};

}  // namespace trc::program
