#include "core/nc/dialect/heidenhain.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_checks.h"
#include "core/nc/dialect/klartext_functions.h"
#include "core/nc/dialect/klartext_motion.h"
#include "core/nc/dialect/klartext_statements.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"

// How a block of Klartext is read. What it does: klartext_motion.cpp.

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

// Behind `/` and the number of the block, which become words of the line; nothing where no more
// stands in it than a number.
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

// X+Q1 and XQ1 as a word with the number that the program has given the parameter (D-85). A feed
// is passed on as it stands.
std::optional<KlartextWord> with_value(const KlartextWord& word, std::string_view text,
                                       const std::map<std::string, double, std::less<>>& known) {
  const std::string words = in_upper_case(text);
  const std::size_t parameter = words.rfind('Q');
  if (parameter == std::string::npos || words.front() == 'F') return {};
  const auto found = known.find(std::string_view(words).substr(parameter));
  if (found == known.end()) return {};
  std::string_view name = without_blanks_behind(std::string_view(words).substr(0, parameter));
  if (name.ends_with('+') || name.ends_with('-')) name.remove_suffix(1);
  name = without_blanks_behind(name);
  if (name.empty() || !std::ranges::all_of(name, is_letter)) return {};
  KlartextWord value = word;
  value.kind = Kind::value;
  value.name = name;
  value.value = word.negative ? -found->second : found->second;
  return value;
}

// Of an M function with words of its own, such as F of M103 and MAX of M140: not the side of TRC,
// no place unless it has `limits` (M118), no L that begins a statement.
bool may_be_of_function(const KlartextWord& word, std::string_view text, bool limits) {
  if (word.kind == Kind::name) return word.name != "RL" && word.name != "RR" && word.name != "L";
  std::string_view axis = word.name;
  if (axis.size() == 2 && axis[0] == 'I') axis.remove_prefix(1);
  const bool is_place = axis.size() == 1 && axis[0] >= 'X' && axis[0] <= 'Z';
  return in_upper_case(text) != "R0" && (limits || !is_place);
}

bool read_klartext_feed(Reading& reading, const KlartextWord& word, ProgramLine& line,
                        KlartextBlock& block) {
  const std::string text(line.word({.begin = word.begin, .end = word.end}));
  if (word.name != "F") {
    if (word.name != "FU" && word.name != "FZ" && word.name != "FT" && word.name != "FMAXT")
      return refuse_klartext(reading, line, word.begin, text);
    const bool of_a_motion = !block.is_corner();
    if (of_a_motion && (word.name == "FU" || word.name == "FZ")) {
      if (block.feed || block.open_feed)
        return refuse_klartext(reading, line, word.begin, text, Code::nc_word_twice);
      block.open_feed = word.begin;
      add(line, word, WordRole::feed);
      return true;
    }
    if (reading.trc_active())
      return refuse_klartext(reading, line, word.begin,
                             text + ", no feed per minute, while TRC is active");
    block.feed_per_turn = true;
    add(line, word, WordRole::technology);
    return true;
  }
  if (block.feed || block.open_feed || block.rapid)
    return refuse_klartext(reading, line, word.begin, text, Code::nc_word_twice);
  block.feed = {.value = word.value, .begin = word.begin};
  const bool of_the_corner = block.is_corner();
  add(line, word,
      reading.klartext_modes.feed_per_turn      ? WordRole::technology
      : of_the_corner && reading.contour_open() ? WordRole::trc
                                                : WordRole::feed);
  if (reading.klartext_modes.feed_per_turn) block.feed.reset();
  return true;
}

