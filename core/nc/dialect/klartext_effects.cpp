#include "core/nc/dialect/klartext_effects.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_tool_words.h"
#include "core/nc/text/klartext_words.h"

namespace trc {
namespace {

// Whether `text`, after leading blanks, is 1. A text that is no number, such as a parameter,
// scales.
bool is_one(std::string_view text) {
  const std::string_view number = without_blanks_in_front(text);
  double value = 0;
  return read_klartext_number(number, value) > 0 && value == 1;
}

KlartextEffects set_or_end(std::uint32_t mode, bool sets) {
  return sets ? KlartextEffects{.sets = mode} : KlartextEffects{.clears = mode};
}

// The axes that cycle 26 scales, after its CYCL DEF 26.1: X 1.4 Y0.6 CCX+15.
KlartextEffects scaling_of_axes(std::string_view words) {
  KlartextEffects scaled;
  constexpr std::string_view axes = "XYZ";
  for (std::size_t at = 0; at < words.size(); ++at) {
    const std::size_t axis = axes.find(words[at]);
    const bool begins_word = at == 0 || words[at - 1] == ' ';
    if (axis == std::string_view::npos || !begins_word) continue;
    scaled = scaled.then(set_or_end(std::uint32_t{1} << axis, !is_one(words.substr(at + 1))));
  }
  return scaled;
}

// Behind a name such as SCL; nothing: there is none, or more than a number stands there.
std::optional<double> number_behind(std::string_view words, std::string_view name) {
  const std::size_t at = words.find(name);
  if (at == std::string_view::npos) return {};
  const std::string_view text = without_blanks_in_front(words.substr(at + name.size()));
  double value = 0;
  const std::size_t end = read_klartext_number(text, value);
  if (end == 0 || (end < text.size() && text[end] != ' ')) return {};
  return value;
}

// TOOL CALL with a tool, or with DR alone.
KlartextEffects effects_of_tool_call(std::string_view words) {
  using Kind = KlartextToolWord::Kind;
  KlartextToolReader reader(words);
  KlartextToolWord word = reader.next();
  const bool named =
      word.kind == Kind::number || word.kind == Kind::text || word.kind == Kind::parameter;
  if (named) return {.sets = KlartextMode::tool, .clears = KlartextMode::modal_cycle};
  for (; word.kind != Kind::end && word.kind != Kind::unknown; word = reader.next())
    if (word.name == "DR") return {.sets = KlartextMode::tool};
  return {};
}

// Whether the statement has M and a number: M128, M 128.
bool may_have_function(std::string_view statement) {
  for (std::size_t at = statement.find('M'); at != std::string_view::npos;
       at = statement.find('M', at + 1)) {
    const std::string_view behind = without_blanks_in_front(statement.substr(at + 1));
    if (!behind.empty() && is_digit(behind.front())) return true;
  }
  return false;
}

// The effects of the M functions in a motion or in a block of M words.
KlartextEffects effects_of_functions(std::string_view text, std::string_view statement) {
  constexpr auto without_functions =
      std::to_array<std::string_view>({"BEGIN", "END", "TOOL", "CYCL", "CALL", "SEL", "FN", "Q"});
  KlartextEffects effects;
  if (!may_have_function(statement) ||
      std::ranges::any_of(without_functions,
                          [&](std::string_view word) { return statement.starts_with(word); }))
    return effects;
  KlartextReader reader(text);
  using Kind = KlartextWord::Kind;
  for (KlartextWord word = reader.next(); word.kind != Kind::end && word.kind != Kind::fault;
       word = reader.next())
    if (word.kind == Kind::value && word.name == "M" && word.value >= 0 && word.value < 1000)
      effects = effects.then(effects_of_function(static_cast<int>(word.value)));
  return effects;
}

}  // namespace

KlartextEffects KlartextEffects::then(const KlartextEffects& next) const {
  const std::uint32_t kept = ~next.touched();
  return {.sets = (sets & kept) | next.sets,
          .clears = (clears & kept) | next.clears,
          .unsure = (unsure & kept) | next.unsure};
}

KlartextEffects KlartextEffects::perhaps() const {
  return {.unsure = sets | unsure | (clears & KlartextMode::either_way)};
}

KlartextEffects effects_of_statement(std::string_view statement) {
  constexpr std::string_view scale_axes = "CYCL DEF 26.";
  constexpr std::string_view scale = "TRANS SCALE";
  KlartextEffects effects;
  if (const std::size_t factor = statement.find(" SCL"); factor != std::string_view::npos)
    effects = set_or_end(KlartextLead::cycle, !is_one(statement.substr(factor + 4)));
  if (begins_with_word(statement, scale))
    effects = set_or_end(KlartextLead::trans,
                         !statement.ends_with("RESET") && !is_one(statement.substr(scale.size())));
  if (begins_with_word(statement, "FUNCTION TCPM")) effects = {.sets = KlartextLead::tip};
  if (begins_with_word(statement, "FUNCTION RESET TCPM")) effects = {.clears = KlartextLead::tip};
  // A row of a table of corrections, with its own DR, holds up to the next tool.
  if (begins_with_word(statement, "FUNCTION CORRDATA"))
    effects =
        set_or_end(KlartextLead::correction, statement.find("RESET") == std::string_view::npos);
  if (begins_with_word(statement, "TOOL CALL")) effects = {.clears = KlartextLead::correction};
  // CYCL DEF 26.0 only has the name.
  if (statement.starts_with(scale_axes) && !statement.starts_with("CYCL DEF 26.0"))
    effects = scaling_of_axes(statement.substr(scale_axes.size() + 1));
  return effects;
}

KlartextScale scale_of_statement(std::string_view statement) {
  std::uint32_t mode = 0;
  std::optional<double> factor;
  if (statement.starts_with("CYCL DEF 11.") || statement.starts_with("TRANS SCALE SCL")) {
    mode = statement.front() == 'C' ? KlartextLead::cycle : KlartextLead::trans;
    factor = number_behind(statement, " SCL");
  } else if (statement.starts_with("CYCL DEF 26.")) {
    constexpr std::uint32_t x_and_y = 3;
    mode = x_and_y;
    factor = number_behind(statement, " X");
    if (factor != number_behind(statement, " Y")) factor.reset();
  }
  return factor ? KlartextScale{.mode = mode, .factor = *factor} : KlartextScale{};
}

KlartextEffects effects_of_function(int m) {
  using Mode = KlartextMode;
  switch (m) {
    case 89:
    case 99:
      return set_or_end(Mode::modal_cycle, m == 89);
    case 109:
      return {.sets = Mode::adapts_feed, .clears = Mode::slows_feed};
    case 110:
      return {.sets = Mode::slows_feed, .clears = Mode::adapts_feed};
    case 111:
      return {.clears = Mode::adapts_feed | Mode::slows_feed};
    case 114:
    case 115:
      return set_or_end(KlartextLead::tip, m == 114);
    case 128:
    case 129:
      return set_or_end(KlartextLead::tip, m == 128);
    case 136:
    case 137:
      return set_or_end(Mode::feed_per_turn, m == 136);
    case 144:
    case 145:
      return set_or_end(KlartextLead::table, m == 144);
    default:
      return {};
  }
}

KlartextEffects effects_of_line(std::string_view text, std::string_view statement) {
  constexpr std::string_view tool_call = "TOOL CALL";
  if (statement.empty()) return {};
  if (begins_with_word(statement, tool_call))
    return effects_of_statement(statement).then(
        effects_of_tool_call(statement.substr(tool_call.size())));
  if (writes_radius(statement)) return {.sets = KlartextLead::tool_data};
  return effects_of_statement(statement).then(effects_of_functions(text, statement));
}

bool jumps(std::string_view statement) {
  return statement.find("GOTO") != std::string_view::npos || begins_with_word(statement, "IF");
}

// SYSWRITE ID50 NR2 IDX1 = +6 writes R of the tool table, ID950 R of the tool in the spindle; NR5
// is DR.
bool writes_radius(std::string_view statement) {
  if (statement.find("SYSWRITE") == std::string_view::npos) return false;
  const auto number_behind = [&](std::string_view word) -> std::string_view {
    const std::size_t at = statement.find(word);
    if (at == std::string_view::npos) return {};
    const std::string_view behind = without_blanks_in_front(statement.substr(at + word.size()));
    return behind.substr(0, behind.find(' '));
  };
  const std::string_view id = number_behind(" ID");
  const std::string_view nr = number_behind(" NR");
  const bool of_tools = id == "50" || id == "950" || id.starts_with('Q');
  return of_tools && (nr == "2" || nr == "5" || nr.starts_with('Q'));
}

void KlartextSection::note(const KlartextEffects& effects) {
  if (effects.touched() == 0) return;
  ++steps_;
  for (std::size_t mode = 0; mode < modes; ++mode) {
    const std::uint32_t bit = std::uint32_t{1} << mode;
    if ((effects.sets & bit) != 0) set_[mode] = steps_;
    if ((effects.clears & bit) != 0) cleared_[mode] = steps_;
    if ((effects.unsure & bit) != 0) unsure_[mode] = steps_;
  }
}

KlartextEffects KlartextSection::since(std::uint32_t steps) const {
  KlartextEffects effects;
  for (std::size_t mode = 0; mode < modes; ++mode) {
    const std::uint32_t last = std::max({set_[mode], cleared_[mode], unsure_[mode]});
    if (last <= steps) continue;
    std::uint32_t& kind = last == set_[mode]       ? effects.sets
                          : last == cleared_[mode] ? effects.clears
                                                   : effects.unsure;
    kind |= std::uint32_t{1} << mode;
  }
  return effects;
}

}  // namespace trc
