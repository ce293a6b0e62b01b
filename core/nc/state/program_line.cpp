#include "core/nc/state/program_line.h"

#include "core/nc/text/characters.h"

namespace trc {

bool says_way_round(const ProgramLine& line, const WordRange& word) {
  const std::string_view text = line.word(word);
  const std::size_t open = text.find('(');
  if (word.role != WordRole::coordinate || open == std::string_view::npos) return false;
  const std::string said = in_upper_case(without_blanks_behind(text.substr(0, open)));
  return said.ends_with("DC") || said.ends_with("ACP") || said.ends_with("ACN");
}

}  // namespace trc
