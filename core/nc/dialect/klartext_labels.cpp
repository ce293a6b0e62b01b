#include <algorithm>
#include <string>
#include <string_view>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"

// Labels of Klartext: where they begin and end, what calls them, and which contours and tools hang
// on such calls.

namespace trc {

std::string label_of(std::string_view text, std::size_t begin, std::string_view statement) {
  const std::string_view name =
      without_blanks_in_front(statement.substr(statement.starts_with("CALL") ? 8 : 3));
  std::string label(name.substr(0, name.find(' ')));
  if (label.starts_with('"')) {  // its letters are hidden there
    const std::size_t open = text.find('"', begin);
    label = text.substr(open, text.find('"', open + 1) - open);
  }
  return label;
}

// Which line calls the section that a label begins, and which one makes it the contour of cycles.
void Interpreter::enter_section(const std::string& label) {
  const bool ends = label == "0";
  if (ends)
    klartext_.open_labels.clear();
  else
    klartext_.open_labels.emplace(label, 0);
  if (const auto call = klartext_.calls.find(label); ends || call != klartext_.calls.end())
    klartext_.called_section = ends ? 0 : call->second;
  if (const auto cycle = klartext_.labels_of_cycles.find(label);
      ends || cycle != klartext_.labels_of_cycles.end())
    klartext_.cycle_section = ends ? 0 : cycle->second;
}

// Behind the end subprograms stand: one that is called is no leftover.
bool Interpreter::enter_label_behind_end(const ProgramLine& line) {
  const std::size_t begin = line.text.find_first_not_of("0123456789 \tNn/");
  if (begin == std::string::npos) return true;
  const std::string statement = statement_of(std::string_view(line.text).substr(begin));
  if (begins_with_word(statement, "LBL")) enter_section(label_of(line.text, begin, statement));
  if (begins_with_word(statement, "TOOL CALL")) return take_tool_of_label(line, begin);
  if (!begins_with_word(statement, "CALL LBL")) return true;
  // A section that a contour counts on calls another one.
  for (const auto& [label, unused] : klartext_.open_labels)
    if (const auto call = klartext_.calls_of_contours.find(label);
        call != klartext_.calls_of_contours.end())
      klartext_.calls_of_contours.try_emplace(label_of(line.text, begin, statement), call->second);
  return true;
}

// TOOL CALL within a label. Called from elsewhere it changes the tool there.
bool Interpreter::take_tool_of_label(const ProgramLine& line, std::size_t begin) {
  for (const auto& [label, unused] : klartext_.open_labels) {
    if (const auto known = klartext_.labels.find(label); known != klartext_.labels.end())
      known->second.calls_tool = true;
    const auto call = klartext_.calls_of_contours.find(label);
    if (call != klartext_.calls_of_contours.end())
      return refuse_klartext(line, begin,
                             "TOOL CALL in a section that line " + std::to_string(call->second) +
                                 " calls in front of a contour");
  }
  return true;
}

// LBL 1 … LBL 0.
bool Interpreter::read_label(ProgramLine& line, std::size_t begin, std::string_view statement) {
  // Called from elsewhere it finds other values.
  klartext_.parameters.clear();
  if (statement.starts_with("CALL")) return call_label(line, begin, statement);
  const std::string label = label_of(line.text, begin, statement);
  const std::uint64_t contours = klartext_.contours;
  enter_section(label);
  if (label == "0") {
    for (auto& [name, of_label] : klartext_.labels)
      if (!of_label.behind) of_label.behind = contours;
  } else {
    // A contour that is open goes on behind the label.
    klartext_.labels[label] = {.before = trc_active() ? contours - 1 : contours};
  }
  if (klartext_.called_section != 0 && trc_active())
    return refuse_klartext(line, begin, "LBL, which is called, while TRC is active");
  if (label != "0") hand_on_klartext_pole(line);
  if (klartext_.jump != 0) forget_klartext_position(line);
  return copy_klartext(line, begin, WordRole::technology);
}

// FN 9 … FN 12, IF: the program goes on elsewhere, so that neither what stands in front of the jump
// nor what stands behind it may be a contour (D-114).
bool Interpreter::copy_jump(ProgramLine& line, std::size_t begin, std::string_view statement) {
  if (klartext_.contours > 0) {
    const std::size_t behind_name = statement.find_first_of(": ", statement.find(' ') + 1);
    return refuse_klartext(line, begin,
                           std::string(statement.substr(0, behind_name)) + ", a jump to a label");
  }
  if (klartext_.jump == 0) klartext_.jump = line.source.line;
  klartext_.parameters.clear();
  klartext_.pole.reset();
  klartext_.polar_radius.reset();
  forget_klartext_position(line);
  return copy_klartext(line, begin, WordRole::technology);
}

// CALL LBL 1 runs the label to its LBL 0, CALL LBL 1 REP 3 all from the label to here. What a call
// repeats is not written anew, so that no contour may be within it.
bool Interpreter::call_label(ProgramLine& line, std::size_t begin, std::string_view statement) {
  const std::string label = label_of(line.text, begin, statement);
  if (trc_active()) return refuse_klartext(line, begin, "CALL LBL while TRC is active");
  const auto known = klartext_.labels.find(label);
  const bool to_here = statement.find(" REP") != std::string_view::npos;
  if (known != klartext_.labels.end() && (to_here ? known->second.before != klartext_.contours
                                                  : known->second.has_contour(klartext_.contours)))
    return refuse_klartext(line, begin, "CALL LBL, which repeats a compensated contour");
  const bool stands_behind = known == klartext_.labels.end();
  if (stands_behind) {
    klartext_.calls.try_emplace(label, line.source.line);
    klartext_.calls_behind_tool.try_emplace(label, line.source.line);
  } else if (!to_here && known->second.calls_tool) {
    klartext_.tool_of_label = line.source.line;
  }
  hand_on_klartext_pole(line);
  forget_klartext_position(line);
  klartext_.pole.reset();
  klartext_.polar_radius.reset();
  line.feed_it_takes = std::exchange(feed_, 0);
  return copy_klartext(line, begin, WordRole::technology);
}

// CYCL DEF 14.1 CONTOUR LABEL 1/2, CONTOUR DEF P1 = LBL 1: cycles mill these contours, with RL and
// RR in them, so that they stay as they are.
bool Interpreter::take_labels_of_cycle(const ProgramLine& line, std::size_t begin,
                                       std::string_view statement) {
  const bool by_cycle = statement.starts_with("CYCL DEF 14.");
  if (!by_cycle && !statement.starts_with("CONTOUR DEF")) return true;
  const std::string_view word = by_cycle ? "LABEL" : " LBL";
  std::size_t at = statement.find(word);
  while (at != std::string_view::npos) {
    at += word.size();
    // Numbers, with what stands between them: of the cycle several.
    for (;;) {
      at = std::min(statement.find_first_not_of(" /,=", at), statement.size());
      const std::size_t end =
          std::min(statement.find_first_not_of("0123456789", at), statement.size());
      if (end == at) break;
      const std::string label(statement.substr(at, end - at));
      const auto known = klartext_.labels.find(label);
      if (known != klartext_.labels.end() && known->second.has_contour(klartext_.contours))
        return refuse_klartext(
            line, begin, "a cycle with the contour of LBL " + label + ", which is compensated");
      klartext_.labels_of_cycles.try_emplace(label, line.source.line);
      at = end;
    }
    at = statement.find(word, at);
  }
  return true;
}

}  // namespace trc
