#include "client/cli/given_subprograms.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/nc/text/characters.h"

namespace trc::cli {
namespace {

// The common part of file names and subprogram names: O7, o<seven>, PART and 0007.nc, seven.ngc,
// part.spf.
std::string common_name(std::string_view name) {
  std::string common;
  for (const char sign : in_upper_case(name.substr(0, name.rfind('.'))))
    if (is_letter(sign) || is_digit(sign) || sign == '_') common += sign;
  if (common.size() > 1 && common.front() == 'O') common.erase(0, 1);
  common.erase(0, common.find_first_not_of('0'));
  return common;
}

// The line without its line end; none: the text has no such line.
std::optional<std::string> line_of(std::string_view text, std::uint32_t number) {
  for (std::uint32_t line = 1;; ++line) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (line == number) return std::string(text.substr(0, end));
    if (end == text.size()) return std::nullopt;
    text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
  }
}

}  // namespace

GivenSubprograms::GivenSubprograms(const v1::ProgramSetup& setup)
    : texts_(setup.subprograms().begin(), setup.subprograms().end()) {
  texts_.insert(setup.subprogram_files().begin(), setup.subprogram_files().end());
}

std::optional<GivenSubprograms::Line> GivenSubprograms::line_of(const CallPlace& place) const {
  if (place.line_within == 0) return std::nullopt;
  const std::string name = common_name(place.subprogram);
  const auto is_named = [&](const auto& file) {
    return texts_.size() == 1 || common_name(file.first) == name;
  };
  const auto found = std::find_if(texts_.begin(), texts_.end(), is_named);
  if (found == texts_.end() ||
      std::find_if(std::next(found), texts_.end(), is_named) != texts_.end())
    return std::nullopt;
  auto text = cli::line_of(found->second, place.line_within);
  if (!text) return std::nullopt;
  return Line{.file = found->first, .text = *std::move(text)};
}

}  // namespace trc::cli
