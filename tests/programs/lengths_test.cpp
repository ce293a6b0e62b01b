#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/session/program_session.h"
#include "tests/support/places.h"

// Programs of whose path the length tells what matters: that all of it is there (D-44, D-45).

namespace trc {
namespace {

const std::filesystem::path folder =
    std::filesystem::path(testing_support::source_dir()) / "tests" / "programs" / "lengths";

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

double length_of_path(const Answer& out) {
  double length = 0;
  for (const CompensatedBlock& block : out.blocks)
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      length += length_of(block.path);
  return length;
}

TEST(PathLengths, AreThoseOfTheWholePath) {
  std::istringstream lines(text_of_file(folder / "lengths.txt"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name;
    double expected = 0;
    double part = 0;
    words >> name >> expected >> part;
    SCOPED_TRACE(name);
    ProgramSessionSetup setup;
    setup.nc_text = false;
    ProgramSession session(setup);
    Answers out;
    const std::string text = text_of_file(folder / (name + ".nc"));
    EXPECT_TRUE(session.feed(text, out) && session.finish(out));
    EXPECT_NEAR(length_of_path(out.take()), expected, part * expected);
    ++count;
  }
  EXPECT_EQ(count, 14U);
}

}  // namespace
}  // namespace trc
