#include "core/nc/dialect/gcode_beside_path.h"

#include <algorithm>
#include <string>

#include "core/nc/dialect/pass_words.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/gcode_words.h"

// Text in a line that does not affect the path: messages, assignments, output, comments.

namespace trc {
namespace {

// POPEN, DPRNT[TEXT], PCLOS: their output goes elsewhere. Variables of the program are already
// replaced by values; variables of the machine are not.
bool prints_text(std::string_view line, std::size_t begin) {
  const std::string word = word_to_pass(line, begin);
  return word == "POPEN" || word == "PCLOS" || word == "DPRNT" || word == "BPRNT";
}

// msg "…", LogMsg "…", LogFile "…" 1 and DlgMsg "…" of EdingCNC. After its text DlgMsg names the
// variables that the operator sets.
bool shows_message(std::string_view line, std::size_t begin) {
  const std::string word = word_to_pass(line, begin);
  const bool asks = word == "DLGMSG";
  if (word != "MSG" && word != "LOGMSG" && word != "LOGFILE" && !asks) return false;
  std::string_view behind = without_blanks_in_front(line.substr(begin + word.size()));
  if (!behind.starts_with('"')) return false;
  for (std::size_t texts = 0; !behind.empty(); behind = without_blanks_in_front(behind)) {
    if (behind.front() == '(' || behind.front() == ';') return true;
    if (behind.front() == '"') {
      const std::size_t close = behind.find('"', 1);
      if (close == std::string_view::npos || (asks && texts > 0)) return false;
      behind.remove_prefix(close + 1);
      ++texts;
    } else if (asks || is_letter(behind.front())) {
      return false;
    } else {
      behind.remove_prefix(1);
    }
  }
  return true;
}

// #3003=1, #501=12.5 and #502=#0, also #500=#500+1: assignments that the flow of a program that
// computes leaves in it (D-88, D-93, D-95). The flow has read the expression.
bool sets_variable(std::string_view line, std::size_t begin) {
  if (line[begin] != '#') return false;
  std::string_view behind = line.substr(begin + 1);
  double value = 0;
  bool whole = false;
  const std::size_t digits = read_number(behind, value, whole);
  if (digits == 0 || !whole) return false;
  behind = without_blanks_in_front(behind.substr(digits));
  if (!behind.starts_with('=')) return false;
  behind = without_blanks_in_front(behind.substr(1));
  return !behind.empty() && behind.front() != '(' && behind.front() != ';';
}

// Only comments follow NAME or NAME[…].
bool is_name_alone(std::string_view line, std::size_t begin) {
  std::size_t at = begin + word_to_pass(line, begin).size();
  if (at < line.size() && line[at] == '[') {
    const std::size_t close = line.rfind(']');
    if (close == std::string_view::npos || close < at) return false;
    at = close + 1;
  }
  const std::string_view behind = without_blanks_in_front(line.substr(std::min(at, line.size())));
  return behind.empty() || behind.front() == '(' || behind.front() == ';';
}

}  // namespace

bool names_what_passes(const Reading& reading, std::string_view line, std::uint32_t begin) {
  const bool fanuc = reading.dialect.name == DialectName::fanuc;
  if (fanuc && sets_variable(line, begin)) return true;
  // SETVN 500[WIDTH,DEPTH] names variables.
  if (fanuc && word_to_pass(line, begin) == "SETVN") return true;
  if (shows_message(line, begin)) return true;
  return is_name_alone(line, begin) &&
         (passes_word(reading.state.setup(), line, begin) || (fanuc && prints_text(line, begin)));
}

bool cuts_off_words(const Reading& reading, const ProgramLine& line, std::uint32_t begin) {
  const auto is_number = [](const WordRange& word) { return word.role == WordRole::number; };
  return reading.dialect.name == DialectName::fanuc && word_to_pass(line.text, begin) == "SETVN" &&
         !std::ranges::all_of(line.words, is_number);
}

bool reads_as_block(std::string_view comment) {
  if (!comment.starts_with(';')) return false;
  constexpr std::string_view telling = "GMXYZ";
  bool tells = false;
  GcodeReader reader(comment.substr(1));
  for (GcodeWord word = reader.next(); word.kind != GcodeWord::Kind::end; word = reader.next()) {
    if (word.kind == GcodeWord::Kind::comment) continue;
    if (word.kind != GcodeWord::Kind::address || !word.has_number) return false;
    tells |= telling.find(word.letter) != std::string_view::npos;
  }
  return tells;
}

}  // namespace trc
