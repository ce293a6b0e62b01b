#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/call_places.h"
#include "core/base/checkpoint.h"
#include "core/base/diagnostic.h"
#include "core/base/length_unit.h"
#include "core/nc/dialect/klartext_effects.h"
#include "core/nc/program/expression.h"
#include "core/nc/program/kept_text.h"
#include "core/nc/program/program_text.h"
#include "core/nc/state/program_setup.h"
#include "core/nc/state/program_state.h"

namespace trc::program {

// Depth of nested calls; controls allow fewer.
inline constexpr std::size_t deepest_call = 32;

// The modes after the lines executed so far, which a program may read.
struct ModalState {
  MotionKind motion = MotionKind::rapid;
  Plane plane = Plane::xy;
  bool incremental = false;
  LengthUnit unit = LengthUnit::mm;
  std::optional<double> tool_radius{};  // mm; none: nobody has given it
  // Diameter of the tool that M6 has put into the spindle, mm, where setup or program give it.
  std::optional<double> spindle_diameter{};
  bool contour_open = false;
  // Of X, Y and Z, in the unit in force; nothing where the position is not known, and in a contour.
  std::array<std::optional<double>, 3> place{};
};

// Where the first block of the program stands: in the text that is executed, or in lines before
// it, which have come out already.
enum class FirstBlock : std::uint8_t { in_text, before_text };

// What the reader of a program lends to its flow. All of a text is looked at before its first line
// is executed, so this passes the checkpoint too.
struct Lent {
  CallPlaces& calls;
  Checkpoint& checkpoint;
};

// Executes a program that computes, a line at a time: follows its jumps, loops and calls, and makes
// the lines of the flat program.
class Flow {
 public:
  enum class Step : std::uint8_t { goes_on, ended, refused };

  Flow(const ProgramSetup& setup, const Lent& lent);
  virtual ~Flow() = default;
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  // Executes the next line and appends the lines that it becomes, with their ends. After `ended` no
  // further call is allowed, after `refused` only look_ahead().
  [[nodiscard]] Step step(std::string& flat);
  // After a refusal: from now on step() only examines the lines ahead, one at a time, for further
  // faults, so that one run reports them all. Jumps are not followed, called subprograms are
  // examined in turn, and an unknown value is taken for 1.
  void look_ahead();

  // Takes lines that the reader has passed on before the text.
  virtual void know(std::string_view /*lines*/) {}
  // Sets the modes in force; called before each step.
  void hold(const ModalState& modes) { modes_ = modes; }

  // The last line that it has become calls a text that only the machine has: the call passes.
  [[nodiscard]] bool calls_the_machine() const { return calls_the_machine_; }
  // After the motion of that line the machine executes a text that only it has: G66.
  [[nodiscard]] bool machine_follows() const { return machine_follows_; }
  // The effects of the line executed last, where it calls a label that stays in the program.
  [[nodiscard]] const std::optional<KlartextEffects>& call_leaves() const { return call_leaves_; }
  // Lines that set variables for a call of the machine, before what the line has become: they
  // are copied as they stand.
  [[nodiscard]] const std::string& settings() const { return settings_; }
  // Whether the line executed last came out as it was written.
  [[nodiscard]] bool is_as_written() const { return is_as_written_; }
  // Line in the program of the line executed last; for a line of a given subprogram that of its
  // call; and the chain of calls.
  [[nodiscard]] std::uint32_t line_in_program() const;
  // The N word of that line, or Source::no_number.
  [[nodiscard]] std::int64_t number_in_program() const;
  [[nodiscard]] CallPlaces::Chain chain() const { return executed_frame()->chain; }
  [[nodiscard]] std::uint32_t line_within() const;
  [[nodiscard]] std::uint64_t executed_lines() const { return executed_; }
  // The errors of the last step, without place; at most one while lines are executed.
  [[nodiscard]] const std::vector<Diagnostic>& refusals() const { return refusals_; }
  // The warnings of the last step, without place.
  [[nodiscard]] const std::vector<Diagnostic>& warnings() const { return warnings_; }

 protected:
  // A program being executed: the main program, or a call.
  struct Frame {
    std::size_t text = 0;
    std::size_t begin = 0;  // lines of the subprogram
    std::size_t end = 0;
    std::size_t next = 0;     // to be executed
    std::size_t current = 0;  // executed last
    std::size_t restart = 0;
    std::uint64_t repetitions_left = 0;
    CallPlaces::Chain chain = CallPlaces::main_program;
    std::string name{};
    bool own_variables = false;
  };

  [[nodiscard]] virtual Step execute_next(std::string& flat) = 0;
  // Takes the line at frame().next and does what it says; false where it is refused.
  [[nodiscard]] virtual bool execute_line(std::string& flat) = 0;
  // Keeps this many levels of variables; the main program has the first.
  virtual void keep_variables(std::size_t levels) = 0;
  [[nodiscard]] bool looks_ahead() const { return looks_ahead_; }
  // While lines are only examined: a call that is not executed may have set variables.
  void forget_values();
  // While lines are only examined, passes over those before `line`: a subprogram is defined here.
  void pass_over(std::size_t line) { passed_over_ = line; }
  // Whether the line of that text was executed or examined.
  [[nodiscard]] bool was_seen(const Frame& frame, std::size_t line) const;

