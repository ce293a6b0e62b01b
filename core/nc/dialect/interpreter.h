#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/nc/dialect/block_skip.h"
#include "core/nc/dialect/code_modes.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/dialect/klartext_modes.h"
#include "core/nc/dialect/plain_motion.h"
#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_state.h"
#include "core/nc/text/code_words.h"
#include "core/nc/text/klartext_tool_words.h"
#include "core/nc/text/klartext_words.h"
#include "core/nc/text/named_words.h"
#include "core/nc/text/number_format.h"
#include "core/nc/text/words.h"

namespace trc {

struct ReaderLimits {
  std::size_t longest_line = 64 * 1024;  // bytes, continued lines together; 900006 beyond
  // So many different faults of reading are told together, at the end of the text at the latest:
  // nothing comes out behind the first one.
  std::size_t most_faults = 1;
};

// Reads NC text of the dialect of the setup and tells `state` what it means; blocks come
// out there. The text may be cut anywhere, also inside a word, a line end or a
// UTF-8 character: lines, blocks and diagnostics are the same.
//
// What cannot be carried safely is an error with line, column and remedy. After
// an error nothing more is read, but for further faults of reading (ReaderLimits::most_faults).
//
// Of ISG:
//
//   - The words of a block act together, whatever their order: modes, radius,
//     G40 … G42, technology, motion, stop. A function excludes all others of its
//     group in one block, itself included.
//   - Values are plain decimal numbers. Variables, expressions, jumps and blocks
//     to skip are refused, so are R and I J K outside circles: R is not modal here.
//   - While TRC is off calls of subprograms (L NAME), assignments to variables
//     (V.P. = …), coordinate systems and the like pass as they stand. The position
//     is unknown then; behind a call it is known again once G00 … G03 and G90 or
//     G91 have been programmed anew.
//   - G70 counts coordinates, centres, radii and F in inch, also the tool radius
//     that a program writes; the radii of the tool table are mm.
//   - Zero shifts and G92 pass while TRC is off. The position is unknown then, with
//     axis words behind G92 on those axes, behind G53 also after the motion of its
//     block: ProgramState::forget_position.
//   - F is a feed per minute under G94 only; under G93, G95 and G194 it passes as
//     technology and blocks have no feed. TRC cannot be active under G93, nor G11
//     under any of them.
//   - Behind M02, M30 and between #COMMENT BEGIN and END lines are text only; G41
//     and G42 behind the end are refused (900015), as nothing resolves them.
class Interpreter {
 public:
  // What a block of Klartext that may move begins with.
  enum class KlartextStatement : std::uint8_t {
    none,  // M words alone
    straight,
    polar_line,
    center,       // CC
    circle,       // C
    radius_arc,   // CR
    tangent_arc,  // CT
    polar_circle,
    polar_tangent_arc,
    rounding,
    chamfer,
    approach,
    departure,
  };

  Interpreter(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics);

  // Appends to `lines` every line that is complete. Returns whether the stream
  // goes on.
  bool feed(std::string_view text, std::vector<LinePointer>& lines);
  // End of the text: reads a last line without line end and ends the program in
  // `state`, unless M02 or M30 has done so.
  bool finish(std::vector<LinePointer>& lines);

  // A line of the flat program that a program which computes has become.
  struct FlatLine {
    std::string_view text{};
    std::string_view line_end{};
    std::uint32_t number = 0;        // of the line it comes from, 1-based
    bool is_as_written = true;       // that line itself: columns say where in it
    bool sets_variables = false;     // for a call of the machine: copied as it stands
    bool calls_the_machine = false;  // what only the machine has: passes as ISG's calls do
    bool machine_follows = false;    // a macro of the machine, behind the motion of the line
  };
  // Reads it as `feed` does a whole line.
  bool read(const FlatLine& line, std::vector<LinePointer>& lines);
  // Tells what stands against the program, with all faults of reading found so far. False.
  bool stop(Diagnostic error);
  // Takes what stands against the program for a fault of reading, told with those found before it
  // and behind it. Returns whether reading goes on.
  bool note(Diagnostic error);

