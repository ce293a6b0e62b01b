#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/nc/program/flow.h"
#include "core/nc/program/isg_line.h"

namespace trc::program {

// Whether it is V.S. or V.E., which other programs and the control read.
[[nodiscard]] bool isg_outlives_program(std::string_view name);

// The language of ISG.
//
//   - P parameters, V.P. and V.CYC. variables belong to the whole run, V.L. to the main program and
//     to each call; called programs know those of their caller. V.S. and V.E. outlast the run:
//     their assignments come out, with their values. V.A. and V.G. are the machine's, but for the
//     tool radii that the setup and the program give.
//   - Subprograms stand before the program, after %L NAME, or are texts of the setup, which
//     may have their own; they share all modes with their caller.
//   - A call of a subprogram that is not there passes (D-47, D-67). It may read what the program
//     has set, so these values come out before it at the latest. After it they are not known.
//   - Where the order of two adjacent operators is not documented, brackets are required.
class IsgFlow : public Flow, private Variables {
 public:
  IsgFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text, FirstBlock first_block);

  void know(std::string_view lines) override;

 private:
  struct Unit {
    std::string name{};
    std::size_t text = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  enum class Structure : std::uint8_t {
    none,
    branch,  // $IF without $GOTO
    other_branch,
    otherwise,
    end_branch,
    choice,  // $SWITCH
    chosen,  // $CASE
    by_default,
    end_choice,
    counting,
    end_counting,
    condition,  // $WHILE
    end_condition,
    endless,  // $DO
    end_endless,
    repetition,
    until,
  };
  // A fault of a statement, or of one around it.
  struct Misplaced {
    std::size_t line = 0;
    Code code = Code::block_structure;
    std::size_t begin = 0;
    std::string detail{};
    bool whole = false;  // the detail names the statement
  };
  // The heads of what is around a line.
  struct Around {
    std::optional<std::size_t> left{};      // a loop or a choice: $BREAK
    std::optional<std::size_t> repeated{};  // a loop: $CONTINUE
  };
  struct Open {
    Structure structure = Structure::none;
    std::size_t head = 0;
    std::vector<std::size_t> branches{};
    Around around{};  // of a line in it
  };
  // Where the lines of a unit lead.
  struct Outline {
    std::map<std::size_t, Misplaced> misplaced{};
    std::map<std::int64_t, std::vector<std::size_t>> numbers{};
    std::map<std::string, std::vector<std::size_t>, std::less<>> labels{};
    std::map<std::size_t, Structure> structures{};
    std::map<std::size_t, std::size_t> next{};   // of a branch: the other one, or its end
    std::map<std::size_t, std::size_t> feet{};   // by head, and by each branch of it: the end
    std::map<std::size_t, std::size_t> heads{};  // by the end
    std::map<std::size_t, std::vector<std::size_t>> choices{};  // by $SWITCH: $CASE and $DEFAULT
    std::map<std::size_t, Around> around{};
  };
  // Part of a line of words.
  struct Piece {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::optional<std::string> instead{};  // empty: left out
    bool is_comment = false;
  };
  using Values = std::map<std::string, Value, std::less<>>;

  [[nodiscard]] Step execute_next(std::string& flat) override;
  [[nodiscard]] bool execute_line(std::string& flat) override;
  void keep_variables(std::size_t levels) override { locals_.resize(levels); }

  // isg_flow.cpp: programs and the order of their lines.
  void add_units(std::size_t text, FirstBlock first_block);
  [[nodiscard]] bool ends_tape(const ProgramText& text, std::size_t line) const;
  [[nodiscard]] static std::string name_of_second(std::string_view line);
  void take_line_in_front(std::string_view line);
  void take_line();
  [[nodiscard]] std::vector<bool> comment_lines(const ProgramText& text, std::size_t begin,
                                                std::size_t end) const;
  bool end_of_frame(std::string& flat);
  bool end_of_program(std::string& flat);
  bool refuse_behind_end(std::size_t line, Code code, std::string detail);
  bool pass_header(std::string& flat);
  bool pass_line(std::string& flat);
  [[nodiscard]] bool calls_the_unknown() const;

  // isg_outline.cpp: where they lead.
  [[nodiscard]] const Outline& outline_of(const Frame& frame);
  static void add_structure(Outline& outline, std::deque<Open>& open, Structure structure,
                            std::size_t line);
  static void misplace(Outline& outline, const std::deque<Open>& open, std::size_t line,
                       const Misplaced& misplaced);
  static void check_choice(Outline& outline, const std::deque<Open>& open, std::size_t line,
                           std::string_view text);
  void check_statement(Outline& outline, const std::deque<Open>& open, std::size_t line,
                       std::string_view text) const;
  [[nodiscard]] static Structure structure_of(std::string_view line);

  // isg_control.cpp: branches, loops and jumps.
  bool follow(std::string& flat);
  bool refuse_misplaced(const Misplaced& misplaced);
  bool branch(std::string& flat, ExpressionReader& expression);
  bool loop(Structure structure, const Outline& outline, ExpressionReader& expression);
  bool jump_if(ExpressionReader& expression);
  bool choose(std::string& flat, ExpressionReader& expression);
  // `structure`: counting, or its end.
  bool count(std::string& flat, Structure structure);
  enum class Exit : std::uint8_t { of_loop, of_round };  // $BREAK, $CONTINUE
  bool leave(std::string& flat, Exit exit);
  // Of the program that is executed.
  [[nodiscard]] bool has_block(std::int64_t number) const;
  std::optional<std::size_t> target_of(ExpressionReader& expression);
  [[nodiscard]] std::optional<std::size_t> partner(
      const std::map<std::size_t, std::size_t>& partners, std::string_view missing);
  bool finish_statement(std::string& flat, std::size_t at);
  bool refuse_words_behind(std::string_view line, std::size_t at);
  void write_behind_number(std::string& flat, std::string_view text);

