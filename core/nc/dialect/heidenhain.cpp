#include "core/nc/dialect/heidenhain.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_block_words.h"
#include "core/nc/dialect/klartext_checks.h"
#include "core/nc/dialect/klartext_motion.h"
#include "core/nc/dialect/klartext_statements.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"

// Reads a block of Klartext. Its effect: klartext_motion.cpp.

namespace trc {
namespace {

using Kind = KlartextWord::Kind;

struct Motion {
  std::string_view name{};
  KlartextStatement statement{};
};

constexpr auto motions = [] {
  using enum KlartextStatement;
  return std::to_array<Motion>({{"L", straight},
                                {"LP", polar_line},
                                {"CC", center},
                                {"C", circle},
                                {"CR", radius_arc},
                                {"CT", tangent_arc},
                                {"CP", polar_circle},
                                {"CTP", polar_tangent_arc},
                                {"RND", rounding},
                                {"CHF", chamfer},
                                {"APPR", approach},
                                {"DEP", departure}});
}();

// After `/` and the block number, which become words of the line; empty if the line has nothing but
// a number.
std::optional<std::size_t> begin_of_statement(ProgramLine& line, bool& to_skip) {
  const std::string_view text = line.text;
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    at = std::min(text.find_first_not_of(" \t", at), text.size());
    return at < text.size();
  };
  const auto add_word = [&](std::size_t end, WordRole role) {
    line.words.push_back({.begin = static_cast<std::uint32_t>(at),
                          .end = static_cast<std::uint32_t>(end),
                          .role = role});
    at = end;
  };
  if (!skip_blanks()) return {};
  to_skip = text[at] == '/';
  if (to_skip) {
    add_word(at + 1, WordRole::technology);
    if (!skip_blanks()) return {};
  }
  const bool has_letter = upper(text[at]) == 'N' && at + 1 < text.size() && is_digit(text[at + 1]);
  if (!is_digit(text[at]) && !has_letter) return at;
  const std::size_t digits = at + (has_letter ? 1 : 0);
  const std::size_t end = std::min(text.find_first_not_of("0123456789", digits), text.size());
  if (end - digits < 16) line.source.number = std::stoll(std::string(text, digits, end - digits));
  add_word(end, WordRole::number);
  if (!to_skip && skip_blanks() && text[at] == '/') {
    to_skip = true;
    add_word(at + 1, WordRole::technology);
  }
  if (skip_blanks()) return at;
  line.words.clear();
  return {};
}

// Z+50 R0 FMAX M3 of older programs: a line along one axis, without L (D-115).
bool moves_along_one_axis(std::string_view statement) {
  std::size_t axes = 0;
  for (std::size_t begin = 0; begin < statement.size();) {
    const std::size_t end = std::min(statement.find(' ', begin), statement.size());
    std::string_view word = statement.substr(begin, end - begin);
    begin = end + 1;
    if (word == "R+" || word == "R-" || word == "RL" || word == "RR") return false;
    if (word.starts_with('I')) word.remove_prefix(1);
    constexpr std::string_view names = "XYZABCUVW";
    const bool is_axis = word.size() > 1 && names.find(word.front()) != std::string_view::npos &&
                         std::string_view("+-0123456789.Q").find(word[1]) != std::string_view::npos;
    if (axes == 0 && !is_axis) return false;
    axes += is_axis ? 1 : 0;
  }
  return axes == 1;
}

// `at`: where the statement begins.
bool read_statement(Reading& reading, ProgramLine& line, KlartextBlock& block, std::size_t at) {
  const std::string_view rest = line.text;
  // Some programs end lines with these characters: all text after them would be one comment.
  if (const std::size_t no_end = rest.find_first_of("\v\f"); no_end != std::string_view::npos)
    return refuse_klartext(reading, line, no_end, name_of_character(rest.substr(no_end)),
                           Code::nc_not_text);
  // Simulators write a setup sheet in parentheses before BEGIN PGM.
  const bool setup_sheet = rest[at] == '(' && reading.blocks_read == 0;
  if (rest[at] == ';' || rest[at] == '*' || setup_sheet) {
    line.words.push_back({.begin = static_cast<std::uint32_t>(at),
                          .end = static_cast<std::uint32_t>(rest.size()),
                          .role = WordRole::comment});
    line.roles = bit(WordRole::comment);
    reading.klartext_modes.after_number = false;
    return true;
  }
  const std::string statement = statement_of(rest.substr(at));
  KlartextModes& modes = reading.klartext_modes;
  const bool has_number = line.source.number != Source::no_number;
  if (modes.after_number && !has_number && is_rest_of_klartext_block(line.text)) {
    if (!modes.after_blank)
      return refuse_klartext(reading, line, at,
                             "a line without a number, the rest of the block above");
    modes.in_columns = true;
    return copy_klartext(reading, line, at, WordRole::technology);
  }
  modes.after_number = has_number;
  modes.after_blank = begins_with_word(statement, "BLK FORM");
  const auto motion = std::ranges::find_if(motions, [&](const Motion& candidate) {
    return begins_with_word(statement, candidate.name);
  });
  // C+90 alone turns an axis.
  const bool axis_alone = statement.size() > 1 && statement[0] == 'C' &&
                          (statement[1] == '+' || statement[1] == '-' || is_digit(statement[1]));
  const bool functions = statement.size() > 1 && statement[0] == 'M' &&
                         (is_digit(statement[1]) || statement[1] == ' ');
  if (begins_with_word(statement, "TOOL CALL"))
    reading.gcode.skipped.tool = block.to_skip ? line.source.line : 0;
  if (begins_with_word(statement, "TOOL DEF") && block.to_skip)
    reading.gcode.skipped.tool_data = line.source.line;
  const bool along_one_axis = !reading.contour_open() && (motion == motions.end() || axis_alone) &&
                              moves_along_one_axis(statement);
  if ((motion == motions.end() || axis_alone) && !functions && !along_one_axis)
    return read_klartext_statement(reading, line, at);
  if (along_one_axis) {
    block.statement = KlartextStatement::straight;
  } else if (!functions) {
    block.statement = motion->statement;
    block.name = motion->name;
  }
  block.begin = static_cast<std::uint32_t>(at);
  const bool has_words = read_klartext_words(reading, line, block);
  if (has_words && !block.side && (has_side(statement) || has_glued_r0(statement)))
    return refuse_klartext(reading, line, at, "RL, RR, R0 without a blank before it");
  line.sum_up_roles();
  const bool readable = has_words && check_klartext(reading, line, block) &&
                        (block.unfollowed || check_words_together(reading, line, block));
  return take_klartext(reading, line, block,
                       readable ? KlartextCheck::passed : KlartextCheck::failed);
}

}  // namespace

