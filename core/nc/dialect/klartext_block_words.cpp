#include "core/nc/dialect/klartext_block_words.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_functions.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"

// The meaning of each word of a block of Klartext.

namespace trc {
namespace {

using Kind = KlartextWord::Kind;

// X+Q1 and XQ1 as a word with the number that the program has assigned to the parameter (D-85). A
// feed is passed on unchanged.
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

// Whether the word may belong to an M function with words of its own, such as F of M103 and MAX of
// M140: not the side of TRC, a position only with `limits` (M118), no L that begins a statement.
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
  // The feed of the contour would not come back after the corner.
  if (of_the_corner && reading.klartext_modes.feed_per_turn && reading.contour_open())
    return refuse_klartext(reading, line, word.begin,
                           text + ", no feed per minute, while TRC is active");
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
      line.text.find_first_of("+-.,", word.begin) >= word.end) {
    if (block.side)
      return refuse_klartext(reading, line, word.begin, "R0", Code::compensation_side_twice);
    block.side = Side::off;
    block.side_begin = word.begin;
    // An R0 that ends nothing is an ordinary word of the program.
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

// XQ1, X+Q1, FQ1. A feed moves nothing, whatever its value.
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
  block.unfollowed = {.why = KlartextObstacle::Why::variable, .begin = word.begin, .end = word.end};
  return true;
}

// LT, LN, CT or LCT after APPR and DEP, with a P if the end is polar.
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
      if (in_upper_case(line.word(line.words.back())) != "F")
        return refuse_klartext(
            reading, line, word.begin, name,
            block.feed_lacks_number ? Code::nc_unsupported : Code::nc_word_twice);
      block.feed.reset();
      block.feed_lacks_number = false;
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
  if (name == "FMAX" || (name == "MAX" && block.feed_lacks_number)) {
    block.rapid = true;
    return two_words(WordRole::motion);
  }
  // M of older controls at the end of the block: no function.
  const std::string_view behind =
      without_blanks_in_front(std::string_view(line.text).substr(word.end));
  if (name == "M" && (behind.empty() || behind.front() == ';')) {
    add(line, word, WordRole::technology);
    return true;
  }
  // R of older controls keeps the compensation in force.
  if (name == "R" && block.is_motion()) {
    add(line, word, reading.contour_open() ? WordRole::trc : WordRole::mode);
    return true;
  }
  if (name == "FAUTO" || (name == "AUTO" && block.feed_lacks_number)) {
    block.called_feed = true;
    return two_words(WordRole::feed);
  }
  if (name == "F" && !block.feed) {  // F MAX, F AUTO, or F of older controls: the feed in force
    block.feed = {.begin = word.begin};
    block.feed_lacks_number = true;
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

}  // namespace

bool read_klartext_words(Reading& reading, ProgramLine& line, KlartextBlock& block) {
  KlartextReader reader(std::string_view(line.text).substr(block.begin));
  std::size_t faults = 0;
  bool first = true;
  for (;;) {
    KlartextWord word = reader.next();
    word.begin += block.begin;
    word.end += block.begin;
    if (word.kind == Kind::end) {
      if (block.feed_lacks_number) block.feed.reset();
      return faults == 0;
    }
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

}  // namespace trc
