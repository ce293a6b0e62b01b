#include "core/nc/dialect/sinumerik_values.h"

#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/gcode_block_words.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_arcs.h"
#include "core/nc/dialect/sinumerik_functions.h"
#include "core/nc/dialect/sinumerik_leads.h"
#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/dialect/sinumerik_words.h"
#include "core/nc/dialect/tool_data.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/named_words.h"

// Words of Sinumerik with a name and a value: CR=5, RND=2, $TC_DP6[1,1]=5.

namespace trc {
namespace {

// The axis of POS[X]=10; none for POS[A]=10 and POS[Q1]=10, which do not move the path.
AxisBits main_axis_of(std::string_view assignment) {
  const std::size_t index = assignment.find_first_not_of("[ \t", assignment.find('['));
  if (index == std::string_view::npos) return 0;
  const char axis = upper(assignment[index]);
  return axis < 'X' || axis > 'Z' ? AxisBits{0}
                                  : main_axis_bit(static_cast<std::size_t>(axis - 'X'));
}

bool read_form_of_arc(Reading& reading, const NamedWord& word, ProgramLine& line,
                      BlockWords& block) {
  auto& target = word.name == "CR" ? block.move.radius : block.arc.sweep;
  if (target)
    return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice, "a second time");
  target = word.value;
  if (!block.center) block.center = word.begin;
  add(line, word, WordRole::coordinate);
  return true;
}

// RND=, CHF= and CHR= shape one corner, RNDM= all later ones.
bool read_corner(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block) {
  if (word.name == "RNDM") {
    if (block.corners.modal_rounding || word.value < 0)
      return refuse_word(reading, line, as_gcode(word), Code::nc_number, "once, 0 or more");
    block.corners.modal_rounding = {.value = word.value, .begin = word.begin};
  } else {
    if (block.corners.begin)
      return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice,
                         "a second rounding or chamfer");
    block.corners.begin = word.begin;
    block.move.corner = {.form = word.name == "RND"   ? CornerCut::Form::round
                                 : word.name == "CHR" ? CornerCut::Form::leg
                                                      : CornerCut::Form::width,
                         .size = word.value};
  }
  add(line, word, WordRole::technology);
  return true;
}

// ANG=, the angle of a motion, and TURN=, further turns of a circle.
bool read_angle_or_turns(Reading& reading, const NamedWord& word, ProgramLine& line,
                         BlockWords& block) {
  const bool turns = word.name == "TURN";
  if (!turns && reading.trc_active()) {
    if (block.angle)
      return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice, "a second ANG=");
    block.angle = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::trc);
    return true;
  }
  if (turns && reading.contour_open()) {
    if (block.arc.turns)
      return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice, "a second TURN=");
    block.arc.turns = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::coordinate);
    return true;
  }
  block.unfollowed_word = word.begin;
  add(line, word, WordRole::technology);
  return true;
}

// Passes words that do not affect the path, and refuses words that do.
bool pass_assignment(Reading& reading, const NamedWord& word, ProgramLine& line,
                     BlockWords& block) {
  const auto is = [&](std::string_view wanted) { return word.name == wanted; };
  const auto refused = [&](std::string_view why) {
    return refuse_word(reading, line, as_gcode(word), Code::nc_unsupported, why);
  };
  const bool is_corner_word = is_sinumerik_corner_word(word.name);
  if (is_corner_word) {
    auto& feed = is("FRC") ? block.corners.feed : block.corners.modal_feed;
    if (feed || word.value < 0)
      return refuse_word(reading, line, as_gcode(word), Code::nc_number, "once, 0 or more");
    feed = {.value = word.value, .begin = word.begin};
  }
  if (is("DISC") && word.value != 0) return refused("corners that reach out: DISC=0");
  if (is("FB")) block.own_feed = word.begin;
  if (is("FZ")) block.tooth_feed = word.begin;
  if (is("DL") && word.value != 0) return refused("a sum offset of the tool");
  const bool is_no_offset = word.name.starts_with("TOFF") && word.value == 0;
  const std::string_view refusal = refusal_of_sinumerik_word(word.name);
  const bool measures = word.name.starts_with("MEA");
  if (!refusal.empty() && !is_no_offset && !(measures && !reading.contour_open()))
    return refused(refusal);
  block.measures |= measures;
  const bool moves_axis = is("POS") || is("POSA");
  const AxisBits moved =
      moves_axis ? main_axis_of(line.word({.begin = word.begin, .end = word.end})) : AxisBits{0};
  if (moved != 0 && reading.contour_open()) return refused("a motion of an axis by itself");
  if (is("RPL") && reading.contour_open()) return refused("the angle of a rotation");
  block.forget |= moved;
  const bool ends_turned_tool = is("TCARR") || is("CUTMOD");
  const bool passes = is_passing_sinumerik_word(word.name) || ends_turned_tool || moves_axis ||
                      reading.state.setup().pass_words.contains(word.name) || is("DISC") ||
                      is("DL") || is_no_offset || is_corner_word || is("RPL") || measures;
  if (!passes && is_unread_sinumerik_word(word.name))
    return refused("a word of the language that is not read here");
  const bool is_of_system = word.name.starts_with('$');
  if (!passes && is_of_system) return refused("a variable");
  if (!passes && reading.contour_open())
    return refused("a variable of the machine while TRC is active");
  add(line, word, WordRole::technology);
  return true;
}

}  // namespace

bool read_assignment(Reading& reading, const NamedWord& word, ProgramLine& line,
                     BlockWords& block) {
  const auto is = [&](std::string_view wanted) { return word.name == wanted; };
  if (is("CR") || is("AR")) return read_form_of_arc(reading, word, line, block);
  if (is("RND") || is("CHF") || is("CHR") || is("RNDM"))
    return read_corner(reading, word, line, block);
  if (is("OFFN")) {
    if (block.tools.allowance)
      return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice, "a second OFFN");
    block.tools.allowance = {.value = word.value, .begin = word.begin};
    add(line, word, WordRole::trc);
    return true;
  }
  if (is("DISR") || is("DISCL") || is("DISRP") || is("FAD"))
    return read_soft_word(reading, word, line, block);
  if (is("AP") || is("RP")) return read_polar_word(reading, word, line, block);
  if (is("ANG") || is("TURN")) return read_angle_or_turns(reading, word, line, block);
  if (is_sinumerik_frame(word.name)) {
    // Like SCALE; the contents of a copied frame are not examined.
    const std::string value = in_upper_case(line.word({.begin = word.begin, .end = word.end}));
    const bool scales =
        value.find("CSCALE") != std::string::npos || value.find(",SC]") != std::string::npos;
    // The contents of a frame that is built on others, or set in part, are unknown.
    const std::size_t sign = std::min(value.find('='), value.size());
    const bool is_whole = value.find(',') > sign && value.find('$', sign) == std::string::npos;
    block.coordinates.frame = without_blanks_behind(std::string_view(value).substr(0, sign));
    if (!is_whole && !scales) block.coordinates.frame.clear();
    return read_as(scales ? by_name::scaling_frame : by_name::frame, word, line, block);
  }
  if (is("$TC_DP6") || is("$TC_DP15")) return read_edge_data(reading, word, line, block);
  // 0 ends both: the kinematics of the tool holder, and the tool turned with it.
  if ((is("TCARR") || is("CUTMOD")) && word.value != 0)
    return read_as(by_name::frame, word, line, block);
  return pass_assignment(reading, word, line, block);
}

}  // namespace trc
