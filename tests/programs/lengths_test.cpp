#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/program_run.h"

// Programs whose length of path shows that no part of it is missing (D-44, D-45).

namespace trc::support {
namespace {

const std::filesystem::path lengths =
    std::filesystem::path(testing_support::source_dir()) / "tests" / "programs" / "lengths";

double length_of_path(const std::vector<CompensatedBlock>& blocks) {
  double length = 0;
  for (const CompensatedBlock& block : blocks)
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      length += length_of(block.path);
  return length;
}

TEST(PathLengths, AreThoseOfTheWholePath) {
  std::istringstream lines(testing_support::content_of(lengths / "lengths.txt"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name;
    double expected = 0;
    double part = 0;
    words >> name >> expected >> part;
    SCOPED_TRACE(name);
    const ProgramRun run = to_blocks(testing_support::content_of(lengths / (name + ".nc")));
    EXPECT_FALSE(run.stopped) << run.report();
    EXPECT_NEAR(length_of_path(run.blocks), expected, part * expected);
    ++count;
  }
  EXPECT_EQ(count, 14U);
}

}  // namespace
}  // namespace trc::support
