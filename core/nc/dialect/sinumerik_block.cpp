#include "core/nc/dialect/sinumerik_block.h"

#include <algorithm>
#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/gcode_block.h"
#include "core/nc/dialect/gcode_block_words.h"
#include "core/nc/dialect/named_functions.h"
#include "core/nc/dialect/pass_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_functions.h"
#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/dialect/sinumerik_values.h"
#include "core/nc/dialect/sinumerik_words.h"
#include "core/nc/dialect/tool_data.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/named_words.h"

// A block of Sinumerik, and its words of one letter. sinumerik_functions.cpp reads names and calls,
// sinumerik_values.cpp words with a name and a value; gcode_block_words.cpp reads the rest as in
// the other dialects.

namespace trc {
namespace {

bool is_center_letter(char letter) { return letter >= 'I' && letter <= 'K'; }

// X1=5 if the setup has an axis X1: its index among the tracking axes; else -1.
int axis_of_index(const Reading& reading, const NamedWord& word) {
  if (word.index < 0) return -1;
  const std::string name = word.letter + std::to_string(word.index);
  const auto& names = reading.state.setup().tracking_axes;
  const auto found = std::ranges::find_if(
      names, [&](const std::string& candidate) { return same_name(candidate, name); });
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

// T1=5 and M1=6 belong to the main spindle. Other spindles have their own tools, which G41 never
// uses. S, H and M of any one spindle pass; axes are checked by their names.
bool check_index(Reading& reading, const NamedWord& word, const ProgramLine& line) {
  if (word.index < 0 || word.letter <= 'C' || word.letter >= 'U') return true;
  if (is_center_letter(word.letter) || axis_of_index(reading, word) >= 0) return true;
  const auto wrong = [&](std::string_view why) {
    return refuse_word(reading, line, as_gcode(word), Code::nc_unsupported, why);
  };
  const bool changes = word.letter == 'M' && word.value == 6;
  if (word.letter == 'T' || changes) return word.index == 1 || wrong("the tool of another spindle");
  const bool ends = word.letter == 'M' && (word.value <= 2 || word.value == 17 || word.value == 30);
  const bool passes = word.letter == 'S' || word.letter == 'H' || (word.letter == 'M' && !ends);
  return passes || wrong("with the number of a spindle");
}

// T="MILL"
bool read_tool_name(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block) {
  if (word.letter != 'T')
    return refuse_word(reading, line, as_gcode(word), Code::nc_syntax, "a text");
  if (block.tools.t_word) return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice);
  const std::int64_t number = number_of_tool_named(word.name, reading.state.tool());
  if (number > 0) {
    reading.gcode.tools.name.clear();
    block.tools.t_word = {.value = static_cast<double>(number), .begin = word.begin};
  } else {
    reading.gcode.tools.name = word.name;
    block.tools.t_word = {.value = -1, .begin = word.begin};
    block.tools.named = reading.state.tool().tool_named(word.name);
  }
  add(line, word, WordRole::technology);
  return true;
}

// L10 calls a subprogram. A subprogram that only the machine has passes.
bool read_call_by_letter(Reading& reading, const NamedWord& word, ProgramLine& line,
                         BlockWords& block) {
  const bool passes =
      word.letter == 'L' &&
      (passes_word(reading.state.setup(), line.text, word.begin) ||
       in_upper_case(line.word({.begin = word.begin, .end = word.end})) == standard_tool_change);
  if (!passes)
    return refuse_word(reading, line, as_gcode(word), Code::nc_unsupported, "a subprogram call");
  block.calls_the_machine = true;
  return read_as(by_name::call, word, line, block);
}

// S1=500 and M1=3 belong to a spindle; X1=0 of G74 and G75 names an axis.
bool read_word_of_index(Reading& reading, const NamedWord& word, ProgramLine& line,
                        BlockWords& block) {
  if (const int axis = axis_of_index(reading, word); axis >= 0 && !block.has(GGroup::single_move)) {
    const auto index = static_cast<std::size_t>(axis);
    block.move.tracking.resize(reading.state.setup().tracking_axes.size());
    if (block.move.tracking[index])
      return refuse_word(reading, line, as_gcode(word), Code::nc_word_twice);
    block.move.tracking[index] = word.value;
    if (!block.axis) block.axis = word.begin;
    ++block.words;
    add(line, word, WordRole::coordinate);
    return true;
  }
  const bool names_axis = word.letter <= 'C' || word.letter >= 'U' || is_center_letter(word.letter);
  if (names_axis && !block.has(GGroup::single_move))
    return refuse_word(reading, line, as_gcode(word), Code::nc_axis_unknown);
  if (!names_axis) ++block.words;
  add(line, word, WordRole::technology);
  return true;
}

// I1= J1= K1=: the intermediate point of CIP.
bool is_point_between(const NamedWord& word) {
  return is_center_letter(word.letter) && word.index == 1;
}

// X=AC(10), I=IC(5), I1=IC(5)
void take_reference(const NamedWord& word, BlockWords& block) {
  if (word.reference == NamedWord::Reference::modal) return;
  const bool incremental = word.reference == NamedWord::Reference::incremental;
  if (is_point_between(word)) {
    block.references.through[static_cast<std::size_t>(word.letter - 'I')] = incremental ? -1 : 1;
  } else if (word.letter >= 'X' && word.letter <= 'Z') {
    block.references.end[static_cast<std::size_t>(word.letter - 'X')] = incremental ? -1 : 1;
  } else if (is_center_letter(word.letter)) {
    block.references.center[static_cast<std::size_t>(word.letter - 'I')] = incremental ? -1 : 1;
  }
}

// C=IC(90), and C=AC(90) under G91: only the control knows where the further axis stands.
bool is_beside_count_of_line(const Reading& reading, const NamedWord& word) {
  const bool incremental = word.reference == NamedWord::Reference::incremental;
  const bool is_main = word.letter >= 'X' && word.letter <= 'Z' && word.index < 0;
  return word.reference != NamedWord::Reference::modal && !is_main &&
         !is_center_letter(word.letter) && (incremental || reading.incremental);
}

// It is copied; beside a contour check_motion_before() refuses it.
bool copy_further_axis(Reading& reading, const NamedWord& word, ProgramLine& line,
                       BlockWords& block) {
  const bool is_axis =
      word.index >= 0 ? axis_of_index(reading, word) >= 0
                      : reading.axis_of_letter[static_cast<std::size_t>(word.letter - 'A')] >= 0;
  if (!is_axis && (word.letter <= 'C' || word.letter >= 'U'))
    return refuse_word(reading, line, as_gcode(word), Code::nc_axis_unknown);
  if (!is_axis)
    return refuse_word(reading, line, as_gcode(word), Code::nc_unsupported,
                       "a reference that it cannot have");
  ++block.words;
  if (!block.further_count) block.further_count = word.begin;
  add(line, word, WordRole::technology);
  return true;
}

bool read_named_address(Reading& reading, const NamedWord& word, ProgramLine& line,
                        BlockWords& block) {
  const char letter = word.letter;
  if (!check_index(reading, word, line)) return false;
  if (word.is_text) return read_tool_name(reading, word, line, block);
  if (letter == 'R')
    return refuse_word(reading, line, as_gcode(word), Code::nc_unsupported,
                       "a parameter and no radius");
  if (letter == 'T') reading.gcode.tools.name.clear();
  if (letter == 'L' || letter == 'E') return read_call_by_letter(reading, word, line, block);
  if (is_point_between(word)) {
    take_reference(word, block);
    block.arc.through[static_cast<std::size_t>(letter - 'I')] = {.value = word.value,
                                                                 .begin = word.begin};
    add(line, word, WordRole::coordinate);
    return true;
  }
  if (word.is_variable) {
    if (reading.contour_open())
      return refuse_word(reading, line, as_gcode(word), Code::nc_unsupported,
                         "a variable or an expression");
    if (!block.without_value.begin) block.without_value.begin = word.begin;
    if (letter >= 'X' && letter <= 'Z')
      block.without_value.axes |= main_axis_bit(static_cast<std::size_t>(letter - 'X'));
    add(line, word, WordRole::technology);
    return true;
  }
  if (is_beside_count_of_line(reading, word)) return copy_further_axis(reading, word, line, block);
  const bool chooses_tool = letter == 'T' || (letter == 'M' && word.value == 6);
  if (word.index >= 0 && !chooses_tool) return read_word_of_index(reading, word, line, block);
  if (word.is_way_round && !block.way_round) block.way_round = word.begin;
  take_reference(word, block);
  if (letter == 'M' && word.value == 17) {
    line.ends_program = true;
    add(line, word, WordRole::stop);
    return true;
  }
  return read_gcode_word(reading, as_gcode(word), line, block);
}

}  // namespace

bool read_named_words(Reading& reading, ProgramLine& line, BlockWords& block) {
  NamedWordReader reader(line.text);
  std::size_t faults = 0;
  for (;;) {
    const NamedWord word = reader.next();
    switch (word.kind) {
      case NamedWord::Kind::end:
        return complete_gcode_block(reading, line, block) && faults == 0;
      case NamedWord::Kind::fault:
        reading.refuse(line, reader.fault());
        ++faults;
        break;
      case NamedWord::Kind::comment:
        add(line, word, WordRole::comment);
        break;
      case NamedWord::Kind::label:  // a label comes first, like words of modes
        add(line, word, WordRole::mode);
        break;
      case NamedWord::Kind::skip:
        block.to_skip = true;
        add(line, word, WordRole::technology);
        break;
      case NamedWord::Kind::address:
        faults += read_named_address(reading, word, line, block) ? 0 : 1;
        break;
      case NamedWord::Kind::assignment:
        faults += read_assignment(reading, word, line, block) ? 0 : 1;
        break;
      case NamedWord::Kind::name:
        if (word.name == "EXTERN") {  // of a subprogram that only the machine has
          NamedWord declaration = word;
          declaration.end = static_cast<std::uint32_t>(line.text.size());
          add(line, declaration, WordRole::technology);
          return complete_gcode_block(reading, line, block) && faults == 0;
        }
        faults += read_name(reading, word, line, block) ? 0 : 1;
        // The rest of the line is part of the statement, or names what a refused call calls.
        if (is_sinumerik_statement(word.name) || (faults > 0 && calls_by_name(word.name)))
          return false;
        break;
      case NamedWord::Kind::call:
        faults += read_named_call(reading, word, line, block) ? 0 : 1;
        break;
    }
    if (reading.diagnostics.stopped() || faults >= reading.limits.most_faults) return false;
  }
}

}  // namespace trc