  [[nodiscard]] Frame& frame() { return frames_.back(); }
  [[nodiscard]] const ProgramText& text_of(const Frame& frame) const { return texts_[frame.text]; }
  [[nodiscard]] std::string_view line_end() const;

  // For the line being executed: whether the setup leaves it out, and whether a line with `/` may
  // be skipped.
  [[nodiscard]] bool is_left_out(std::string_view line) const;
  [[nodiscard]] bool may_be_skipped(bool behind_slash) const {
    return behind_slash && setup_.block_skip != BlockSkip::execute;
  }
  // Counts the line being executed. False beyond the limit of the setup.
  bool count_line();
  // Enters a call. False beyond the deepest one allowed.
  bool enter(Frame callee);
  // Always false. `begin`: byte of the line.
  bool refuse(Code code, std::size_t begin, std::string detail);
  bool refuse(const TextFault& fault) { return refuse(fault.code, fault.begin, fault.detail); }
  // For a variable without a value: fails, or supposes a value while lines are only examined.
  Value without_value(ExpressionReader& expression, Code code, std::size_t begin,
                      std::string detail);
  // A variable has been assigned what kept_text_ has read.
  void note_counter(const std::string& name);
  // For a variable that the control counts: whether its value is known. Null: the program itself
  // has set it.
  [[nodiscard]] const bool* counter(const std::string& name) const;
  // Warns once for each variable that outlives the program and is set to a number that depends on
  // values given for the machine (D-88).
  void warn_of_given(std::size_t begin, const std::string& name);
  // A variable is read: while lines are only examined, its value may be a supposed one.
  void suppose() { supposes_ = true; }
  // Whether a refusal may only follow from supposed values.
  [[nodiscard]] bool may_be_a_consequence(Code code) const;

  // The first line of the program from `begin` on with one of two functions; `end`: none.
  [[nodiscard]] std::size_t first_with(char letter, int first, int second, std::size_t begin,
                                       std::size_t end) const;
  // Always false: that line is never reached, and its contour would be lost.
  bool refuse_contour_behind_end(std::size_t line);
  // Writes the lines of the main program between M02 or M30, which has been written, and `behind`,
  // as they stand; no further than to the first one that computes or was executed. Returns the end
  // of what was written.
  std::size_t write_text_behind_end(std::string& flat, std::size_t behind);
  // Writes all of these lines, whatever they hold. False: none, as nothing has ended there.
  bool copy_text_behind_end(std::string& flat, std::size_t behind);
  // Whether a line after the end computes.
  [[nodiscard]] virtual bool computes_behind_end(std::string_view line) const;
  // The first of these lines of the main text that computes or was executed; `end`: none.
  [[nodiscard]] std::size_t end_of_plain_text(std::size_t begin, std::size_t end) const;

  // The value the setup gives a variable, by its name in capitals without `#`, `<`, `>`; null:
  // none.
  [[nodiscard]] const double* given(std::string_view name) const;

  const ProgramSetup& setup_;
  CallPlaces& calls_;
  Checkpoint& checkpoint_;
  std::vector<ProgramText> texts_{};  // the program first
  std::vector<Frame> frames_{};
  ModalState modes_{};
  std::string settings_{};
  KeptText kept_text_{};
  std::map<std::string, bool, std::less<>> counters_{};  // those that the control counts
  bool is_as_written_ = true;
  std::optional<KlartextEffects> call_leaves_{};
  bool calls_the_machine_ = false;
  bool machine_follows_ = false;
  bool ended_ = false;

 private:
  // Lines to be examined: from the next line of the innermost frame to its end.
  struct LinesAhead {
    std::vector<Frame> frames{};
    bool knows_values = false;  // the frames of the refusal, whose variables are known
  };
  Step look_at_next(std::string& flat);
  // The frame of the line executed last: nothing of what that line calls has been executed.
  [[nodiscard]] std::vector<Frame>::const_reverse_iterator executed_frame() const {
    return frames_.rbegin() + (has_entered_ ? 1 : 0);
  }
  // Whether the line of the innermost frame was seen.
  [[nodiscard]] std::vector<bool>::reference seen_line();

  std::map<std::string, double, std::less<>> given_{};
  std::uint64_t executed_ = 0;
  std::vector<Diagnostic> refusals_{};
  std::vector<Diagnostic> warnings_{};
  std::set<std::string> warned_of_{};
  std::vector<std::vector<bool>> seen_{};  // by text: lines that were executed or looked at
  bool has_entered_ = false;               // the line executed last has entered a call
  bool looks_ahead_ = false;
  std::deque<LinesAhead> ahead_{};
  bool supposes_ = false;        // the line that is looked at has a variable
  bool misread_ = false;         // a statement that may begin or end something
  std::size_t passed_over_ = 0;  // line after it; 0: nothing is
};

// Whether a line makes its program one that computes.
[[nodiscard]] bool computes(const ProgramSetup& setup, std::string_view line);

// The program is executed from the line `start` of `text` on (0-based).
[[nodiscard]] std::unique_ptr<Flow> make_flow(const ProgramSetup& setup, const Lent& lent,
                                              ProgramText text, std::size_t start,
                                              FirstBlock first_block);

}  // namespace trc::program
