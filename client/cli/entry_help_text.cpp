#include "client/cli/entry_help_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/length_unit.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/text/number_format.h"

namespace trc::cli {
namespace {

using Axes = std::array<double, 3>;

Axes axes_of(const DiagnosticPoint& point) { return {point.x, point.y, point.z}; }

std::string length_text(double length, const Writing& writing) {
  std::string text;
  append_fixed(text, writing.inch ? length / mm_per_inch : length, writing.inch ? 4 : 3);
  return text + (writing.inch ? " in" : " mm");
}

// Writes one help text.
class Words {
 public:
  Words(const EntryHelp& help, const Writing& writing)
      : third_(help.third_axis),
        dialect_(writing.dialect),
        inch_(writing.inch),
        german_(writing.language == Language::german),
        points_(dialect_of(writing.dialect).writes_points) {}

  // The axes of the plane, and the third axis if it changes.
  [[nodiscard]] std::string place(const Axes& point, double height) const {
    constexpr std::array<char, 3> letters{'X', 'Y', 'Z'};
    std::string text;
    for (std::size_t axis = 0; axis < letters.size(); ++axis) {
      if (axis == third_ && point[axis] == height) continue;
      text += (text.empty() ? "" : " ") + std::string(1, letters[axis]) + number(point[axis]);
    }
    return text;
  }

  [[nodiscard]] std::string line_of(const ProposedBlock& block, const Axes& from) const {
    const Axes to = axes_of(block.end);
    if (!block.center) return (is_klartext() ? "L " : "G1 ") + place(to, from[third_]);
    const Axes center = axes_of(*block.center);
    double squared = 0;
    for (std::size_t axis = 0; axis < to.size(); ++axis)
      if (axis != third_) squared += (to[axis] - center[axis]) * (to[axis] - center[axis]);
    if (is_klartext())
      return "CR " + place(to, from[third_]) + " R" + number(std::sqrt(squared)) +
             (block.sweep > 0 ? " DR+" : " DR-");
    const std::string radius = dialect_ == DialectName::sinumerik ? " CR=" : " R";
    return (block.sweep > 0 ? "G3 " : "G2 ") + place(to, from[third_]) + radius +
           number(std::sqrt(squared));
  }

  [[nodiscard]] std::string rapid_to(const Axes& point) const {
    const std::string text = place(point, height(point));
    return is_klartext() ? "L " + text + " R0 FMAX" : "G0 " + text;
  }
  [[nodiscard]] std::string selects() const {
    if (is_klartext()) return in(" with RL or RR as before", " mit RL oder RR wie bisher");
    return in(" with G41 or G42 as before", " mit G41 oder G42 wie bisher");
  }
  [[nodiscard]] std::string deselects() const {
    return is_klartext() ? " R0" : in(" with G40", " mit G40");
  }
  [[nodiscard]] bool is_klartext() const { return dialect_ == DialectName::heidenhain; }

  [[nodiscard]] double height(const Axes& point) const { return point[third_]; }
  [[nodiscard]] std::string in(std::string english, std::string german) const {
    return german_ ? std::move(german) : std::move(english);
  }

 private:
  // In the unit of the program, without trailing zeros.
  [[nodiscard]] std::string number(double value) const {
    std::string text;
    append_fixed(text, inch_ ? value / mm_per_inch : value, inch_ ? 5 : 4);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.') && !points_) text.pop_back();
    if (text == "-0") text = "0";
    return is_klartext() && text.front() != '-' ? "+" + text : text;
  }

