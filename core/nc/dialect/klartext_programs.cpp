#include "core/nc/dialect/klartext_programs.h"

#include <algorithm>
#include <array>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"

// Programs that a program in Klartext calls: they are not followed, but those that the setup gives
// are looked through for contours.

namespace trc {
namespace {

// PART of TNC:\DIR\PART.H
std::string plain_name(std::string_view path) {
  path.remove_prefix(path.find_last_of("/\\:") + 1);
  return in_capitals_as_utf8(path.substr(0, path.rfind('.')));
}

}  // namespace

std::string program_called_by(std::string_view statement, std::string_view text) {
  constexpr auto calls =
      std::to_array<std::string_view>({"CALL PGM", "PGM CALL", "SEL PGM", "CYCL DEF 12.1 PGM"});
  if (std::ranges::none_of(
          calls, [&](std::string_view call) { return begins_with_word(statement, call); }))
    return {};
  text = without_blanks_behind(text.substr(0, text.find_first_of(";\r\n")));
  if (text.ends_with('"')) text.remove_suffix(1);
  return plain_name(text.substr(text.find_last_of(" \t\"") + 1));
}

bool gives_contour_of(const ProgramSetup& setup, std::string_view program) {
  return std::ranges::any_of(setup.subprograms, [&](const auto& given) {
    if (plain_name(given.first) != program) return false;
    std::string_view text = given.second;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size() - 1) + 1;
      const std::string_view line = text.substr(0, end);
      if (place_of_klartext_side(line.substr(0, line.find(';'))) != std::string_view::npos)
        return true;
      text.remove_prefix(end);
    }
    return false;
  });
}

}  // namespace trc