bool read_klartext_axis(Reading& reading, const KlartextWord& word, ProgramLine& line,
                        KlartextBlock& block) {
  const bool increment = word.name.size() == 2 && word.name[0] == 'I';
  const char letter = word.name.back();
  const std::string text(line.word({.begin = word.begin, .end = word.end}));
  if (word.name.size() != (increment ? 2U : 1U))
    return refuse_klartext(reading, line, word.begin, text);
  const int axis = reading.axis_of_letter[static_cast<std::size_t>(letter - 'A')];
  if (axis < 0) return refuse_klartext(reading, line, word.begin, text, Code::nc_axis_unknown);
  const auto index = static_cast<std::size_t>(axis);
  const auto twice = [&] {
    return refuse_klartext(reading, line, word.begin, text, Code::nc_word_twice);
  };
  if (index < 3) {
    if (block.end[index]) return twice();
    block.end[index] = {.value = word.value, .increment = increment, .begin = word.begin};
  } else {
    if (block.tracking.empty()) block.tracking.resize(reading.state.setup().tracking_axes.size());
    if (block.tracking[index - 3]) return twice();
    block.tracking[index - 3] = word.value;
    if (increment) block.tracking_increments |= std::uint64_t{1} << (index - 3);
  }
  add(line, word, WordRole::coordinate);
  return true;
}

bool read_klartext_value(Reading& reading, const KlartextWord& word, ProgramLine& line,
                         KlartextBlock& block) {
  const std::string& name = word.name;
  const auto take = [&](std::optional<KlartextBlock::Value>& value, bool increment = false) {
    if (value)
      return refuse_klartext(reading, line, word.begin,
                             std::string(line.word({.begin = word.begin, .end = word.end})),
                             Code::nc_word_twice);
    value = {.value = word.value, .increment = increment, .begin = word.begin};
    add(line, word, WordRole::coordinate);
    return true;
  };
  if (name == "R" && word.value == 0 && line.text[word.end - 1] == '0' &&
      line.text.find_first_of("+-.", word.begin) >= word.end) {
    if (block.side)
      return refuse_klartext(reading, line, word.begin, "R0", Code::compensation_side_twice);
    block.side = Side::off;
    block.side_begin = word.begin;
    // Where there is nothing to end, R0 is a word of the program like any other.
    add(line, word, reading.contour_open() ? WordRole::trc : WordRole::mode);
    return true;
  }
  if (name == "R" || (name == "RND" && block.is(KlartextStatement::rounding)))
    return take(block.radius);
  if (name == "LEN" || (name == "CHF" && block.is(KlartextStatement::chamfer)))
    return take(block.length);
  if (name == "CCA") return take(block.center_angle);
  if (name == "PR" || name == "IPR") return take(block.polar_radius, name == "IPR");
  if (name == "PA" || name == "IPA") return take(block.polar_angle, name == "IPA");
  if (name.starts_with('F')) return read_klartext_feed(reading, word, line, block);
  if (name == "LA" && block.masks) {
    block.masks = word.value > 0;
    add(line, word, WordRole::trc);
    return true;
  }
  return read_klartext_axis(reading, word, line, block);
}

// XQ1, X+Q1, FQ1. A feed moves nothing, whatever it is.
bool read_klartext_parameter(Reading& reading, const KlartextWord& word, ProgramLine& line,
                             KlartextBlock& block) {
  const std::string text(line.word({.begin = word.begin, .end = word.end}));
  std::string_view name = word.name;
  if (const std::size_t parameter = name.find('Q', 1); parameter != std::string_view::npos)
    name = name.substr(0, parameter);
  const bool of_the_corner = block.is_corner();
  if (name == "F" && !(of_the_corner && reading.contour_open())) {
    if (block.feed || block.open_feed)
      return refuse_klartext(reading, line, word.begin, text, Code::nc_word_twice);
    block.open_feed = word.begin;
    add(line, word, WordRole::feed);
    return true;
  }
  constexpr std::string_view main_axes = "XYZ";
  const std::size_t axis = name.size() == 1 ? main_axes.find(name[0]) : std::string_view::npos;
  if (axis < main_axes.size())
    block.by_parameter.at(axis) = true;
  else
    block.other_parameter = true;
  add(line, word, WordRole::coordinate);
  block.unfollowed = word.begin;
  block.unfollowed_why = text + ", a variable";
  return true;
}

