#include "core/nc/convert/plain_words.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/nc/convert/converted_comments.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_tool_words.h"
#include "core/nc/text/words.h"

namespace trc {
namespace {

// A letter and a whole number; -1: anything else.
std::int64_t whole_behind(std::string_view word, char letter) {
  if (word.size() < 2 || word.size() > 10 || word[0] != letter) return -1;
  std::int64_t number = 0;
  for (const char digit : word.substr(1)) {
    if (digit < '0' || digit > '9') return -1;
    number = 10 * number + (digit - '0');
  }
  return number;
}

// Words of SINUMERIK whose effect is already in the compensated path.
bool says_how_trc_goes(std::string_view word) {
  constexpr auto words = std::to_array<std::string_view>(
      {"NORM", "KONT", "CFC", "CFTCP", "CFIN", "CDON", "CDOF", "CDOF2", "G450", "G451"});
  return std::ranges::find(words, word) != words.end();
}

// M25 of a block of Klartext says something alone; L, MB and X+5 of a copied one do not.
bool belongs_to_others(const WordRange& range, std::string_view word) {
  return range.role == WordRole::technology && whole_behind(word, 'M') < 0 &&
         !word.starts_with("TOOLCALL");
}

// Of a block of Klartext, without its comment.
std::string_view statement_within(const ProgramLine& line) {
  auto begin = static_cast<std::uint32_t>(line.text.size());
  std::uint32_t end = 0;
  for (const WordRange& word : line.words) {
    if (word.role == WordRole::comment || word.role == WordRole::number) continue;
    begin = std::min(begin, word.begin);
    end = std::max(end, word.end);
  }
  return std::string_view(line.text).substr(begin, end - begin);
}

// The number of an S word, without sign.
bool is_speed(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace

bool PlainWordsReader::fail(const ProgramLine& line, std::string word) {
  constexpr std::size_t most_faults = 50;
  const bool known =
      std::ranges::find(faults_, word, &ConvertedProgram::Fault::word) != faults_.end();
  if (!known && faults_.size() < most_faults)
    faults_.push_back({.word = std::move(word), .line = line.source.line});
  return false;
}

void PlainWordsReader::look_for_tool_changes(const std::vector<LinePointer>& lines) {
  const auto changes_tool = [](const LinePointer& line) {
    return std::ranges::any_of(line->words, [&](const WordRange& word) {
      return whole_behind(in_capitals(line->word(word)), 'M') == 6;
    });
  };
  // T of LINUXCNC only prepares a tool, even if nothing loads it.
  changes_by_t_ = from_.name != DialectName::linuxcnc && std::ranges::none_of(lines, changes_tool);
}

bool PlainWordsReader::read_mode(const ProgramLine& line, std::string_view given,
                                 PlainWords& words) {
  const std::string word = in_capitals(given);
  // The output has absolute coordinates in mm, whatever the program used.
  constexpr auto resolved =
      std::to_array<std::string_view>({"G90", "G91", "G20", "G21", "G70", "G71", "G700", "G710",
                                       "G40", "R0", "G161", "G162", "G90.1", "G91.1"});
  if (word.starts_with("BEGINPGM") || std::ranges::find(resolved, word) != resolved.end())
    return true;
  for (const Plane plane : {Plane::xy, Plane::zx, Plane::yz}) {
    if (word != name_of(plane)) continue;
    if (to_klartext_ && plane != Plane::xy)
      return fail(line, std::string(given).append(plane_of_klartext));
    words.plane = plane;
    return true;
  }
  return fail(line, std::string(given));
}

// TOOL CALL 5 Z S900 F120 DR+0.1: DR is compensated already; a length would be lost.
bool PlainWordsReader::read_tool_call(const ProgramLine& line, std::string_view given,
                                      PlainWords& words) {
  const std::string statement = statement_of(given);
  KlartextToolReader reader(
      std::string_view(statement).substr(std::string_view("TOOL CALL").size()));
  bool first = true;
  for (KlartextToolWord word = reader.next(); word.kind != KlartextToolWord::Kind::end;
       word = reader.next()) {
    // The statement has no names, only the line does.
    if (word.kind == KlartextToolWord::Kind::text) {
      const std::size_t name = given.find('"');
      const std::size_t end = given.find('"', name + 1);
      return fail(line, std::string(given.substr(name, end - name + 1)) + " of TOOL CALL");
    }
    const bool is_tool = std::exchange(first, false) && word.kind == KlartextToolWord::Kind::number;
    const bool has_number = word.has == KlartextToolWord::Value::number;
    const std::string text = in_capitals(word.text);
    if (is_tool && is_whole(word.value)) {
      words.tool = static_cast<std::int64_t>(word.value);
      words.loads_tool = true;
    } else if (word.name == "S" && has_number && is_speed(std::string_view(text).substr(1))) {
      words.speed = text.substr(1);
    } else if (word.name == "M" && has_number) {
      if (!read_technology(line, text, words)) return false;
    } else if (!(word.name == "Z" || word.name.starts_with("DR") ||
                 ((word.name == "F" || (word.name == "DL" && word.value == 0)) && has_number))) {
      return fail(line, text + " of TOOL CALL");
    }
  }
  return !first || fail(line, "TOOL CALL without a tool");
}

// G43 H2, G49, D2 of ISG and D1 of SINUMERIK: whether the word selects a length.
bool PlainWordsReader::read_length(std::string_view word, PlainWords& words) const {
  // Each SINUMERIK edge has its own length, and D1 needs a tool. D of the other dialects gives the
  // radius, which is compensated already.
  if (const std::int64_t edge = whole_behind(word, 'D');
      edge == 1 || (edge > 1 && from_.name != DialectName::sinumerik)) {
    words.names_edge |= from_.name == DialectName::sinumerik;
    if (from_.name == DialectName::isg) words.length = edge;
    return true;
  }
  if (from_.name != DialectName::fanuc && from_.name != DialectName::linuxcnc) return false;
  words.begins_length |= word == "G43";
  words.ends_length |= word == "G49";
  const std::int64_t offset = whole_behind(word, 'H');
  if (offset >= 0) words.length = offset;
  return word == "G43" || word == "G49" || offset >= 0;
}

bool PlainWordsReader::read_technology(const ProgramLine& line, std::string_view given,
                                       PlainWords& words) {
  const std::string word = in_capitals(given);
  if (word[0] == '/' && setup_.block_skip == BlockSkip::execute) return true;
  if (word.starts_with("TOOLCALL")) return read_tool_call(line, given, words);
  if (word.starts_with("BLKFORM")) {
    words.comment = given;
    return true;
  }
  if (word[0] == 'S' && is_speed(std::string_view(word).substr(1))) {
    words.speed = word.substr(1);
    return true;
  }
  if (const std::int64_t tool = whole_behind(word, 'T'); tool >= 0) {
    if (words.next_tool) return fail(line, word + ", a third tool of its line");
    (words.tool ? words.next_tool : words.tool) = tool;
    words.loads_tool |= changes_by_t_;
    return true;
  }
  if (read_length(word, words)) return true;
  const std::int64_t m = whole_behind(word, 'M');
  if (m == 6) {
    words.loads_tool = true;
    return true;
  }
  // M13 and M14 are M3 and M4 with M8 on HEIDENHAIN controls; elsewhere they belong to the machine.
  if (from_.name == DialectName::heidenhain && (m == 13 || m == 14)) {
    words.functions.push_back(m == 13 ? "M3" : "M4");
    words.functions.push_back("M8");
    return true;
  }
  if ((m >= 0 && m <= 9) || m == 30) {
    words.functions.push_back("M" + std::to_string(m));
    words.ends_program |= m == 2 || m == 30;
    return true;
  }
  // A function that is in force initially.
  double number = 0;
  bool whole = false;
  if (word[0] == 'G' && read_number(std::string_view(word).substr(1), number, whole) > 0)
    if (const GFunction* function = from_.function(number);
        function != nullptr && function->initial && function->group != GGroup::zero_shift)
      return true;
  return fail(line, std::string(given));
}

bool PlainWordsReader::read(const ProgramLine& line, PlainWords& words) {
  const auto has = [&](char first, std::string_view whole = {}) {
    return std::ranges::any_of(line.words, [&](const WordRange& range) {
      const std::string_view word = line.word(range);
      return range.role == WordRole::technology && upper(word[0]) == first &&
             (whole.empty() || in_capitals(word) == whole);
    });
  };
  // The setup leaves out lines with `/`. This one only has stops and coolant after its `/`.
  if (setup_.block_skip == BlockSkip::leave_out && has('/')) return true;
  // The speed limit would become the speed.
  if (from_.name == DialectName::fanuc && has('S') && has('G', "G50"))
    return fail(line, "G50 with S, a limit of the speed");
  bool said = true;
  bool refused_whole = false;
  const std::size_t faults_before = faults_.size();
  for (const WordRange& range : line.words) {
    if (read_word(line, range, words)) continue;
    said = false;
    refused_whole |= from_.name == DialectName::heidenhain &&
                     belongs_to_others(range, in_capitals(line.word(range)));
  }
  if (refused_whole) {
    faults_.resize(faults_before);
    return fail(line, std::string(statement_within(line)));
  }
  const bool is_alone = words.length && !words.begins_length && from_.name != DialectName::isg;
  return is_alone ? fail(line, "H" + std::to_string(*words.length)) : said;
}

bool PlainWordsReader::read_word(const ProgramLine& line, const WordRange& range,
                                 PlainWords& words) {
  const std::string_view word = line.word(range);
  if (from_.name == DialectName::sinumerik && says_how_trc_goes(in_capitals(word))) return true;
  switch (range.role) {
    case WordRole::comment: {
      std::string_view text = word.substr(1);
      if (word[0] == '(' && text.ends_with(')')) text.remove_suffix(1);
      // The output has no place for the program number.
      if (word[0] != '(' && word[0] != ';' && word[0] != '*') return true;
      words.comment += words.comment.empty() ? "" : " ";
      words.comment += without_blanks_in_front(without_blanks_behind(text));
      return true;
    }
    case WordRole::mode:
      // Nothing jumps to this label.
      return word.ends_with(':') || read_mode(line, word, words);
    case WordRole::technology:
    case WordRole::stop:
      // The centres of the arcs about a pole are in their own blocks.
      if (line.klartext && line.klartext->sets_pole) return true;
      return in_capitals(word).starts_with("ENDPGM") || read_technology(line, word, words);
    case WordRole::trc:
      return fail(line, std::string(word));
    case WordRole::coordinate:
      // X1=5: the other control may call this axis by another name.
      if (const std::string_view name = long_name_of(line, range);
          std::ranges::any_of(setup_.tracking_axes, [name](const std::string& axis) {
            return axis.size() > 1 && same_name(axis, name);
          }))
        return fail(line, std::string(word));
      return !says_way_round(line, range) || fail(line, std::string(word) + ", a way round");
    case WordRole::feed:
      // FZ0.1, FQ1: the previous feed would stay in force.
      return line.feed > 0 || fail(line, std::string(word));
    default:
      return true;
  }
}

}  // namespace trc
