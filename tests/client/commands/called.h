#pragma once

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/process.h"

// What the tests share that call the built programs as an operator does.

namespace trc::testing_support {

// In the manner of the G239 demonstration, R 10.
inline const std::string demo =
    "%demo\n"
    "N10 G90 G17 G00 X0 Y0\n"
    "N20 G239\n"
    "N30 V.G.WZ_AKT.R = 10\n"
    "N40 G41 G01 X30 Y20 F1000\n"
    "N50 X60\n"
    "N55 M8\n"
    "N60 X90\n"
    "N70 X120\n"
    "N80 G40\n"
    "N90 G00 X150 Y0\n"
    "N100 M30\n";

// The middle edge is too short for the tool in both of its inside corners.
inline const std::string violating =
    "N10 G90 G17 G00 X-20 Y0\n"
    "N20 V.G.WZ_AKT.R=10\n"
    "N30 G138 G41 G01 X0 Y0 F500\n"
    "N40 X50\n"
    "N50 X55 Y5\n"
    "N60 Y50\n"
    "N70 G40 X0 Y60\n"
    "N80 M30\n";

// Messages are expected in English, whatever the machine speaks.
inline const int in_english = setenv("LC_ALL", "C", 1);

inline Ended trc(std::vector<std::string> arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), trc_program());
  return run(arguments, input);
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const auto end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end == std::string::npos ? text.size() : end + 1;
  }
  return lines;
}

inline google::protobuf::Struct object_of(const std::string& line) {
  google::protobuf::Struct object;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(line, &object).ok()) << line;
  return object;
}

// The first word of a German text that only English has; empty: none.
inline std::string english_word_in(const std::string& text) {
  static const std::regex english(
      R"(\b(the|or|of|with|not|has|is|are|that|which|and|to|line|there|cannot|did|Run|more|required|missing|names|no|allowed|value|Value|File|does|exist|unknown|range)\b)");
  std::smatch found;
  return std::regex_search(text, found, english) ? found.str() : std::string();
}

// Names of the lines between "title:" and an empty line, as the help lists them.
inline std::vector<std::string> listed(const std::string& help, const std::string& title,
                                       const std::regex& name) {
  const std::size_t begin = help.find(title + ":\n");
  if (begin == std::string::npos) return {};
  const std::string part = help.substr(begin, help.find("\n\n", begin) - begin);
  std::vector<std::string> names;
  for (std::sregex_iterator it(part.begin(), part.end(), name), end; it != end; ++it)
    names.push_back((*it)[1]);
  return names;
}

}  // namespace trc::testing_support
