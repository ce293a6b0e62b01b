#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/cli/entry_help_text.h"
#include "proto/wire/diagnostic.h"

namespace trc::cli {

// Where and how a message is shown.
struct Shown {
  std::string_view file{};
  std::optional<std::string> source_line{};  // of the program, as it stands there; none: not known
  Writing writing{};                         // for proposals
  bool in_colour = false;
};

// As compilers write it: place, N number, code and message; the line of the program with a mark
// under the word; what helps.
//
//   part.nc:5:9: N50: error 20035: the circle centre does not fit …
//       5 | N50 G02 X40 Y20 I25 J0
//         |         ^~~
//   help: Correct I, J, K or the end point.
//
// Without column where it is not known: then that of the word at fault, if the line has it once.
// Control characters, and what is no UTF-8, are shown as '?'. Each line ends with a line feed.
[[nodiscard]] std::string text_of(const Diagnostic& diagnostic, const Shown& shown);

// Messages of one code and severity that are counted, not shown.
struct Counted {
  // How many places are named.
  static constexpr std::size_t most_places = 8;

  Severity severity = Severity::error;
  Code code{};
  Language language = Language::english;
  std::uint64_t count = 0;
  std::vector<Source> first_places{};  // at most `most_places`, those with a line

  // One more, of the same code and severity.
  void add(const Diagnostic& found);
};

// "part.nc: warning 22007: 12 more like it, in lines 8 (N80), 9 …". At least one was counted.
[[nodiscard]] std::string more_like(const Counted& counted, const Shown& shown);
// As more_like(), of messages that have one code, but not one text.
[[nodiscard]] std::string more_of_code(const Counted& counted, const Shown& shown);

// Whether what is written to standard error may be in colour: on a terminal that is not TERM=dumb,
// unless NO_COLOR is set and not empty.
[[nodiscard]] bool colours_wanted();

}  // namespace trc::cli
