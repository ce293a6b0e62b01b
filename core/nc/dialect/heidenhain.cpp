#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/nc/dialect/block_words.h"

// Klartext is copied line by line: its contours are not compensated here, so that a line that
// selects the radius compensation of the control is refused, and nothing else is looked at.

namespace trc {
namespace {

char upper(char letter) {
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}
bool is_letter(char sign) { return upper(sign) >= 'A' && upper(sign) <= 'Z'; }
bool is_digit(char sign) { return sign >= '0' && sign <= '9'; }

// Lines that move nothing, where RL and RR are part of a name or a text.
constexpr auto without_motion = std::to_array<std::string_view>(
    {"*", "BEGIN", "END", "BLK", "TOOL", "CYCL", "CALL", "LBL", "SEL", "PGM", "FN", "Q", "FUNCTION",
     "PLANE", "TCH", "OPEN", "STOP"});

// In capitals, what stands in quotes and behind `;` left out.
std::string words_of(std::string_view line) {
  std::string words;
  bool quoted = false;
  for (const char sign : line) {
    if (sign == '"') quoted = !quoted;
    if (sign == ';' && !quoted) break;
    words += quoted || sign == '\t' ? ' ' : upper(sign);
  }
  return words;
}

// Behind blanks, `/`, the number of the block.
std::size_t begin_of_statement(std::string_view words) {
  std::size_t at = words.find_first_not_of(" /");
  if (at == std::string_view::npos) return words.size();
  if (words[at] == 'N' && at + 1 < words.size() && is_digit(words[at + 1])) ++at;
  at = words.find_first_not_of("0123456789", at);
  if (at != std::string_view::npos) at = words.find_first_not_of(' ', at);
  return std::min(at, words.size());
}

// G41 and G42 of the programs in DIN/ISO that these controls read as well.
bool selects_in_iso(std::string_view words, std::size_t at) {
  if (words[at] != 'G' || at + 2 >= words.size() || words[at + 1] != '4') return false;
  const bool number_ends = at + 3 >= words.size() || !is_digit(words[at + 3]);
  return (words[at + 2] == '1' || words[at + 2] == '2') && number_ends;
}

// RL, RR, and R+ R- beside a single axis: not RLENGTH, nor the radius R+30 of CR.
std::size_t place_of_compensation(std::string_view words, std::size_t from) {
  for (std::size_t at = from; at + 1 < words.size(); ++at) {
    if (at > 0 && is_letter(words[at - 1])) continue;
    if (selects_in_iso(words, at)) return at;
    if (words[at] != 'R') continue;
    const char side = words[at + 1];
    const char behind = at + 2 < words.size() ? words[at + 2] : ' ';
    const bool contour =
        (side == 'L' || side == 'R') && (!is_letter(behind) || behind == 'F' || behind == 'M');
    const bool axis = (side == '+' || side == '-') && (behind == ' ' || is_letter(behind));
    if (contour || axis) return at;
  }
  return std::string_view::npos;
}

}  // namespace

bool Interpreter::read_klartext(ProgramLine& line, BlockWords& block) {
  const std::string words = words_of(line.text);
  const std::size_t begin = begin_of_statement(words);
  const std::string_view statement = std::string_view(words).substr(begin);
  const std::size_t place = place_of_compensation(words, begin);
  const bool moves = std::ranges::none_of(
      without_motion, [&](std::string_view word) { return statement.starts_with(word); });
  if (moves && place != std::string::npos)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = static_cast<std::uint32_t>(place),
                                  .detail = words.substr(place, 2) +
                                            ", a contour in Klartext: only programs without "
                                            "compensation are passed on"});
  if (statement.empty()) return true;
  block.copied = true;
  const std::size_t first = line.text.find_first_not_of(" \t");
  line.words.push_back({.begin = static_cast<std::uint32_t>(first),
                        .end = static_cast<std::uint32_t>(line.text.find_last_not_of(" \t") + 1),
                        .role = WordRole::technology});
  return true;
}

}  // namespace trc
