// What `trc` writes, where the disk does not keep it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using testing_support::content_of;
using testing_support::Folder;
using testing_support::memory_tells;
using testing_support::Process;

TEST(Disk, ThatIsFullWhenAllIsWrittenLeavesNoOutputAndTheOldOne) {
  if (!memory_tells) GTEST_SKIP() << "a sanitizer must be the first library there is";
  const Folder folder;
  const std::string program = folder.write("part.nc", std::string(server::g239_program));
  const std::string output = folder.write("out.nc", "as before\n");
  Process trc({testing_support::trc_program(), "compensate", program, "-o", output}, 0,
              {"LD_PRELOAD=" FULL_DISK_LIBRARY});
  EXPECT_EQ(trc.wait(), 2);
  EXPECT_EQ(trc.err(), "trc: cannot write " + output + ": No space left on device\n");
  EXPECT_EQ(content_of(output), "as before\n");
  EXPECT_EQ(folder.names().size(), 2U);
}

// Asked once for all of them.
TEST(Disk, ThatIsFullWhenAFolderIsWrittenIsTold) {
  if (!memory_tells) GTEST_SKIP() << "a sanitizer must be the first library there is";
  const Folder folder;
  const std::string program = folder.write("part.nc", std::string(server::g239_program));
  const std::string directory = folder.path("out");
  Process trc({testing_support::trc_program(), "compensate", program, "--output-dir", directory}, 0,
              {"LD_PRELOAD=" FULL_DISK_LIBRARY});
  EXPECT_EQ(trc.wait(), 2);
  EXPECT_EQ(trc.err(), "trc: cannot write " + directory + ": No space left on device\n");
}

// The shell has opened the file.
TEST(Disk, ThatIsFullIsToldOfStandardOutputToo) {
  if (!memory_tells) GTEST_SKIP() << "a sanitizer must be the first library there is";
  const Folder folder;
  const std::string program = folder.write("part.nc", std::string(server::g239_program));
  Process trc({"/bin/sh", "-c",
               "LD_PRELOAD=" FULL_DISK_LIBRARY " exec " + testing_support::trc_program() +
                   " compensate " + program + " >" + folder.path("out.nc")});
  EXPECT_EQ(trc.wait(), 2);
  EXPECT_EQ(trc.err(), "trc: cannot write standard output: No space left on device\n");
}

}  // namespace
}  // namespace trc::faults
