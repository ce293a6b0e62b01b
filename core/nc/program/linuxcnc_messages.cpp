#include <algorithm>
#include <array>

#include "core/nc/program/linuxcnc_flow.h"
#include "core/nc/text/characters.h"

// The parameters in the messages of the flat program, and for subprograms that only the machine has
// (D-84).

namespace trc::program {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr int usual_decimals = 6;

bool prints_values(std::string_view comment) {
  constexpr auto words = std::to_array<std::string_view>({"PRINT,", "DEBUG,", "LOG,", "ABORT,"});
  const std::string begin = in_upper_case(without_blanks_in_front(comment.substr(1, 12)));
  return std::ranges::any_of(words, [&](std::string_view word) { return begin.starts_with(word); });
}

// The decimals of %d, %f, %lf or %.3f at `at`, which moves past it; -1: no such format, the sign is
// printed.
int decimals_at(std::string_view message, std::size_t& at) {
  constexpr int of_float = 4;
  const std::string_view format = message.substr(at + 1);
  const bool has_decimals =
      format.size() > 2 && format[0] == '.' && is_digit(format[1]) && format[2] == 'f';
  const int decimals = has_decimals               ? format[1] - '0'
                       : format.starts_with("lf") ? usual_decimals
                       : format.starts_with('f')  ? of_float
                       : format.starts_with('d')  ? 0
                                                  : -1;
  at += decimals < 0 ? 1 : has_decimals ? 4 : format.starts_with("lf") ? 3 : 2;
  return decimals;
}

}  // namespace

std::string LinuxcncFlow::with_values(std::string_view comments) {
  std::string text;
  for (std::size_t at = 0; at < comments.size();) {
    const bool opens = comments[at] == '(';
    const std::size_t end =
        opens ? behind_comment(comments, at) : std::min(comments.find('(', at), comments.size());
    const bool is_rest = comments[at] == ';' || end == 0;
    const std::string_view part = comments.substr(at, is_rest ? npos : end - at);
    if (opens && prints_values(part))
      append_message(text, part);
    else
      text.append(part);
    at += part.size();
  }
  return text;
}

// (print,#<depth> %d #1): prints as many decimals as the control. Unknown parameters stay as they
// are; the machine prints the parameters that only it has.
void LinuxcncFlow::append_message(std::string& out, std::string_view message) const {
  int decimals = usual_decimals;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t begin = at;
    Target target;
    if (message[at] == '%') {
      const int format = decimals_at(message, at);
      if (format >= 0) decimals = format;
      out.append(message.substr(begin, at - begin));
      continue;
    }
    if (message[at++] == '#' && at < message.size()) {
      if (const std::size_t close = message.find('>', at); message[at] == '<' && close != npos) {
        target.name = plain_name(message.substr(at + 1, close - at - 1));
        at = close + 1;
      }
      constexpr std::size_t most_digits = 6;
      for (const std::size_t digits = at;
           at < message.size() && is_digit(message[at]) && at - digits < most_digits; ++at)
        target.number = target.number * 10 + (message[at] - '0');
    }
    const bool is_parameter = !target.name.empty() || target.number > 0;
    const std::optional<double> value =
        is_parameter && !is_of_machine(target) ? content_of(target) : std::nullopt;
    if (value)
      append_exactly(out, *value, decimals);
    else
      out.append(message.substr(begin, at - begin));
  }
}

// For a subprogram that only the machine has, as in D-95.
void LinuxcncFlow::write_values() {
  const auto write = [&](const std::string& name, double value) {
    settings_.append("#").append(name).append("=");
    append_value(settings_, value, PointStyle::as_whole);
    settings_.append(line_end());
  };
  for (const std::int64_t number : unwritten_numbers_)
    if (const auto known = common_.find(number); known != common_.end())
      write(std::to_string(number), known->second);
  for (const std::string& name : unwritten_names_)
    if (const auto known = globals_.find(name); known != globals_.end())
      write("<" + name + ">", known->second);
  unwritten_numbers_.clear();
  unwritten_names_.clear();
}

}  // namespace trc::program
