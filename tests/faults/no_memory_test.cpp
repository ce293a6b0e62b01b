// Want of memory in the built server. It asks for all there is, so it has the machine alone.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::eventually;
using server::StreamAnswer;
using testing_support::ServerProcess;

// AddressSanitizer has an address space of its own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// How much more than at its start the server may take, in MiB.
class Hostile : public testing::TestWithParam<int> {};

TEST_P(Hostile, StreamForWhichThereIsNoMemoryEndsAlone) {
  ServerProcess server;
  ASSERT_TRUE(serves(server.address()));
  const auto most = static_cast<rlim_t>((server.address_space_mib() + GetParam()) * (1 << 20));
  const rlimit limit{most, most};
  ASSERT_EQ(prlimit(server.id(), RLIMIT_AS, &limit, nullptr), 0);
  // Under G141 a selection is held back as a whole.
  std::string text = "G141\nN5 G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800\n";
  for (int i = 0; i < 20'000; ++i)
    text += "X" + std::to_string(i) + " Y" + std::to_string(i % 2) + "\n";
  for (int round = 0; round < 4; ++round) {
    std::vector<v1::CompensateProgramRequest> requests{server::setup_request(v1::ProgramSetup())};
    for (std::uint64_t i = 0; i < 60; ++i)
      requests.push_back(server::text_request(i * text.size(), text, false));
    const StreamAnswer answer = server::call_program(channel_to(server.address()), requests);
    EXPECT_FALSE(answer.status.ok());
    EXPECT_TRUE(eventually([&] { return serves(server.address()); }))
        << server.threads() << " threads, " << server.address_space_mib()
        << " MiB of address space\n"
        << server.log() << server.errors();
  }
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0) << server.log() << server.errors();
}

// From room for what a stream holds down to less than a thread's stack.
INSTANTIATE_TEST_SUITE_P(Room, Hostile, testing::Values(256, 64, 16, 6));
#endif

}  // namespace
}  // namespace trc::faults