  // isg_calls.cpp
  [[nodiscard]] const Unit* unit_called(const IsgCall& call) const;
  bool call(std::string& flat, IsgCall call);
  bool call_the_machine(std::string& flat, const IsgCall& call);
  bool refuse_call(const IsgCall& call);
  bool check_behind_return();
  bool return_from(std::string& flat);

  // isg_words.cpp: lines of words.
  bool execute_words(std::string& flat);
  [[nodiscard]] bool chooses_tool() const;
  bool scan_word(std::size_t& at);
  bool scan_address(std::size_t& at);
  bool scan_value(std::size_t begin, std::size_t value, std::size_t& at);
  bool scan_call(std::size_t& at, const IsgCall& call);
  [[nodiscard]] std::size_t variable_in_name(std::size_t at, std::size_t& end) const;
  [[nodiscard]] std::size_t value_in_command(std::size_t sign, std::size_t& behind) const;
  bool scan_command(std::size_t& at);
  struct Assigned {
    std::size_t begin = 0;
    std::string name{};
    char changed_by = '\0';  // of += and the like the first sign
    std::size_t value_begin = 0;
  };
  bool read_assigned(Assigned& assigned);
  bool change(const Assigned& assigned, Value& value);
  bool scan_assignment(std::size_t& at);
  void write_assigned(const Assigned& assigned, const Value& value, std::size_t at);
  bool scan_radius(std::size_t& at, std::size_t value);
  bool scan_zero_offset(std::size_t& at);
  bool end_or_return(bool& ends, bool& returns);
  [[nodiscard]] bool has_changed_words() const;
  bool write_words(std::string& flat);
  static void append_number(std::string& text, const Value& value);

  // isg_variables.cpp
  bool declare(std::string& flat);
  bool declare_elements(ExpressionReader& expression, const std::string& name,
                        const std::vector<std::size_t>& sizes);
  bool forget_declared(std::size_t at);
  // The name of the parameter or variable there, with its indices, in capitals.
  [[nodiscard]] std::string place_at(ExpressionReader& expression);
  [[nodiscard]] std::string parameter_at(ExpressionReader& expression);
  [[nodiscard]] static std::string numbered_parameter(ExpressionReader& expression,
                                                      std::int64_t number, std::size_t begin);
  [[nodiscard]] std::int64_t number_held(ExpressionReader& expression, const std::string& name,
                                         std::size_t begin);
  [[nodiscard]] std::string indices_at(ExpressionReader& expression);
  bool assign(const std::string& name, Value value, std::size_t begin);
  [[nodiscard]] std::size_t level_of(std::string_view name) const;
  [[nodiscard]] const Value* held(const std::string& name) const;
  [[nodiscard]] Values& values_of(std::string_view name);
  Value read(ExpressionReader& expression) override;
  Value value_of(ExpressionReader& expression, const std::string& name, std::size_t begin);
  Value read_radius(ExpressionReader& expression, const std::string& name, std::size_t begin);
  bool exists(ExpressionReader& expression) override;
  void write_values(std::string& flat);
  void lose_values(const std::string& to);

  [[nodiscard]] ExpressionReader expression_at(std::size_t at) {
    return {isg_grammar(), line_, at, *this};
  }

  std::vector<Unit> units_{};
  std::map<std::pair<std::size_t, std::size_t>, Outline> outlines_{};  // by text and start
  Values values_{};
  std::vector<Values> locals_{1};
  std::set<std::string, std::less<>> whole_{};       // declared with a type of whole numbers
  std::set<std::string, std::less<>> fields_{};      // declared with sizes
  std::set<std::string, std::less<>> of_machine_{};  // hang on what is given for the machine
  std::set<std::string, std::less<>> unwritten_{};   // set since they were last written
  std::map<std::string, std::string, std::less<>> spellings_{};  // of V. names, without indices
  // The program calls subprograms that are not there: V. variables come out where they are set, and
  // P parameters before such a call.
  bool writes_variables_ = false;
  std::string lost_to_{};
  // The last value and the step of $FOR, by depth of calls and line.
  std::map<std::pair<std::size_t, std::size_t>, std::pair<double, double>> counts_{};
  bool in_comment_ = false;      // between #COMMENT BEGIN and END
  bool in_declaration_ = false;  // between #VAR and #ENDVAR

  // State of the line being executed.
  std::string joined_{};    // of a line that goes on after `\`
  bool is_joined_ = false;  // the line that is executed, of several
  std::string_view line_{};
  IsgHead head_{};
  std::vector<Piece> pieces_{};
  bool has_computed_ = false;            // an assignment, or a jump
  std::vector<std::string> assigned_{};  // in this line
  bool reads_words_ = false;             // a value of a word, not of an assignment
  bool assigns_in_choice_ = false;       // the value of a $SWITCH is read
  std::string called_behind_words_{};    // what only the machine has
  std::optional<std::size_t> jump_{};    // of a $GOTO beside words
};

}  // namespace trc::program
