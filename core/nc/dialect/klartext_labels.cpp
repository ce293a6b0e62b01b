#include "core/nc/dialect/klartext_labels.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_statements.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"

// Labels of Klartext: where they begin and end, which statements call them, and which contours and
// tools depend on such calls.

namespace trc {
namespace {

// Notes the line that calls the section of a label, and the line that makes it the contour of
// cycles (D-132).
void enter_section(Reading& reading, const std::string& label) {
  const bool ends = label == "0";
  if (ends)
    reading.klartext_modes.open_labels.clear();
  else
    reading.klartext_modes.open_labels.push_back(label);
  if (const auto call = reading.klartext_modes.calls.find(label);
      ends || call != reading.klartext_modes.calls.end())
    reading.klartext_modes.called_section = ends ? 0 : call->second;
  if (const auto cycle = reading.klartext_modes.labels_of_cycles.find(label);
      ends || cycle != reading.klartext_modes.labels_of_cycles.end())
    reading.klartext_modes.cycle_section = ends ? 0 : cycle->second;
}

// Applies the effects of a label as if its lines were in place of its call (D-160).
bool take_effects_of_call(Reading& reading, const ProgramLine& line,
                          const KlartextEffects& effects) {
  using Mode = KlartextMode;
  KlartextModes& modes = reading.klartext_modes;
  take_klartext_effects(reading, effects);
  if (((effects.sets | effects.unsure) & Mode::tool) != 0) modes.tool_of_label = line.source.line;
  if ((effects.unsure & Mode::either_way) != 0) modes.unfollowed_call = line.source.line;
  constexpr std::uint32_t adapts = Mode::adapts_feed | Mode::slows_feed;
  if ((effects.touched() & adapts) == 0) return true;
  return reading.state.set_feed_adaptation(
      (effects.sets & Mode::adapts_feed) != 0  ? FeedAdaptation::on
      : (effects.sets & Mode::slows_feed) != 0 ? FeedAdaptation::inside
                                               : FeedAdaptation::off,
      line.source);
}

// CALL LBL 1 runs the label to its LBL 0; CALL LBL 1 REP 3 runs all lines from the label to here.
// Repeated lines are not rewritten, so they must not contain a contour (D-133).
bool call_label(Reading& reading, ProgramLine& line, std::size_t begin,
                std::string_view statement) {
  const std::string label = label_of(line.text, begin, statement);
  if (reading.trc_active())
    return refuse_klartext(reading, line, begin, "CALL LBL while TRC is active");
  const auto known = reading.klartext_modes.labels.find(label);
  const bool to_here = statement.find(" REP") != std::string_view::npos;
  if (known != reading.klartext_modes.labels.end() &&
      (to_here ? known->second.before != reading.klartext_modes.contours
               : known->second.has_contour(reading.klartext_modes.contours)))
    return refuse_klartext(reading, line, begin, "CALL LBL, which repeats a compensated contour");
  const bool stands_behind = known == reading.klartext_modes.labels.end();
  if (stands_behind) reading.klartext_modes.calls.try_emplace(label, line.source.line);
  // The lines that REP repeats have been read already.
  if (!to_here) {
    const KlartextEffects of_label =
        stands_behind ? KlartextEffects{.unsure = KlartextMode::anything} : known->second.leaves;
    if (!take_effects_of_call(reading, line, reading.call_leaves.value_or(of_label))) return false;
  }
  hand_on_klartext_pole(reading, line);
  forget_klartext_position(reading, line);
  lose_klartext_pole(reading, line);
  reading.klartext_modes.polar_radius.reset();
  line.feed_it_takes = std::exchange(reading.feed, 0);
  reading.klartext_modes.feed_of_control = false;
  return copy_klartext(reading, line, begin, WordRole::technology);
}

}  // namespace

std::string label_of(std::string_view text, std::size_t begin, std::string_view statement) {
  const std::string_view name =
      without_blanks_in_front(statement.substr(statement.starts_with("CALL") ? 8 : 3));
  std::string label(name.substr(0, name.find(' ')));
  if (label.starts_with('"')) {  // the statement hides the letters of a quoted label
    const std::size_t open = text.find('"', begin);
    label = text.substr(open, text.find('"', open + 1) - open);
  }
  return label;
}

bool enter_label_behind_end(Reading& reading, const ProgramLine& line) {
  const std::size_t begin = line.text.find_first_not_of("0123456789 \tNn/");
  if (begin == std::string::npos) return true;
  const std::string statement = statement_of(std::string_view(line.text).substr(begin));
  if (begins_with_word(statement, "LBL"))
    enter_section(reading, label_of(line.text, begin, statement));
  return true;
}

bool read_label(Reading& reading, ProgramLine& line, std::size_t begin,
                std::string_view statement) {
  // A call from elsewhere finds other values.
  reading.klartext_modes.parameters.clear();
  if (statement.starts_with("CALL")) return call_label(reading, line, begin, statement);
  const std::string label = label_of(line.text, begin, statement);
  const std::uint64_t contours = reading.klartext_modes.contours;
  if (label == "0") {
    for (const std::string& name : reading.klartext_modes.open_labels) {
      ContoursOfLabel& closed = reading.klartext_modes.labels[name];
      closed.behind = contours;
      closed.leaves = reading.klartext_modes.section.since(closed.steps);
    }
  } else {
    // An open contour continues after the label.
    reading.klartext_modes.labels[label] = {
        .before = reading.trc_active() ? contours - 1 : contours,
        .steps = reading.klartext_modes.section.steps()};
  }
  enter_section(reading, label);
  if (reading.klartext_modes.called_section != 0 && reading.trc_active())
    return refuse_klartext(reading, line, begin, "LBL, which is called, while TRC is active");
  if (label != "0") hand_on_klartext_pole(reading, line);
  if (reading.klartext_modes.jump != 0) forget_klartext_position(reading, line);
  return copy_klartext(reading, line, begin, WordRole::technology);
}

bool copy_jump(Reading& reading, ProgramLine& line, std::size_t begin, std::string_view statement) {
  if (reading.klartext_modes.contours > 0) {
    const std::size_t behind_name = statement.find_first_of(": ", statement.find(' ') + 1);
    return refuse_klartext(reading, line, begin,
                           std::string(statement.substr(0, behind_name)) + ", a jump to a label");
  }
  if (reading.klartext_modes.jump == 0) reading.klartext_modes.jump = line.source.line;
  reading.klartext_modes.parameters.clear();
  reading.klartext_modes.pole.reset();
  reading.klartext_modes.polar_radius.reset();
  forget_klartext_position(reading, line);
  return copy_klartext(reading, line, begin, WordRole::technology);
}

bool take_labels_of_cycle(Reading& reading, const ProgramLine& line, std::size_t begin,
                          std::string_view statement) {
  const bool by_cycle = statement.starts_with("CYCL DEF 14.");
  if (!by_cycle && !statement.starts_with("CONTOUR DEF")) return true;
  const std::string_view word = by_cycle ? "LABEL" : " LBL";
  std::size_t at = statement.find(word);
  while (at != std::string_view::npos) {
    at += word.size();
    // Numbers and their separators; a cycle may have several.
    for (;;) {
      at = std::min(statement.find_first_not_of(" /,=", at), statement.size());
      const std::size_t end =
          std::min(statement.find_first_not_of("0123456789", at), statement.size());
      if (end == at) break;
      const std::string label(statement.substr(at, end - at));
      const auto known = reading.klartext_modes.labels.find(label);
      if (known != reading.klartext_modes.labels.end() &&
          known->second.has_contour(reading.klartext_modes.contours))
        return refuse_klartext(
            reading, line, begin,
            "a cycle with the contour of LBL " + label + ", which is compensated");
      reading.klartext_modes.labels_of_cycles.try_emplace(label, line.source.line);
      at = end;
    }
    at = statement.find(word, at);
  }
  return true;
}

}  // namespace trc