  // Blocks read so far, the index of the next one (Source::index).
  [[nodiscard]] std::uint64_t blocks_read() const { return blocks_read_; }
  // What holds behind the lines read.
  [[nodiscard]] bool counts_in_inch() const { return inch_; }
  [[nodiscard]] bool is_incremental() const { return incremental_; }
  [[nodiscard]] MotionKind motion_in_force() const { return motion_; }
  [[nodiscard]] Plane plane_in_force() const { return state_.programmed_plane(); }
  [[nodiscard]] std::optional<double> radius_in_force() const { return state_.tool().radius(); }
  // Of the tool that M6 has put there, wear included, mm.
  [[nodiscard]] std::optional<double> spindle_diameter() const;
  [[nodiscard]] bool is_in_contour() const { return state_.contour_open(); }
  // Behind M02 or M30.
  [[nodiscard]] bool has_ended() const { return ended_; }

  // Takes a line that is no longer needed, so that its memory serves a later one.
  void recycle(LinePointer line);

  // Physical lines read so far.
  [[nodiscard]] std::uint64_t lines_read() const { return lines_read_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(partial_, continued_, carriage_return_, lines_read_, blocks_read_, comment_block_,
            ended_, motion_, motion_given_, incremental_, inch_, absolute_center_, feed_mode_,
            feed_, isg_word_seen_, reads_plain_lines_, feed_in_mm_, code_, klartext_, faults_,
            scanned_trc_, in_front_of_tape_, called_motion_, called_dimension_, in_subprogram_);
  }

 private:
  struct BlockWords;

  bool take_line(std::string_view text, std::string_view line_end, std::vector<LinePointer>& lines);
  bool take_block(std::string_view text, std::string_view line_end, std::uint32_t lines_of_it,
                  std::vector<LinePointer>& lines);
  // Of Klartext: partial_ is a comment that has turned out to end in front of its last line.
  bool take_comment_before(std::string_view last_line, std::vector<LinePointer>& lines);
  ProgramLine& append_line(std::string_view text, std::string_view line_end,
                           std::vector<LinePointer>& lines);
  void enter_modes(ProgramLine& line) const;
  bool read_line(ProgramLine& line);
  [[nodiscard]] bool is_left_out(ProgramLine& line);
  void cut_skipped_words(ProgramLine& line);
  void forget_what_stands_in_front();
  bool read_line_of_subprogram(const ProgramLine& line);
  bool read_line_behind_end(ProgramLine& line);
  bool read_comment_block(ProgramLine& line);
  bool read_block(ProgramLine& line);
  bool read_words_of_dialect(ProgramLine& line, BlockWords& block);
  void copy_plunge_from_nowhere(ProgramLine& line, BlockWords& block) const;
  void copy_helix_with_pitch(ProgramLine& line, BlockWords& block) const;
  [[nodiscard]] bool is_plain(ProgramLine& line, PlainMotion& plain) const;