// LT, LN, CT or LCT behind APPR and DEP, with P where the place is polar.
bool take_form_of_lead(std::string_view name, KlartextBlock& block) {
  constexpr auto forms =
      std::to_array<std::pair<std::string_view, Lead::Form>>({{"LT", Lead::Form::tangent},
                                                              {"LN", Lead::Form::normal},
                                                              {"CT", Lead::Form::arc},
                                                              {"LCT", Lead::Form::arc_and_line}});
  const bool polar = name.starts_with('P');
  const auto form = std::ranges::find(forms, name.substr(polar ? 1 : 0),
                                      [](const auto& known) { return known.first; });
  if (form == forms.end()) return false;
  block.lead.form = form->second;
  block.polar_lead = polar;
  block.form = form->first;
  return true;
}

bool read_klartext_name(Reading& reading, const KlartextWord& word, ProgramLine& line,
                        KlartextBlock& block) {
  const std::string& name = word.name;
  // FMAX or F MAX.
  const auto two_words = [&](WordRole role) {
    if (block.feed) {
      if (line.word(line.words.back()).size() != 1)
        return refuse_klartext(
            reading, line, word.begin, name,
            block.feed->begin == ~0U ? Code::nc_unsupported : Code::nc_word_twice);
      block.feed.reset();
      line.words.back().end = word.end;
      line.words.back().role = role;
    } else {
      add(line, word, role);
    }
    return true;
  };
  if (name == "RL" || name == "RR") {
    if (block.side)
      return refuse_klartext(reading, line, word.begin, name, Code::compensation_side_twice);
    block.side = name == "RL" ? Side::left : Side::right;
    block.side_begin = word.begin;
    add(line, word, WordRole::trc);
    return true;
  }
  if (name == "FMAX" || (name == "MAX" && block.feed && block.feed->begin == ~0U)) {
    block.rapid = true;
    return two_words(WordRole::motion);
  }
  // R of older controls: the compensation stays as it is.
  if (name == "R" && block.is(KlartextStatement::straight)) {
    add(line, word, reading.contour_open() ? WordRole::trc : WordRole::mode);
    return true;
  }
  if (name == "FAUTO" || (name == "AUTO" && block.feed && block.feed->begin == ~0U)) {
    block.called_feed = true;
    return two_words(WordRole::feed);
  }
  if (name == "F" && !block.feed) {  // F MAX, F AUTO
    block.feed = {.begin = ~0U};
    add(line, word, WordRole::motion);
    return true;
  }
  if (block.is_lead() && !line.words.empty() && line.words.back().role == WordRole::motion &&
      take_form_of_lead(name, block)) {
    add(line, word, WordRole::coordinate);
    return true;
  }
  return refuse_klartext(reading, line, word.begin, name);
}

bool read_klartext_word(Reading& reading, const KlartextWord& word, ProgramLine& line,
                        KlartextBlock& block) {
  const std::string text(line.word({.begin = word.begin, .end = word.end}));
  if (word.name == "M" && word.kind == Kind::value)
    return read_klartext_function(reading, word, line, block);
  if (block.ignores_words && may_be_of_function(word, text, block.ignores_places)) {
    add(line, word, WordRole::technology);
    return true;
  }
  switch (word.kind) {
    case Kind::variable:
      if (const auto known = with_value(word, text, reading.klartext_modes.parameters))
        return read_klartext_value(reading, *known, line, block);
      return read_klartext_parameter(reading, word, line, block);
    case Kind::name:
      return read_klartext_name(reading, word, line, block);
    case Kind::sign:
      if (word.name == "DR") {
        if (block.clockwise)
          return refuse_klartext(reading, line, word.begin, text, Code::nc_word_twice);
        block.clockwise = word.negative;
        add(line, word, WordRole::coordinate);
        return true;
      }
      return refuse_klartext(reading, line, word.begin,
                             text + (word.name == "R" ? ", a compensation along one axis" : ""));
    case Kind::value:
      return read_klartext_value(reading, word, line, block);
    default:
      return refuse_klartext(reading, line, word.begin, text, Code::nc_syntax);
  }
}

