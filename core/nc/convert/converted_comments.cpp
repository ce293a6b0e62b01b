#include "core/nc/convert/converted_comments.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc {
namespace {

// #500=#500+1, R1=R1+1 and V.S.PARTS = 2, which the control keeps for its own programs (D-88,
// D-89). Returns where the assignment begins; npos: the line is not an assignment.
std::size_t begin_of_setting(std::string_view line, DialectName dialect) {
  constexpr std::string_view digits = "0123456789";
  const auto behind_blanks = [&](std::size_t at) {
    return std::min(line.find_first_not_of(" \t", at), line.size());
  };
  std::size_t begin = behind_blanks(0);
  if (begin < line.size() && upper(line[begin]) == 'N')
    begin = behind_blanks(std::min(line.find_first_not_of(digits, begin + 1), line.size()));
  const std::string text = in_capitals(line.substr(begin));
  const auto is_parameter = [&] {
    const std::size_t behind = text.find_first_not_of(digits, 1);
    return text.starts_with('R') && behind > 1 && behind != std::string::npos &&
           text[behind] == '=';
  };
  // Longer numbers such as #3003 are switches of the control.
  constexpr std::size_t most_digits = 3;
  bool sets = false;
  if (dialect == DialectName::fanuc)
    sets = text.starts_with('#') && text.find_first_not_of(digits, 1) <= most_digits + 1;
  else if (dialect == DialectName::linuxcnc)
    sets = text.starts_with('#');
  else if (dialect == DialectName::sinumerik)
    sets = is_parameter();
  else if (dialect == DialectName::isg)
    sets = text.starts_with("V.S.") || text.starts_with("V.E.");
  return sets ? begin : std::string_view::npos;
}

// (ABORT, …): a comment that LINUXCNC acts on.
bool is_command_of_linuxcnc(std::string_view comment) {
  constexpr auto commands = std::to_array<std::string_view>(
      {"ABORT,", "DEBUG,", "LOG,", "LOGAPPEND,", "LOGCLOSE", "LOGOPEN,", "MSG,", "PRINT,",
       "PROBECLOSE", "PROBEOPEN", "PY,", "PYRUN,"});
  const std::string text = in_capitals(comment);
  return std::ranges::any_of(commands, [&](auto command) { return text.starts_with(command); });
}

}  // namespace

std::string in_capitals(std::string_view text) {
  std::string result;
  for (const char sign : text)
    if (sign != ' ' && sign != '\t') result += upper(sign);
  return result;
}

std::string with_settings_as_comments(std::string_view program, DialectName dialect) {
  std::string text;
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find('\n', at), program.size() - 1) + 1;
    const std::string_view line = program.substr(at, end - at);
    at = end;
    const std::size_t begin = begin_of_setting(line, dialect);
    if (begin == std::string_view::npos) {
      text.append(line);
      continue;
    }
    const bool sinumerik = dialect == DialectName::sinumerik;
    const std::size_t behind =
        std::min(line.find_first_of(sinumerik ? "\r\n" : "(;\r\n", begin), line.size());
    text.append(line.substr(0, begin)).append(sinumerik ? ";" : "(");
    text.append(without_blanks_behind(line.substr(begin, behind - begin)));
    text.append(sinumerik ? "" : ")").append(line.substr(behind));
  }
  return text;
}

std::string spelled_comment(std::string comment, DialectName to) {
  if (comment.empty()) return comment;
  // A Klartext comment may span several lines; the others end with their line.
  std::ranges::replace_if(
      comment, [](char sign) { return sign == '\r' || sign == '\n'; }, ' ');
  if (to == DialectName::isg) comment = as_utf8(comment);
  // In Klartext a `~` at the end of a line continues it.
  if (to == DialectName::heidenhain && comment.ends_with('~')) comment.back() = '-';
  if (to == DialectName::heidenhain || to == DialectName::sinumerik) return "; " + comment;
  if (to == DialectName::linuxcnc && is_command_of_linuxcnc(comment)) comment.insert(0, "- ");
  std::replace(comment.begin(), comment.end(), '(', '[');
  std::replace(comment.begin(), comment.end(), ')', ']');
  return "(" + comment + ")";
}

}  // namespace trc