  bool read_words(ProgramLine& line, BlockWords& block);
  bool read_g_function(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_address(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_axis(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_machine_function(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_number(const Word& word, ProgramLine& line, BlockWords& block);
  bool read_command(const Word& word, ProgramLine& line, BlockWords& block);
  bool copy_unfollowed_command(const Word& word, std::string_view name, ProgramLine& line,
                               BlockWords& block);
  bool read_call_behind_words(std::uint32_t begin, ProgramLine& line, BlockWords& block);
  bool check_feed(ProgramLine& line, const BlockWords& block);

  // Of the dialects of plain letters and numbers: code_block_words.cpp and code_block.cpp.
  bool read_code_words(ProgramLine& line, BlockWords& block);
  [[nodiscard]] bool hangs_on_switch(std::string_view line, const BlockWords& block) const;
  bool read_code_word(const CodeWord& word, ProgramLine& line, BlockWords& block);
  [[nodiscard]] bool cuts_off_words(const ProgramLine& line, std::uint32_t begin) const;
  [[nodiscard]] bool names_what_passes(std::string_view line, std::uint32_t begin) const;
  bool read_code_function(const CodeWord& word, ProgramLine& line, BlockWords& block);
  void see_whole(const CodeWord& word, std::size_t bit, BlockWords& block);
  bool count_whole_numbers(ProgramLine& line, BlockWords& block);
  bool read_code_axis(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool read_code_address(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool read_code_sign(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool read_code_center(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool read_code_tool(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool read_comma_word(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool read_code_machine_function(const CodeWord& word, ProgramLine& line, BlockWords& block);
  bool complete_code_block(ProgramLine& line, BlockWords& block);
  void take_spindle_limit(const ProgramLine& line, BlockWords& block);
  void end_modes_before(const BlockWords& block);
  static void take_words_that_are_no_motion(ProgramLine& line, BlockWords& block);
  bool check_dwell(const ProgramLine& line, const BlockWords& block);
  bool check_skipped_modes(const ProgramLine& line, const BlockWords& block);
  void take_what_is_unfollowed(const ProgramLine& line, BlockWords& block);
  void take_work_offset(BlockWords& block);
  bool check_kept_modes(ProgramLine& line, const BlockWords& block);
  bool apply_kept_modes(const ProgramLine& line, const BlockWords& block);
  [[nodiscard]] bool may_read_plain_lines() const;
  void take_unit_of_old(ProgramLine& line, BlockWords& block) const;
  void forget_what_ends_nothing(BlockWords& block);
  // Of lines that are copied: copied_block.cpp.
  // Empty: nothing.
  struct NotWhileActive {
    Code code = Code::nc_unsupported;
    std::optional<std::uint32_t> begin{};  // of the line
    std::string meaning{};
    bool hangs_on_what_was_told = false;
  };
  [[nodiscard]] NotWhileActive find_what_is_copied(BlockWords& block);
  static void copy_for(GGroup group, AxisBits forget, BlockWords& block, NotWhileActive& found);
  static void copy_motion(const char* why, AxisBits forget, BlockWords& block,
                          NotWhileActive& found);
  // `named`: the axes that the line has words of.
  void copy_for_functions(BlockWords& block, AxisBits named, NotWhileActive& found);
  void follow_tool_offset(BlockWords& block, AxisBits named, NotWhileActive& found);
  void copy_under_modes(BlockWords& block, AxisBits named, NotWhileActive& found);
  void copy_for_words_of_line(BlockWords& block, AxisBits named, NotWhileActive& found);
  [[nodiscard]] bool ends_what_is_unfollowed(const BlockWords& block) const;
  void end_what_was_unfollowed(BlockWords& block);
  void take_modal_motion(const ProgramLine& line, const BlockWords& block);
  bool copy_thread(ProgramLine& line, BlockWords& block);
  void end_scaling_frames(const std::string& frame);
  void take_tool_words(const ProgramLine& line, BlockWords& block);
  static void take_words_of_few_controls(BlockWords& block);
  bool take_cycle_with_register(ProgramLine& line, BlockWords& block);
  void take_parameters_of_control(ProgramLine& line, BlockWords& block);
  void take_turns_of_arc(ProgramLine& line, BlockWords& block) const;
  bool copy_code_block(ProgramLine& line, BlockWords& block);
  bool check_motion_before(const ProgramLine& line, const BlockWords& block);
  [[nodiscard]] bool leaves_from_lost_place(const BlockWords& block) const;
  bool leave_contour_by_copy(ProgramLine& line, const BlockWords& block);
  bool check_left_contour(const ProgramLine& line, std::uint32_t begin,
                          const std::array<bool, 3>& named);
  // Tools, and what G41 and G42 need: code_tools.cpp.
  // Whether a contour hangs on what a line says that may be skipped (D-59).
  bool check_what_may_be_skipped(const ProgramLine& line, const BlockWords& block);
  bool check_code_selection(ProgramLine& line, BlockWords& block);
  bool refuse_selection(const ProgramLine& line, const BlockWords& block, Code code,
                        std::string detail);
  bool check_turning(const ProgramLine& line, const BlockWords& block);
  bool check_words_beside_contour(const ProgramLine& line, const BlockWords& block);
  // What names the tool of a line.
  enum class ToolSaid : std::uint8_t { by_d, by_h, by_spindle };
  std::optional<ToolSaid> take_tool_of_selection(ProgramLine& line, BlockWords& block);
  bool check_tool_of_table(const ProgramLine& line, BlockWords& block, ToolSaid said);
  // code_corners.cpp
  bool take_corner(ProgramLine& line, BlockWords& block);
  bool take_modal_rounding(ProgramLine& line, BlockWords& block);
  bool take_corner_feed(ProgramLine& line, BlockWords& block);
  [[nodiscard]] MotionKind kind_of(const BlockWords& block) const;
  void pass_over_circle_words(ProgramLine& line, BlockWords& block) const;
  bool check_circle_words(const ProgramLine& line, const BlockWords& block);
  bool take_fagor_words(ProgramLine& line, BlockWords& block);
  bool take_tool_data(ProgramLine& line, BlockWords& block);
  bool refuse_code(const ProgramLine& line, const CodeWord& word, Code code,
                   std::string_view meaning = {});

  // Of Heidenhain: heidenhain.cpp.
  struct KlartextBlock;
  bool read_klartext(ProgramLine& line);
  bool read_plain_klartext(ProgramLine& line, KlartextBlock& block) const;
  // Whether the program goes on behind the block; nothing where it is not plain.
  std::optional<bool> take_plain_klartext(ProgramLine& line);
  bool take_klartext(ProgramLine& line, KlartextBlock& block, bool readable);
  bool read_klartext_words(ProgramLine& line, KlartextBlock& block);
  bool read_klartext_word(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  bool read_klartext_value(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  bool read_klartext_axis(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  bool read_klartext_name(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  bool read_klartext_parameter(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  bool read_klartext_feed(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  bool read_klartext_function(const KlartextWord& word, ProgramLine& line, KlartextBlock& block);
  void take_klartext_function(int m, KlartextBlock& block);
  bool read_klartext_statement(ProgramLine& line, std::size_t begin);
  bool check_other_compensations(const ProgramLine& line, std::size_t begin,
                                 std::string_view statement);
  bool copy_motion_of_machine(ProgramLine& line, std::size_t begin, std::string_view statement);
  bool copy_klartext(ProgramLine& line, std::size_t begin, WordRole role);
  bool enter_label_behind_end(const ProgramLine& line);
  bool read_label(ProgramLine& line, std::size_t begin, std::string_view statement);
  bool take_tool_of_label(const ProgramLine& line, std::size_t begin);
  bool copy_jump(ProgramLine& line, std::size_t begin, std::string_view statement);
  bool call_label(ProgramLine& line, std::size_t begin, std::string_view statement);
  void enter_section(const std::string& label);
  bool take_labels_of_cycle(const ProgramLine& line, std::size_t begin, std::string_view statement);
  void take_klartext_scaling(std::string_view statement);
  bool read_tool_call(ProgramLine& line, std::size_t begin, std::string_view statement);
  bool read_tool_definition(ProgramLine& line, std::size_t begin, std::string_view statement);
  void take_assignment(const ProgramLine& line, std::string_view statement);
  void forget_parameters(std::string_view statement);
  struct ToolCall;
  bool read_words_of_call(const ProgramLine& line, std::size_t begin, std::string_view statement,
                          ToolCall& call);
  bool take_called_tool(const std::string& line, std::size_t at, const KlartextToolWord& word,
                        ToolCall& call) const;
  bool take_word_of_call(const KlartextToolWord& word, ToolCall& call) const;
  void take_radius_delta(const KlartextToolWord& word, ToolCall& call) const;
  bool refuse_klartext(const ProgramLine& line, std::size_t begin, std::string detail,
                       Code code = Code::nc_unsupported);
  bool check_klartext(ProgramLine& line, KlartextBlock& block);
  bool apply_klartext(ProgramLine& line, KlartextBlock& block);
  [[nodiscard]] bool leaves_from_lost_place(const KlartextBlock& block) const;
  bool leave_contour_by_copy(ProgramLine& line, const KlartextBlock& block, bool copied);
  bool leave_contour_by_cycle(const ProgramLine& line, std::size_t begin,
                              std::string_view statement);
  bool apply_klartext_modes(ProgramLine& line, KlartextBlock& block);
  bool apply_klartext_motion(ProgramLine& line, KlartextBlock& block);
  bool select_in_klartext(const ProgramLine& line, Side side, std::size_t begin);
  bool choose_called_tool(const ProgramLine& line, std::size_t begin);
  bool check_corner_before(const ProgramLine& line, const KlartextBlock& block, bool selects);
  // Of a block that is followed.
  bool check_words_together(const ProgramLine& line, const KlartextBlock& block);
  bool check_klartext_form(const ProgramLine& line, const KlartextBlock& block);
  bool check_words_of_form(const ProgramLine& line, const KlartextBlock& block);
  void leave_plane_by_arc(KlartextBlock& block) const;
  bool take_pole_across(ProgramLine& line, const KlartextBlock& block);
  bool take_klartext_pole(ProgramLine& line, KlartextBlock& block);
  bool find_klartext_end(ProgramLine& line, KlartextBlock& block);
  bool find_polar_end(ProgramLine& line, KlartextBlock& block, const Point& start, Point& end);
  bool move_on_klartext_arc(ProgramLine& line, KlartextBlock& block, MoveRequest& request);
  bool move_on_tangent_arc(ProgramLine& line, KlartextBlock& block, MoveRequest& request);
  bool move_in_turns(ProgramLine& line, KlartextBlock& block, MoveRequest& request);
  bool move_in_klartext(ProgramLine& line, MoveRequest& request);
  bool lead_in_klartext(ProgramLine& line, KlartextBlock& block);
  void hand_on_klartext_pole(ProgramLine& line) const;
  void forget_klartext_position(ProgramLine& line,
                                const std::array<bool, 3>& axes = {true, true, true});

  // Of Sinumerik: sinumerik_block.cpp, _functions.cpp, _values.cpp and _arcs.cpp.
  bool read_named_words(ProgramLine& line, BlockWords& block);
  [[nodiscard]] int axis_of_index(const NamedWord& word) const;
  bool check_index(const NamedWord& word, const ProgramLine& line);
  bool read_named_address(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_tool_name(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_call_by_letter(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_word_of_index(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool take_reference(const NamedWord& word, const ProgramLine& line, BlockWords& block);
  bool read_assignment(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_form_of_arc(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_corner(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_angle_or_turns(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool pass_assignment(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_name(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_named_call(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool read_known_name(SinumerikMeaning meaning, const NamedWord& word, ProgramLine& line,
                       BlockWords& block);
  // Notes that the word stands for the function.
  static bool read_as(const GFunction& function, const NamedWord& word, ProgramLine& line,
                      BlockWords& block);
  bool refuse_name(const ProgramLine& line, const NamedWord& word, std::string_view why);
  bool read_polar_word(const NamedWord& word, ProgramLine& line, BlockWords& block);
  void take_pole(const BlockWords& block);
  bool resolve_polar_words(ProgramLine& line, BlockWords& block);
  bool resolve_references(ProgramLine& line, BlockWords& block);
  bool take_sweep(ProgramLine& line, BlockWords& block);
  bool take_point_between(ProgramLine& line, BlockWords& block);
  bool take_tangent(ProgramLine& line, BlockWords& block);
  bool take_angle(ProgramLine& line, BlockWords& block);
  [[nodiscard]] bool has_one_radius() const {
    return state_.setup().tools.empty() && state_.setup().mode.tool_radius != 0;
  }
  // A table, or one radius for all.
  [[nodiscard]] bool gives_radii() const {
    return has_one_radius() || !state_.setup().tools.empty() || state_.setup().tool_radius_given;
  }
  bool take_only_register(const ProgramLine& line, BlockWords& block, std::int64_t number);
  bool take_only_spindle_tool();
  bool refuse_second_edge(std::int64_t row);
  bool choose_tool_of_edge(ProgramLine& line, BlockWords& block);
  bool read_edge_data(const NamedWord& word, ProgramLine& line, BlockWords& block);
  [[nodiscard]] std::string name_not_in_table(const std::string& name) const;
  // G147 … G348: sinumerik_leads.cpp.
  bool read_soft_word(const NamedWord& word, ProgramLine& line, BlockWords& block);
  bool take_soft_lead(ProgramLine& line, BlockWords& block);
  bool check_soft_lead(ProgramLine& line, const BlockWords& block);
  bool approach_softly(ProgramLine& line, BlockWords& block);
  bool begin_contour_of_approach(ProgramLine& line, BlockWords& block);
  bool depart_softly(ProgramLine& line, BlockWords& block);
  [[nodiscard]] Lead soft_lead_of(const BlockWords& block) const;
  bool find_soft_end(const ProgramLine& line, const BlockWords& block,
                     std::array<std::optional<double>, 3>& end);
  bool refuse_clearance(const ProgramLine& line, std::uint32_t begin);
  [[nodiscard]] std::optional<SoftClearance> clearance_of(const BlockWords& block) const;
  [[nodiscard]] static std::optional<double> height_of(
      const std::optional<SoftClearance>& clearance, double plane, double away);

  bool check_block(ProgramLine& line, BlockWords& block);
  // Calls of what is not followed: passing_calls.cpp.
  bool read_passing_line(ProgramLine& line, BlockWords& block);
  bool read_call_of_machine(ProgramLine& line, BlockWords& block);
  void forget_what_a_call_may_change(ProgramLine& line, BlockWords& block, std::string_view call);
  bool restate_modes(ProgramLine& line, BlockWords& block);
  // Whether another tool may be in the spindle than at the last contour: 900225.
  void take_call(const ProgramLine& line, std::string_view call);
  bool watch_tool(const ProgramLine& line, const BlockWords& block);
  bool warn_of_other_tool(const ProgramLine& line, std::uint32_t begin);
  bool note_unknown_call(const ProgramLine& line, const BlockWords& block);

  bool apply(ProgramLine& line, const PlainMotion& plain);
  bool apply(ProgramLine& line, BlockWords& block);
  bool apply_modes(const ProgramLine& line, const BlockWords& block);
  void forget_position(const ProgramLine& line, const BlockWords& block);
  bool apply_trc(const ProgramLine& line, const BlockWords& block);
  bool apply_tool(const ProgramLine& line, const BlockWords& block);
  bool apply_motion(ProgramLine& line, BlockWords& block);
  bool check_feed_of_contour(const ProgramLine& line, const BlockWords& block, std::uint32_t begin);
  bool leave_out_bottlenecks(bool on, const Source& source);
  bool move_in_full_turns(ProgramLine& line, const BlockWords& block);
  bool move(ProgramLine& line, MoveRequest& request);
  [[nodiscard]] bool may_move_at_the_feed(const BlockWords& block) const;
  void scale(MoveRequest& request) const;
  bool pass_words(const ProgramLine& line, WordRole role);

  bool refuse(const ProgramLine& line, const TextFault& given);
  bool refuse_at(const WordPlace& place, Code code, std::string detail);
  [[nodiscard]] WordPlace place_of_word(const ProgramLine& line, std::uint32_t begin) const;
  // 0 behind the first of the lines that the block has.
  [[nodiscard]] std::uint32_t column_in(const ProgramLine& line, std::uint32_t begin) const {
    const bool one_line = line.source.line == lines_read_;
    const bool in_first_line = one_line || line.text.find_first_of("\r\n") >= begin;
    return in_first_line && knows_columns_ ? column_of(begin) : 0;
  }
  [[nodiscard]] static TextFault with_slip(const ProgramLine& line, TextFault fault);
  [[nodiscard]] bool is_within_slip(const Diagnostic& found) const;
  bool refuse(const ProgramLine& line, const Word& word, Code code, std::string detail = {});
  void guard_against_other_dialects(const ProgramLine& line, Diagnostic& fault) const;
  // From this line on.
  void count_in(const ProgramLine& line, bool inch);
  bool collect(Diagnostic fault);
  bool report_faults();
  [[nodiscard]] std::vector<Diagnostic> told_faults() const;
  // TRC is active, or its retract motion is still to come, as far as the text has been read.
  [[nodiscard]] bool contour_open() const {
    return faults_.empty() ? state_.contour_open() : scanned_trc_;
  }
  [[nodiscard]] bool trc_active() const {
    return faults_.empty() ? state_.mode().active() : scanned_trc_;
  }
  bool refuse_long_line();
  bool refuse_open_line();
  void place(const ProgramLine& line, std::uint32_t begin);
  // 1-based, of a byte of the first line as it was given.
  [[nodiscard]] std::uint32_t column_of(std::size_t begin) const {
    const std::size_t cut = begin < cut_.begin ? 0 : cut_.end - cut_.begin;
    return static_cast<std::uint32_t>(begin + cut + 1);
  }
  [[nodiscard]] double length_unit() const { return inch_ ? mm_per_inch : 1; }
  // Under G70 of Sinumerik feeds stay in mm.
  [[nodiscard]] double feed_unit(bool inch) const { return inch && !feed_in_mm_ ? mm_per_inch : 1; }
  [[nodiscard]] bool counts_in_inch(const GFunction& function) const {
    return function.number == dialect_.inch_function || function.number == 700;
  }

  // The first of its kind; the others only count.
  struct Fault {
    Code code{};
    Source source{};
    std::uint32_t column = 0;
    std::string detail{};
    Slip slip{};
    std::uint64_t lines = 1;
    std::uint32_t last_line = 0;
    // Of a program that computes, whose state is never saved while it is executed.
    std::vector<CallPlace> calls{};
    std::vector<DiagnosticValue> values{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(code, source, column, detail, slip.kind, slip.instead, lines, last_line);
    }
  };

  ReaderLimits limits_;
  const Dialect& dialect_;
  ProgramState& state_;
  Diagnostics& diagnostics_;
  std::array<std::int16_t, 26> axis_of_letter_{};  // 0 … 2 X Y Z, then tracking axes; -1: none

  // The text of a line whose end is still to come; it may hold the lines that
  // are continued.
  std::string partial_{};
  std::uint32_t continued_ = 0;   // line ends within partial_
  bool carriage_return_ = false;  // partial_ is complete, a line feed may follow
  std::vector<LinePointer> spare_{};
  std::uint64_t lines_read_ = 0;
  bool knows_columns_ = true;  // of the text that was given
  SkipSign cut_{};             // out of the line that is read
  std::uint64_t blocks_read_ = 0;
  std::uint32_t comment_block_ = 0;  // line of #COMMENT BEGIN; 0: not in one
  bool ended_ = false;

  MotionKind motion_ = MotionKind::rapid;
  bool motion_given_ = false;  // by the program, or by its control at the start
  bool incremental_ = false;
  bool inch_ = false;
  bool feed_in_mm_ = false;  // whatever lengths count in
  bool absolute_center_ = false;
  std::int16_t feed_mode_ = 94;
  double feed_ = 0;  // mm/min
  // A line of a motion and nothing else means what its words say.
  bool reads_plain_lines_ = true;
  bool sets_variables_ = false;     // the line that is read
  bool calls_the_machine_ = false;  // that line
  bool machine_follows_ = false;    // that line
  bool reads_flat_ = false;         // lines that a program which computes has become
  // A subprogram has been called, and the program has not said anew which motion holds and how
  // dimensions count.
  bool called_motion_ = false;
  bool called_dimension_ = false;
  bool in_subprogram_ = false;  // of a %L in front of the program
  bool isg_word_seen_ = false;  // one that no other dialect has
  CodeModes code_{};
  KlartextModes klartext_{};
  std::vector<Fault> faults_{};
  bool scanned_trc_ = false;  // behind the first fault: TRC is active
  // No line so far was a block: what does not read as one may stand in front of the tape.
  bool in_front_of_tape_ = false;
};

}  // namespace trc