  std::size_t third_;
  DialectName dialect_;
  bool inch_;
  bool german_;
  bool points_;
};

std::string line_of(const EntryProposal& proposal, bool leaves, const Words& words) {
  std::string text;
  Axes from = axes_of(proposal.start);
  if (!leaves) text = words.rapid_to(from);
  if (proposal.shape == EntryProposal::Shape::inside_corner) text += ", G238";
  for (std::size_t i = 0; i < proposal.blocks.size(); ++i) {
    const ProposedBlock& block = proposal.blocks[i];
    text += (text.empty() ? "" : ", ") + words.line_of(block, from);
    if (!leaves && i == 0) text += words.selects();
    if (leaves && i + 1 == proposal.blocks.size()) text += words.deselects();
    from = axes_of(block.end);
  }
  // The next contour block may have no G word of its own.
  if (!leaves && !words.is_klartext() && !proposal.blocks.empty() && proposal.blocks.back().center)
    text += ", G1";
  return text;
}

// For example "the block", "the 2 blocks".
std::string blocks(const std::string& which, std::uint32_t count) {
  return count == 1 ? which + "block" : which + std::to_string(count) + " blocks";
}

std::string words_of_leads(const EntryHelp& help, const Words& words) {
  if (help.leaves)
    return words.in("what leads off the contour has to be another one: replace the retract",
                    "von der Kontur muss ein anderer Weg führen: den Abfahrsatz ersetzen");
  std::string text =
      words.in("what leads to the contour has to be another one: replace the approach",
               "zur Kontur muss ein anderer Weg führen: den Anfahrsatz ersetzen");
  if (help.replaced > 0)
    text += words.in(" and " + blocks("the ", help.replaced) + " after it, as leads",
                     help.replaced == 1 ? ", dazu den Satz dahinter, der anfährt"
                                        : ", dazu die " + std::to_string(help.replaced) +
                                              " Sätze dahinter, die anfahren");
  if (help.left_out > 0)
    text += words.in(", and leave out " + blocks("the last ", help.left_out) + " before G40",
                     help.left_out == 1 ? ", und den letzten Satz vor G40 weglassen"
                                        : ", und die letzten " + std::to_string(help.left_out) +
                                              " Sätze vor G40 weglassen");
  return text;
}

bool is_in_corner(const EntryProposal& proposal) {
  return proposal.shape == EntryProposal::Shape::inside_corner;
}

std::string name_of(EntryProposal::Shape shape, const Words& words) {
  switch (shape) {
    case EntryProposal::Shape::line:
      break;
    case EntryProposal::Shape::quarter_circle:
      return words.in("quarter circle, in ", "Viertelkreis, in ");
    case EntryProposal::Shape::inside_corner:
      return words.in("G238, in ", "G238, in ");
  }
  return words.in("line, in ", "Gerade, in ");
}

std::string first_line(const EntryHelp& help, const Words& words, const Writing& writing) {
  if (std::any_of(help.proposals.begin(), help.proposals.end(), is_in_corner))
    return words.in("the contour begins and closes in an inside corner, where ",
                    "die Kontur beginnt und schließt in einer Innenecke: ") +
           (writing.dialect == DialectName::isg
                ? words.in("G238 lets the tool in; or begin", "G238 wählen oder")
                : words.in("the tool has no room; begin", "das Werkzeug hat dort keinen Platz,")) +
           words.in(" it in the middle of a block", " sie in der Mitte eines Satzes beginnen");
  if (help.needed_length == 0 && !help.legal) return words_of_leads(help, words);
  std::string text = help.leaves ? words.in("the retract is ", "der Abfahrsatz ist ")
                                 : words.in("the approach is ", "der Anfahrsatz ist ");
  text += length_text(help.given_length, writing) + words.in(" long", " lang");
  if (help.needed_length > 0)
    text += words.in(" and needs at least ", " und braucht mindestens ") +
            length_text(help.needed_length, writing);
  if (!help.legal) return text;
  const Axes place = axes_of(*help.legal);
  return text +
         (help.leaves ? words.in("; it may end at ", "; er darf enden bei ")
                      : words.in("; it may start at ", "; er darf beginnen bei ")) +
         words.place(place, words.height(place));
}

}  // namespace

std::vector<std::string> lines_of(const EntryHelp& help, const Writing& writing) {
  const Words words(help, writing);
  if (help.needed_length == 0 && !help.legal && help.proposals.empty()) return {};
  std::vector<std::string> lines{first_line(help, words, writing)};
  for (const EntryProposal& proposal : help.proposals) {
    // Other dialects have no G238.
    if (is_in_corner(proposal) && writing.dialect != DialectName::isg) continue;
    lines.push_back((help.leaves ? words.in("proposed exit, ", "Vorschlag zum Abfahren, ")
                                 : words.in("proposed entry, ", "Vorschlag zum Anfahren, ")) +
                    name_of(proposal.shape, words) +
                    (writing.inch ? words.in("inch: ", "Zoll: ") : "mm: ") +
                    line_of(proposal, help.leaves, words));
  }
  return lines;
}

}  // namespace trc::cli
