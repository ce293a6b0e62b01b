#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/length_unit.h"
#include "core/base/source.h"
#include "core/geometry/plane.h"
#include "core/nc/state/program_state.h"

namespace trc {

// The role of a word when its line is written again.
enum class WordRole : std::uint8_t {
  number,      // N
  motion,      // G00 … G03
  coordinate,  // axis words, I J K R of a motion
  trc,         // what TRC resolves: G05 G10 G11 G25 G26 G40 … G42 G138 … G141 G236 … G239,
               // #TRC, #TANGFEED, V.G.WZ_AKT.R=
  mode,        // G17 … G19 G70 G71 G90 G91 G161 G162 G164 G165, G40 while TRC is off
  feed,        // F of a feed per minute
  technology,  // S T D M H, dwell, zero shifts with their axis words, all other G functions
               // and commands that pass
  stop,        // M00 M01 M02 M30: technology that acts after the motion of its line, so after
               // all blocks that the motion becomes
  comment,     // ( … ) and ; …, with the signs
};

// For sets of roles: a bit each.
using RoleSet = std::uint16_t;
[[nodiscard]] constexpr RoleSet bit(WordRole role) {
  return static_cast<RoleSet>(1U << static_cast<unsigned>(role));
}

// Bytes [begin, end) of ProgramLine::text, without the blanks around. Ranges of
// a line are in order and do not overlap; between them are blanks, tabs and
// the `\` and line ends of continued lines.
struct WordRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  WordRole role = WordRole::technology;

  bool operator==(const WordRange&) const = default;
};

// What a writer that copies a line of Klartext must know besides its words.
struct KlartextLine {
  std::uint64_t axes = 0;        // named; bits as AxisSet has them
  std::uint64_t increments = 0;  // of those
  bool sets_pole = false;        // CC
  bool needs_pole = false;       // C CP LP CTP
  bool loses_pole = false;       // after it only the control knows where the pole is
  bool hands_pole_on = false;    // CALL, LBL: what follows there may count on it
  bool sets_polar_radius = false;
  bool needs_polar_radius = false;  // LP without PR
  bool counts_from_start = false;   // CT, IPA, IPR: more than increments of axes
  bool needs_tangent = false;       // CT CTP
  double pole_x = 0;                // in force after the line, in the axes of the plane, mm
  double pole_y = 0;

  bool operator==(const KlartextLine&) const = default;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(axes, increments, sets_pole, needs_pole, loses_pole, hands_pole_on, sets_polar_radius,
            needs_polar_radius, counts_from_start, needs_tangent, pole_x, pole_y);
  }
};

// For the archives of core/base/archive.h; defined in core/nc/state/state_archive.h.
template <class Archive>
void serialize_line_end(Archive& archive, std::string_view& line_end);

// One line of NC text as it was read: a block may span several lines joined by
// `\`; they are one ProgramLine.
//
// text + line_end of all lines, one after the other, is the program, byte for
// byte. A byte order mark is a line of its own, without line end.
struct ProgramLine {
  // `index` is that of the block when `has_words`; else that of the next one.
  Source source{};
  std::string text{};
  std::string_view line_end{};  // "\n", "\r\n", "\r"; empty at the end of the text
  std::vector<WordRange> words{};
  RoleSet roles = 0;              // of the words
  bool names_other_axes = false;  // a coordinate is neither X Y Z nor I J K R
  std::uint8_t main_axes = 0;     // X Y Z among the coordinates, a bit each

  bool has_words = false;  // counts in Source::index; false: name, comment, blank, after the end
  // The line gave exactly one block of motion with this Source (of any length; a
  // PassiveBlock with empty text when nothing moves in the plane).
  bool is_motion = false;
  bool has_trc_words = false;
  bool ends_program = false;  // M02, M30
  // For a copied line that may move at the feed in force: that feed, mm/min; 0: none.
  double feed_it_takes = 0;
  // G92: the position of the third axis after the line, mm, though nothing has moved.
  std::optional<double> third_set{};
  // Its values are the result of a computation, with more decimals than anybody wrote.
  bool is_computed = false;
  // It calls a text that only the machine has, which may rely on the words that TRC resolves.
  bool calls_the_machine = false;

  // In force at the end of the line.
  MotionKind motion = MotionKind::rapid;
  bool incremental = false;               // G91
  LengthUnit unit = LengthUnit::mm;       // G70, G71
  LengthUnit feed_unit = LengthUnit::mm;  // of F, a minute
  bool absolute_center = false;           // G161
  Plane plane = Plane::xy;
  double feed = 0;  // mm/min; 0: none programmed yet, or not per minute (G93, G95)
  std::optional<KlartextLine> klartext{};

  // Collects the roles of the words in `roles`.
  void sum_up_roles() {
    roles = 0;
    for (const WordRange& range : words) roles |= bit(range.role);
  }
  [[nodiscard]] bool has(WordRole role) const { return (roles & bit(role)) != 0; }
  [[nodiscard]] std::string_view word(const WordRange& range) const {
    return std::string_view(text).substr(range.begin, range.end - range.begin);
  }
};

// Whether a coordinate word begins with the letter of its axis: not CR= and the like.
[[nodiscard]] inline bool names_an_axis(const ProgramLine& line, const WordRange& word) {
  const char second = word.end > word.begin + 1 ? line.text[word.begin + 1] : ' ';
  return !((second >= 'A' && second <= 'Z') || (second >= 'a' && second <= 'z'));
}

// The name of several characters before the sign, as in X1=5 and MX = 5; else empty.
[[nodiscard]] inline std::string_view long_name_of(const ProgramLine& line, const WordRange& word) {
  const std::string_view text = line.word(word);
  std::size_t end = 0;
  while (end < text.size() && text[end] != '=' && text[end] != ' ' && text[end] != '\t') ++end;
  const std::size_t sign = text.find_first_not_of(" \t", end);
  if (end < 2 || sign == std::string_view::npos || text[sign] != '=') return {};
  return text.substr(0, end);
}

// AP= and RP= name both axes of the plane, and so does AR=, which may stand for the end of an arc.
[[nodiscard]] inline bool is_polar(const ProgramLine& line, const WordRange& word) {
  const auto is = [&](std::size_t at, char capital) {
    return at < line.text.size() &&
           (line.text[at] == capital || line.text[at] == capital - 'A' + 'a');
  };
  return (is(word.begin, 'A') || is(word.begin, 'R')) &&
         (is(word.begin + 1, 'P') || is(word.begin + 1, 'R'));
}

// C=DC(10), C=ACP(350), C=ACN(350) of Sinumerik: a position and the direction of rotation to it,
// which a plain number cannot express (D-92).
[[nodiscard]] bool says_way_round(const ProgramLine& line, const WordRange& word);

// Lines stay where they are on their way from the reader to the writer and back, with the memory
// their text takes.
using LinePointer = std::unique_ptr<ProgramLine>;

}  // namespace trc