// Lists of older controls break a block where their screen does:
//
//     5   L   X-20.000  Y-20.000
//                         R0 F9999 M03
//
// Only the next line says where the block ends. The blank at the head of the program, which moves
// nothing, shows whether the list is such a one (D-176).
bool is_rest_of_klartext_block(std::string_view line) {
  if (line.empty() || (line.front() != ' ' && line.front() != '\t')) return false;
  const std::string statement = statement_of(line);
  const std::string_view first = std::string_view(statement).substr(0, statement.find(' '));
  constexpr auto alone = std::to_array<std::string_view>({"F", "FMAX", "R", "R0", "RL", "RR", "S"});
  if (std::ranges::find(alone, first) != alone.end()) return true;
  constexpr auto names =
      std::to_array<std::string_view>({"DR", "IPA", "IPR", "PA", "PR", "A", "B", "C", "F", "IX",
                                       "IY", "IZ",  "R",   "S",  "U",  "V", "W", "X", "Y", "Z"});
  return std::ranges::any_of(names, [&](std::string_view name) {
    return first.size() > name.size() && first.starts_with(name) &&
           std::string_view("+-0123456789.Q").find(first[name.size()]) != std::string_view::npos;
  });
}

bool begins_klartext_block(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string_view::npos) return false;
  if (is_digit(line[at]) || line[at] == ';' || line[at] == '*' || line[at] == '/') return true;
  const std::string statement = statement_of(line.substr(at));
  const bool has_number = statement.size() > 1 && is_digit(statement[1]);
  constexpr auto others =
      std::to_array<std::string_view>({"BEGIN", "BLK", "CALL", "CYCL", "END", "FN", "FUNCTION",
                                       "LBL", "PLANE", "SEL", "STOP", "TOOL", "TRANS"});
  const auto begins = [&](std::string_view word) { return begins_with_word(statement, word); };
  return ((statement[0] == 'M' || statement[0] == 'Q' || statement[0] == 'N') && has_number) ||
         std::ranges::any_of(others, begins) || std::ranges::any_of(motions, begins, &Motion::name);
}

// RL, RR, and R+ R- beside a single axis; neither RLENGTH nor the radius R+30 of CR.
std::size_t place_of_klartext_side(std::string_view block) {
  const std::string words = statement_of(block);
  const std::size_t first = words.find_first_not_of("0123456789 /");
  if (first == std::string::npos) return first;
  const bool moves = std::ranges::any_of(motions, [&](const Motion& motion) {
    return begins_with_word(std::string_view(words).substr(first), motion.name);
  });
  if (!moves) return std::string_view::npos;
  KlartextReader reader(block);
  for (KlartextWord word = reader.next(); word.kind != Kind::end && word.kind != Kind::fault;
       word = reader.next())
    if (word.name == "RL" || word.name == "RR") return word.begin;
  return std::string_view::npos;
}

bool refuse_klartext(Reading& reading, const ProgramLine& line, std::size_t begin,
                     std::string detail, Code code) {
  return reading.refuse(line, TextFault{.code = code,
                                        .begin = static_cast<std::uint32_t>(begin),
                                        .detail = std::move(detail)});
}

bool read_klartext(Reading& reading, ProgramLine& line) {
  KlartextBlock block;
  const std::optional<std::size_t> begin = begin_of_statement(line, block.to_skip);
  if (!begin) return true;
  const KlartextModes& modes = reading.klartext_modes;
  const std::uint32_t led = modes.unfollowed;
  const std::uint32_t scaling = modes.scaling;
  const double scale = modes.scale;
  const bool goes_on = read_statement(reading, line, block, *begin);
  // A mode that a skippable line sets or ends may be in force or not.
  const bool changes = modes.unfollowed != led || modes.scaling != scaling || modes.scale != scale;
  if (block.to_skip && changes) take_klartext_effects(reading, {.unsure = led | modes.unfollowed});
  return goes_on;
}

bool take_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block, KlartextCheck check) {
  if (!check_corners_at_ends(reading, line, block)) check = KlartextCheck::failed;
  if (!reading.faults.empty()) {
    if (block.side) reading.scanned_trc = *block.side != Side::off;
    if (block.is(KlartextStatement::departure)) reading.scanned_trc = false;
    // Labels after the end are not searched for further faults, unless calls of them are followed.
    reading.ended |= line.ends_program && !reading.reads_flat;
  }
  if (check == KlartextCheck::failed || !reading.faults.empty()) return false;
  line.has_words = true;
  ++reading.blocks_read;
  const bool goes_on = apply_klartext(reading, line, block);
  line.has_trc_words = line.has(WordRole::trc);
  return goes_on;
}

}  // namespace trc
