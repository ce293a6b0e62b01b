#include <algorithm>
#include <array>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/sinumerik_words.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/named_words.h"

// What Sinumerik's language has beside plain letters and numbers: names, calls, values behind `=`,
// further forms of arcs. The rest is read as the other dialects: code_block_words.cpp.

namespace trc {
namespace {

using enum GGroup;

// What becomes of a name.
enum class Meaning : std::uint8_t {
  technology,
  frame,       // TRANS, ROT, …
  unfollowed,  // transformations, scaling
  spline,      // and polynomials and involutes, up to the next G00 … G03
  spatial,     // TRC in space
  spatial_end,
  unfollowed_end,
  single_move,  // SUPA
  modal_cycle,  // MCALL
  statement,    // IF, GOTOF, …: refused
  turning,
  refused,
};

struct Name {
  std::string_view name;
  Meaning meaning;
};

constexpr auto names = std::to_array<Name>({
    {"AMIRROR", Meaning::frame},
    {"AROT", Meaning::frame},
    {"AROTS", Meaning::frame},
    {"ASCALE", Meaning::unfollowed},
    {"ASPLINE", Meaning::spline},
    {"ATRANS", Meaning::frame},
    {"BAUTO", Meaning::technology},
    {"BNAT", Meaning::technology},
    {"BRISK", Meaning::technology},
    {"BRISKA", Meaning::technology},
    {"BSPLINE", Meaning::spline},
    {"BTAN", Meaning::technology},
    {"CASE", Meaning::statement},
    {"CFTCP", Meaning::technology},
    {"CLGOF", Meaning::technology},
    {"CLGON", Meaning::technology},
    {"COMPCAD", Meaning::technology},
    {"COMPCURV", Meaning::technology},
    {"COMPOF", Meaning::technology},
    {"COMPON", Meaning::technology},
    {"COMPSURF", Meaning::technology},
    {"CORROF", Meaning::frame},
    {"CP", Meaning::technology},
    {"CPRECOF", Meaning::technology},
    {"CPRECON", Meaning::technology},
    {"CSPLINE", Meaning::spline},
    {"CUT2D", Meaning::spatial_end},
    {"CUT2DF", Meaning::spatial_end},
    {"CUT3DC", Meaning::spatial},
    {"CUT3DCC", Meaning::spatial},
    {"CUT3DCCD", Meaning::spatial},
    {"CUT3DCD", Meaning::spatial},
    {"CUT3DF", Meaning::spatial},
    {"CUT3DFD", Meaning::spatial},
    {"CUT3DFF", Meaning::spatial},
    {"CUT3DFS", Meaning::spatial},
    {"CUTCONOF", Meaning::technology},
    {"DEF", Meaning::statement},
    {"DELAYFSTOF", Meaning::technology},
    {"DELAYFSTON", Meaning::technology},
    {"DIAM90", Meaning::turning},
    {"DIAMOF", Meaning::technology},
    {"DIAMON", Meaning::turning},
    {"DISPLOF", Meaning::technology},
    {"DISPLON", Meaning::technology},
    {"DRFOF", Meaning::technology},
    {"DRIVE", Meaning::technology},
    {"DYNFINISH", Meaning::technology},
    {"DYNNORM", Meaning::technology},
    {"DYNPOS", Meaning::technology},
    {"DYNPREC", Meaning::technology},
    {"DYNROUGH", Meaning::technology},
    {"DYNSEMIFIN", Meaning::technology},
    {"EAUTO", Meaning::technology},
    {"ELSE", Meaning::statement},
    {"ENAT", Meaning::technology},
    {"ENDFOR", Meaning::statement},
    {"ENDIF", Meaning::statement},
    {"ENDLOOP", Meaning::statement},
    {"ENDWHILE", Meaning::statement},
    {"ETAN", Meaning::technology},
    {"EXTCALL", Meaning::statement},
    {"EXTERN", Meaning::statement},
    {"FENDNORM", Meaning::technology},
    {"FFWOF", Meaning::technology},
    {"FFWON", Meaning::technology},
    {"FIFOCTRL", Meaning::technology},
    {"FLIN", Meaning::technology},
    {"FNORM", Meaning::technology},
    {"FOR", Meaning::statement},
    {"GOTO", Meaning::statement},
    {"GOTOB", Meaning::statement},
    {"GOTOC", Meaning::statement},
    {"GOTOF", Meaning::statement},
    {"GOTOS", Meaning::statement},
    {"GROUP_END", Meaning::technology},
    {"IF", Meaning::statement},
    {"INVCCW", Meaning::spline},
    {"INVCW", Meaning::spline},
    {"LFOF", Meaning::technology},
    {"LFON", Meaning::technology},
    {"LOOP", Meaning::statement},
    {"MCALL", Meaning::modal_cycle},
    {"MIRROR", Meaning::frame},
    {"ORIAXES", Meaning::technology},
    {"ORICURVE", Meaning::technology},
    {"ORIEULER", Meaning::technology},
    {"ORIMKS", Meaning::technology},
    {"ORIPLANE", Meaning::technology},
    {"ORIRESET", Meaning::technology},
    {"ORIROTA", Meaning::technology},
    {"ORIRPY", Meaning::technology},
    {"ORISOF", Meaning::technology},
    {"ORISON", Meaning::technology},
    {"ORIVECT", Meaning::technology},
    {"ORIVIRT1", Meaning::technology},
    {"ORIWKS", Meaning::technology},
    {"OSB", Meaning::technology},
    {"OSC", Meaning::technology},
    {"OSD", Meaning::technology},
    {"OSOF", Meaning::technology},
    {"OSS", Meaning::technology},
    {"OSSE", Meaning::technology},
    {"OST", Meaning::technology},
    {"PAROT", Meaning::frame},
    {"PAROTOF", Meaning::technology},
    {"POLY", Meaning::spline},
    {"PROC", Meaning::statement},
    {"REPEAT", Meaning::statement},
    {"REPEATB", Meaning::statement},
    {"RET", Meaning::statement},
    {"ROT", Meaning::frame},
    {"ROTS", Meaning::frame},
    {"RTLIOF", Meaning::technology},
    {"RTLION", Meaning::technology},
    {"SBLOF", Meaning::technology},
    {"SBLON", Meaning::technology},
    {"SCALE", Meaning::unfollowed},
    {"SETMS", Meaning::technology},
    {"SOFT", Meaning::technology},
    {"SOFTA", Meaning::technology},
    {"SPATH", Meaning::technology},
    {"SPCOF", Meaning::technology},
    {"SPCON", Meaning::technology},
    {"SPIF1", Meaning::technology},
    {"SPIF2", Meaning::technology},
    {"STARTFIFO", Meaning::technology},
    {"STOPFIFO", Meaning::technology},
    {"STOPRE", Meaning::technology},
    {"SUPA", Meaning::single_move},
    {"TCOABS", Meaning::technology},
    {"TOFRAME", Meaning::frame},
    {"TOFRAMEX", Meaning::frame},
    {"TOFRAMEY", Meaning::frame},
    {"TOFRAMEZ", Meaning::frame},
    {"TOROT", Meaning::frame},
    {"TOROTOF", Meaning::frame},
    {"TOROTX", Meaning::frame},
    {"TOROTY", Meaning::frame},
    {"TOROTZ", Meaning::frame},
    {"TOWSTD", Meaning::technology},
    {"TRAANG", Meaning::unfollowed},
    {"TRACON", Meaning::unfollowed},
    {"TRACYL", Meaning::unfollowed},
    {"TRAFOOF", Meaning::unfollowed_end},
    {"TRAFOON", Meaning::unfollowed},
    {"TRANS", Meaning::frame},
    {"TRANSMIT", Meaning::unfollowed},
    {"TRAORI", Meaning::unfollowed},
    {"UNTIL", Meaning::statement},
    {"UPATH", Meaning::technology},
    {"WAITENC", Meaning::technology},
    {"WAITS", Meaning::technology},
    {"WALIMOF", Meaning::technology},
    {"WALIMON", Meaning::technology},
    {"WHILE", Meaning::statement},
});
static_assert(std::ranges::is_sorted(names, {}, &Name::name));

// Calls that say nothing about where the path runs.
constexpr auto passing_calls = std::to_array<std::string_view>(
    {"COUPOF", "COUPON", "CYCLE832", "FGROUP", "FPRAOF", "FPRAON", "GROUP_ADDEND", "GROUP_BEGIN",
     "GROUP_END", "MMC", "MSG", "ORIRESET", "SETAL", "SETMS", "SPOS", "WAITM", "WAITS", "WORKPIECE",
     "WRITE"});
// CYCLE, HOLES, POCKET, SLOT and the like: what they move only the control knows.
constexpr auto cycles = std::to_array<std::string_view>(
    {"CYCLE", "HOLES", "POCKET", "SLOT", "LONGHOLE", "TRANSMIT", "TRACYL", "F_"});
// Words with values that say nothing about where the path runs.
constexpr auto passing_assignments = std::to_array<std::string_view>({"$AC_ACTUAL_PARTS",
                                                                      "$AC_MARKER",
                                                                      "$AC_PARAM",
                                                                      "$AC_REQUIRED_PARTS",
                                                                      "$AC_SPECIAL_PARTS",
                                                                      "$AC_TIMER",
                                                                      "$AC_TOTAL_PARTS",
                                                                      "$A_DB",
                                                                      "$A_DL",
                                                                      "$A_OUT",
                                                                      "$TC_",
                                                                      "ACC",
                                                                      "ADIS",
                                                                      "ADISPOS",
                                                                      "CTOL",
                                                                      "FA",
                                                                      "FB",
                                                                      "FD",
                                                                      "FGREF",
                                                                      "FL",
                                                                      "FP",
                                                                      "FZ",
                                                                      "JERKLIM",
                                                                      "LIMS",
                                                                      "OTOL",
                                                                      "OVR",
                                                                      "SCC",
                                                                      "SPOS",
                                                                      "SVC",
                                                                      "VELOLIM"});
// What changes the radius, or ends a motion where only the control knows.
struct RefusedWord {
  std::string_view beginning;
  std::string_view why;
};
constexpr auto refused_words = std::to_array<RefusedWord>(
    {{"MEA", "measuring"}, {"TOFF", "an offset of the tool beside its data"}});
// Words with values that round or bevel corners.
constexpr auto corner_words = std::to_array<std::string_view>({"FRC", "FRCM"});

// The functions that names stand for.
constexpr GFunction frame_name{.number = 1000, .group = frame, .meaning = "a frame"};
constexpr GFunction absolute_frame_name{
    .number = absolute_frame, .group = frame, .meaning = "a frame"};
constexpr GFunction unfollowed_name{
    .number = 1001, .group = unfollowed, .meaning = "a transformation"};
constexpr GFunction scale_name{.number = 1006, .group = unfollowed, .meaning = "scaling"};
constexpr GFunction frame_scale{
    .number = scaling_frame, .group = unfollowed, .meaning = "a frame that scales"};
constexpr GFunction spline_name{
    .number = spline_interpolation, .group = unfollowed, .meaning = "a spline or a polynomial"};
constexpr GFunction spatial_name{
    .number = compensation_in_space, .group = unfollowed, .meaning = "TRC in space (CUT3D…)"};
constexpr GFunction unfollowed_end_name{.number = 1002, .group = unfollowed_end};
constexpr GFunction single_name{
    .number = 1003, .group = single_move, .meaning = "a cycle or motion of its own"};
constexpr GFunction cycle_name{.number = 1004, .group = cycle, .meaning = "a modal cycle"};
constexpr GFunction around_the_corner{.number = 139, .group = selection};
constexpr GFunction straight_to_the_contour{.number = 138, .group = selection};
constexpr GFunction feed_at_contour{.number = 11, .group = feed_adaptation};
constexpr GFunction feed_at_inside_arcs{.number = feed_at_inside, .group = feed_adaptation};
constexpr GFunction feed_at_center{.number = 10, .group = feed_adaptation};
constexpr GFunction unknown_name{
    .number = 1007, .group = single_move, .meaning = "an unknown name"};
constexpr GFunction call_name{.number = 1007, .group = single_move, .meaning = "a call"};
constexpr GFunction cycle_end_name{.number = 1005, .group = cycle_end};

bool begins_with_any(std::string_view name, std::span<const std::string_view> beginnings) {
  return std::ranges::any_of(beginnings,
                             [&](std::string_view begin) { return name.starts_with(begin); });
}

CodeWord as_code(const NamedWord& word) {
  return {.kind = CodeWord::Kind::address,
          .letter = word.letter,
          .has_number = true,
          .whole = word.whole,
          .value = word.value,
          .begin = word.begin,
          .end = word.end};
}

// Names that say more than the table above.
constexpr auto names_of_motion = std::to_array<std::string_view>(
    {"CDOF", "CDOF2", "CDON", "CFC", "CFIN", "CIP", "CT", "KONT", "KONTC", "KONTT", "NORM"});
// Words with values that read_assignment() follows.
constexpr auto followed_words = std::to_array<std::string_view>(
    {"ANG",  "AP",  "AR",   "CHF", "CHR", "CR",   "DISC",   "DISCL", "DISR", "DISRP", "FAD",
     "OFFN", "RND", "RNDM", "RP",  "RPL", "TURN", "CUTMOD", "POS",   "POSA", "TCARR", "DL"});

const Name* row_of(std::string_view name) {
  const auto found = std::ranges::lower_bound(names, name, {}, &Name::name);
  return found != names.end() && found->name == name ? &*found : nullptr;
}

// POS[X]=10; POS[A]=10 and POS[Q1]=10 move what has no part in the path.
bool moves_main_axis(std::string_view assignment) {
  const std::size_t index = assignment.find_first_not_of("[ \t", assignment.find('['));
  return index != std::string_view::npos && upper(assignment[index]) >= 'X' &&
         upper(assignment[index]) <= 'Z';
}

const RefusedWord* refusal_of(std::string_view name) {
  const auto found = std::ranges::find_if(
      refused_words, [&](const RefusedWord& word) { return name.starts_with(word.beginning); });
  return found == refused_words.end() ? nullptr : &*found;
}

bool is_statement(const NamedWord& word) {
  return word.kind == NamedWord::Kind::name && is_sinumerik_statement(word.name);
}

}  // namespace

bool is_sinumerik_statement(std::string_view name) {
  const Name* const row = row_of(name);
  return row != nullptr && row->meaning == Meaning::statement;
}

bool is_sinumerik_name(std::string_view name) {
  return row_of(name) != nullptr ||
         std::ranges::find(names_of_motion, name) != names_of_motion.end();
}

bool is_sinumerik_call(std::string_view name) {
  return begins_with_any(name, cycles) || name == "TRAORI" ||
         std::ranges::find(passing_calls, name) != passing_calls.end();
}

bool is_sinumerik_frame(std::string_view name) {
  return name.starts_with("$P_") && (name.ends_with("FR") || name.ends_with("FRAME"));
}

bool is_sinumerik_word(std::string_view name) {
  return begins_with_any(name, passing_assignments) || is_sinumerik_frame(name) ||
         std::ranges::find(corner_words, name) != corner_words.end() ||
         std::ranges::find(followed_words, name) != followed_words.end() ||
         refusal_of(name) != nullptr;
}

bool is_sinumerik_word_of_any_kind(std::string_view name) {
  return is_sinumerik_name(name) || is_sinumerik_call(name) || is_sinumerik_word(name);
}

bool Interpreter::read_named_words(ProgramLine& line, BlockWords& block) {
  NamedWordReader reader(line.text);
  std::size_t faults = 0;
  for (;;) {
    const NamedWord word = reader.next();
    switch (word.kind) {
      case NamedWord::Kind::end:
        return complete_code_block(line, block) && faults == 0;
      case NamedWord::Kind::fault:
        refuse(line, reader.fault());
        ++faults;
        break;
      case NamedWord::Kind::comment:
        add(line, word, WordRole::comment);
        break;
      case NamedWord::Kind::label:  // stands in front, as words of modes do
        add(line, word, WordRole::mode);
        break;
      case NamedWord::Kind::skip:
        block.to_skip = true;
        add(line, word, WordRole::technology);
        break;
      case NamedWord::Kind::address:
        faults += read_named_address(word, line, block) ? 0 : 1;
        break;
      case NamedWord::Kind::assignment:
        faults += read_assignment(word, line, block) ? 0 : 1;
        break;
      case NamedWord::Kind::name:
      case NamedWord::Kind::call:
        faults += read_name(word, line, block) ? 0 : 1;
        // What follows is part of the statement.
        if (is_statement(word)) return false;
        break;
    }
    if (diagnostics_.stopped() || faults >= limits_.most_faults) return false;
  }
}

// T1=5 and M1=6 are those of the spindle; further ones have tools of their own, which no contour of
// G41 counts on. Beside them S, H and M of one spindle pass; axes are looked at by their names.
bool Interpreter::check_index(const NamedWord& word, const ProgramLine& line) {
  if (word.index < 0 || word.letter <= 'C' || word.letter >= 'U') return true;
  if (word.letter >= 'I' && word.letter <= 'K') return true;
  const auto wrong = [&](std::string_view why) {
    return refuse_code(line, as_code(word), Code::nc_unsupported, why);
  };
  const bool changes = word.letter == 'M' && word.value == 6;
  if (word.letter == 'T' || changes) return word.index == 1 || wrong("the tool of another spindle");
  const bool ends = word.letter == 'M' && (word.value <= 2 || word.value == 17 || word.value == 30);
  const bool passes = word.letter == 'S' || word.letter == 'H' || (word.letter == 'M' && !ends);
  return passes || wrong("with the number of a spindle");
}

bool Interpreter::read_named_address(const NamedWord& word, ProgramLine& line, BlockWords& block) {
  const char letter = word.letter;
  const CodeWord code = as_code(word);
  const bool center = letter >= 'I' && letter <= 'K';
  if (!check_index(word, line)) return false;
  if (letter == 'T' && word.is_text) {
    if (block.tool_number) return refuse_code(line, code, Code::nc_word_twice);
    code_.tool_name = word.name;
    block.tool_number = {.value = -1, .begin = word.begin};
    block.named_tool = state_.tool().tool_named(word.name);
    add(line, word, WordRole::technology);
    return true;
  }
  if (word.is_text) return refuse_code(line, code, Code::nc_syntax, "a text");
  if (letter == 'T') code_.tool_name.clear();
  const bool passes =
      letter == 'L' &&
      (passes_word(state_.setup(), line.text, word.begin) ||
       in_upper_case(line.word({.begin = word.begin, .end = word.end})) == standard_tool_change);
  if (passes) {
    block.calls_the_machine = true;
    block.functions[static_cast<std::size_t>(single_move)] = {.function = &call_name,
                                                              .begin = word.begin};
    add(line, word, WordRole::technology);
    return true;
  }
  if (letter == 'L' || letter == 'E')
    return refuse_code(line, code, Code::nc_unsupported, "a subprogram call");
  if (center && word.index == 1) {  // the point between of CIP
    block.through[static_cast<std::size_t>(letter - 'I')] = {.value = word.value,
                                                             .begin = word.begin};
    add(line, word, WordRole::coordinate);
    return true;
  }
  if (word.is_variable) {
    if (contour_open())
      return refuse_code(line, code, Code::nc_unsupported, "a variable or an expression");
    block.unfollowed_word = word.begin;
    add(line, word, WordRole::technology);
    return true;
  }
  const bool axis = letter <= 'C' || letter >= 'U';
  if (word.index >= 0 && (axis || center)) {
    // X1=0 of G74 and G75; an axis with such a name is not followed.
    if (!block.has(single_move)) return refuse_code(line, code, Code::nc_axis_unknown);
    add(line, word, WordRole::technology);
    return true;
  }
  const bool is_plain = letter == 'T' || (letter == 'M' && word.value == 6);
  if (word.index >= 0 && !is_plain) {  // S1=500, M1=3
    ++block.words;
    add(line, word, WordRole::technology);
    return true;
  }
  if (word.is_way_round && !block.way_round) block.way_round = word.begin;
  if (word.reference != NamedWord::Reference::modal) {
    const bool incremental = word.reference == NamedWord::Reference::incremental;
    if (letter >= 'X' && letter <= 'Z') {
      block.end_reference[static_cast<std::size_t>(letter - 'X')] = incremental ? -1 : 1;
    } else if (center) {
      block.center_reference[static_cast<std::size_t>(letter - 'I')] = incremental ? -1 : 1;
    } else if (incremental || incremental_) {
      return refuse_code(line, code, Code::nc_unsupported, "AC or IC of a further axis");
    }
  }
  if (letter == 'M' && word.value == 17) {
    line.ends_program = true;
    add(line, word, WordRole::stop);
    return true;
  }
  return read_code_word(code, line, block);
}

bool Interpreter::read_assignment(const NamedWord& word, ProgramLine& line, BlockWords& block) {
  const std::string_view name = line.word({.begin = word.begin, .end = word.end});
  const auto is = [&](std::string_view wanted) { return word.name == wanted; };
  const auto refused = [&](Code code, std::string_view why) {
    return refuse(line, TextFault{.code = code,
                                  .begin = word.begin,
                                  .detail = std::string(name).append(", ").append(why)});
  };
  if (is("CR") || is("AR")) {
    auto& target = is("CR") ? block.move.radius : block.sweep;
    if (target) return refused(Code::nc_word_twice, "a second time");
    target = word.value;
    if (!block.center) block.center = word.begin;
    add(line, word, WordRole::coordinate);
    return true;
  }
  if (is("RND") || is("CHF") || is("CHR")) {
    if (block.corner) return refused(Code::nc_word_twice, "a second rounding or chamfer");
    block.corner = word.begin;
    block.move.corner = {.form = is("RND")   ? CornerCut::Form::round
                                 : is("CHR") ? CornerCut::Form::leg
                                             : CornerCut::Form::width,
                         .size = word.value};
    add(line, word, WordRole::technology);
    return true;
  }
  if (is("RNDM")) {
    if (block.modal_rounding || word.value < 0) return refused(Code::nc_number, "once, 0 or more");
    block.modal_rounding = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::technology);
    return true;
  }
  if (std::ranges::find(corner_words, word.name) != corner_words.end() && trc_active() &&
      word.value != 0)
    return refused(Code::nc_unsupported, "a rounding or a chamfer while TRC is active");
  if (is("OFFN")) {
    if (block.allowance) return refused(Code::nc_word_twice, "a second OFFN");
    block.allowance = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::trc);
    return true;
  }
  if (is("DISC") && word.value != 0)
    return refused(Code::nc_unsupported, "corners that reach out: DISC=0");
  if (is("DISR") || is("DISCL") || is("DISRP") || is("FAD"))
    return read_soft_word(word, line, block);
  if (is("AP") || is("RP")) return read_polar_word(word, line, block);
  if (is("ANG") && trc_active()) return refused(Code::nc_unsupported, "the angle of a motion");
  if (is("TURN") && contour_open()) {
    if (block.turns) return refused(Code::nc_word_twice, "a second TURN=");
    block.turns = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::coordinate);
    return true;
  }
  if (is("TURN") || is("ANG")) {
    block.unfollowed_word = word.begin;
    add(line, word, WordRole::technology);
    return true;
  }
  if (is_sinumerik_frame(word.name)) {
    // As SCALE; what a frame holds that is copied is not looked into.
    const std::string value = in_upper_case(name);
    const bool scales =
        value.find("CSCALE") != std::string::npos || value.find(",SC]") != std::string::npos;
    const GFunction& function = scales ? frame_scale : frame_name;
    block.functions[static_cast<std::size_t>(function.group)] = {.function = &function,
                                                                 .begin = word.begin};
    add(line, word, WordRole::technology);
    return true;
  }
  if (is("$TC_DP6") || is("$TC_DP15")) return read_edge_data(word, line, block);
  // 0 ends them: the kinematics of the tool holder, the tool that is turned with it.
  const bool turns_tool = is("TCARR") || is("CUTMOD");
  if (turns_tool && word.value != 0) {
    block.functions[static_cast<std::size_t>(frame)] = {.function = &frame_name,
                                                        .begin = word.begin};
    add(line, word, WordRole::technology);
    return true;
  }
  if (is("FB")) block.own_feed = word.begin;
  if (is("FZ")) block.tooth_feed = word.begin;
  if (is("DL") && word.value != 0) return refused(Code::nc_unsupported, "a sum offset of the tool");
  const RefusedWord* const word_refused = refusal_of(word.name);
  const bool is_no_offset = word.name.starts_with("TOFF") && word.value == 0;
  if (word_refused != nullptr && !is_no_offset)
    return refused(Code::nc_unsupported, word_refused->why);
  const bool moves_axis = is("POS") || is("POSA");
  if (moves_axis && moves_main_axis(name))
    return refused(Code::nc_unsupported, "a motion of an axis by itself");
  const bool passes = begins_with_any(word.name, passing_assignments) || turns_tool || moves_axis ||
                      state_.setup().pass_words.contains(word.name) || is("DISC") || is("DL") ||
                      is_no_offset ||
                      std::ranges::find(corner_words, word.name) != corner_words.end() || is("RPL");
  if (!passes) return refused(Code::nc_unsupported, "a variable");
  add(line, word, WordRole::technology);
  return true;
}