// Behind the number; all words are read, also behind one that is refused.
bool read_klartext_words(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  KlartextReader reader(std::string_view(line.text).substr(block.begin));
  std::size_t faults = 0;
  bool first = true;
  for (;;) {
    KlartextWord word = reader.next();
    word.begin += block.begin;
    word.end += block.begin;
    if (word.kind == Kind::end) return faults == 0;
    if (word.kind == Kind::fault) {
      TextFault fault = reader.fault();
      fault.begin += block.begin;
      reading.refuse(line, fault);
      return false;
    }
    if (word.kind == Kind::comment) {
      add(line, word, WordRole::comment);
      continue;
    }
    const bool names_statement = std::exchange(first, false) && !block.name.empty();
    if (names_statement && word.kind == Kind::name) {
      add(line, word, WordRole::motion);
      continue;
    }
    faults += read_klartext_word(reading, word, line, block) ? 0 : 1;
    if (reading.diagnostics.stopped() || faults >= reading.limits.most_faults) return false;
  }
}

// From where it begins.
bool read_statement(Reading& reading, ProgramLine& line, KlartextBlock& block, std::size_t at) {
  const std::string_view rest = line.text;
  // Some end their lines with one: all behind it would be one comment.
  if (const std::size_t no_end = rest.find_first_of("\v\f"); no_end != std::string_view::npos)
    return refuse_klartext(reading, line, no_end, name_of_character(rest.substr(no_end)),
                           Code::nc_not_text);
  // Simulators write a setup sheet in parentheses in front of BEGIN PGM.
  const bool setup_sheet = rest[at] == '(' && reading.blocks_read == 0;
  if (rest[at] == ';' || rest[at] == '*' || setup_sheet) {
    line.words.push_back({.begin = static_cast<std::uint32_t>(at),
                          .end = static_cast<std::uint32_t>(rest.size()),
                          .role = WordRole::comment});
    line.roles = bit(WordRole::comment);
    return true;
  }
  const std::string statement = statement_of(rest.substr(at));
  const auto motion = std::ranges::find_if(motions, [&](const Motion& candidate) {
    return begins_with_word(statement, candidate.name);
  });
  // C+90 alone turns an axis.
  const bool axis_alone = statement.size() > 1 && statement[0] == 'C' &&
                          (statement[1] == '+' || statement[1] == '-' || is_digit(statement[1]));
  const bool functions = statement.size() > 1 && statement[0] == 'M' &&
                         (is_digit(statement[1]) || statement[1] == ' ');
  if (begins_with_word(statement, "TOOL CALL"))
    reading.code_modes.skipped_tool = block.to_skip ? line.source.line : 0;
  if (begins_with_word(statement, "TOOL DEF") && block.to_skip)
    reading.code_modes.skipped_tool_data = line.source.line;
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
    return refuse_klartext(reading, line, at, "RL, RR, R0 without a blank in front");
  line.sum_up_roles();
  const bool readable = has_words && check_klartext(reading, line, block) &&
                        (block.unfollowed || check_words_together(reading, line, block));
  return take_klartext(reading, line, block, readable);
}

}  // namespace

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

// RL, RR, and R+ R- beside a single axis: not RLENGTH, nor the radius R+30 of CR.
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
  const std::uint32_t led = reading.klartext_modes.unfollowed;
  const bool goes_on = read_statement(reading, line, block, *begin);
  // What a line that may be skipped ends may still hold.
  if (block.to_skip) reading.klartext_modes.unfollowed |= led;
  return goes_on;
}

bool take_klartext(Reading& reading, ProgramLine& line, KlartextBlock& block, bool readable) {
  if (!reading.faults.empty()) {
    if (block.side) reading.scanned_trc = *block.side != Side::off;
    if (block.is(KlartextStatement::departure)) reading.scanned_trc = false;
  }
  if (!readable || !reading.faults.empty()) return false;
  line.has_words = true;
  ++reading.blocks_read;
  const bool goes_on = apply_klartext(reading, line, block);
  line.has_trc_words = line.has(WordRole::trc);
  return goes_on;
}

}  // namespace trc