bool Interpreter::read_name(const NamedWord& word, ProgramLine& line, BlockWords& block) {
  const auto refused = [&](std::string_view why) {
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = word.begin,
                                  .detail = std::string(word.name).append(", ").append(why)});
  };
  const auto stands_for = [&](const GFunction& function) {
    block.functions[static_cast<std::size_t>(function.group)] = {.function = &function,
                                                                 .begin = word.begin};
    add(line, word, WordRole::technology);
    return true;
  };
  ++block.words;
  if (word.kind == NamedWord::Kind::call) {
    const bool passes = std::ranges::find(passing_calls, word.name) != passing_calls.end();
    if (begins_with_any(word.name, cycles) && !passes) {
      if (word.name.starts_with("TRA")) return stands_for(unfollowed_name);
      if (!block.has(cycle)) return stands_for(single_name);
      add(line, word, WordRole::technology);
      return true;
    }
    const bool declared = state_.setup().pass_words.contains(word.name);
    if (!passes && !declared && word.name != "TRAORI") {
      block.calls_the_machine = true;
      return stands_for(call_name);
    }
    if (word.name == "TRAORI") return stands_for(unfollowed_name);
    add(line, word, WordRole::technology);
    return true;
  }
  if (word.name == "CIP") {
    block.functions[static_cast<std::size_t>(motion)] = {.function = dialect_.function(2),
                                                         .begin = word.begin};
    block.is_through = true;
    add(line, word, WordRole::motion);
    return true;
  }
  if (word.name == "CFC") return stands_for(feed_at_contour);
  if (word.name == "CFTCP") return stands_for(feed_at_center);
  if (word.name == "CFIN") return stands_for(feed_at_inside_arcs);
  if (word.name == "CT") block.begins_tangent_arcs = true;
  if (word.name == "KONTC" || word.name == "KONTT")
    return refused("an approach that goes on smoothly: NORM or KONT");
  if (word.name == "KONT" || word.name == "NORM") {
    // D-51. Without G41 and G42 the word says nothing: it stays.
    return stands_for(word.name == "KONT" ? around_the_corner : straight_to_the_contour);
  }
  if (word.name == "CDON" || word.name == "CDOF" || word.name == "CDOF2") {
    block.masks = word.name == "CDON";
    add(line, word, WordRole::technology);
    return true;
  }
  const auto found = std::ranges::lower_bound(names, word.name, {}, &Name::name);
  const bool known = found != names.end() && found->name == word.name;
  if (!known && state_.setup().pass_words.contains(word.name)) {
    add(line, word, WordRole::technology);
    return true;
  }
  const bool copied = !known && state_.setup().copies_unknown_words;
  if (copied && word.name != "CT") return stands_for(unknown_name);
  if (!known && word.name != "CT") return refused("a name");
  switch (known ? found->meaning : Meaning::technology) {
    case Meaning::frame: {
      const bool absolute = word.name == "TRANS" || word.name == "ROT" || word.name == "ROTS" ||
                            word.name == "MIRROR";
      return stands_for(absolute ? absolute_frame_name : frame_name);
    }
    case Meaning::unfollowed:
      return stands_for(word.name.ends_with("SCALE") ? scale_name : unfollowed_name);
    case Meaning::spline:
      return stands_for(spline_name);
    case Meaning::spatial:
      return stands_for(spatial_name);
    case Meaning::spatial_end:
      if (code_.unfollowed == compensation_in_space * 10) return stands_for(unfollowed_end_name);
      break;
    case Meaning::unfollowed_end:
      return stands_for(unfollowed_end_name);
    case Meaning::single_move:
      return stands_for(single_name);
    case Meaning::modal_cycle: {
      // Alone it ends the cycle.
      const bool ends = line.text.find('(', word.end) == std::string::npos;
      return stands_for(ends ? cycle_end_name : cycle_name);
    }
    case Meaning::statement:
      return refused("a statement");
    case Meaning::turning:
      code_.turning = true;
      return refuse(line,
                    TextFault{.code = Code::turning, .begin = word.begin, .detail = word.name});
    case Meaning::refused:
      return refused("which is not followed");
    case Meaning::technology:
      break;
  }
  add(line, word, word.name == "CT" ? WordRole::motion : WordRole::technology);
  return true;
}

}  // namespace trc
