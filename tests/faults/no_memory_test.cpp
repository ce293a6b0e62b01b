// Want of memory in the built server. On a machine that has other work its threads are more, and so
// is what they take: alone.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <string>
#include <vector>

#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using server::Answer;
using server::eventually;
using testing_support::ServerProcess;

// AddressSanitizer has an address space of its own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Hostile, StreamForWhichThereIsNoMemoryEndsAlone) {
  // More than the threads take that a busy machine makes.
  constexpr double room_mib = 256;
  const ServerProcess server;
  ASSERT_TRUE(serves(server.address()));
  const auto most = static_cast<rlim_t>((server.address_space_mib() + room_mib) * (1 << 20));
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
    const Answer answer = server::call_program(channel_to(server.address()), requests);
    EXPECT_FALSE(answer.status.ok());
    EXPECT_TRUE(eventually([&] { return serves(server.address()); }))
        << server.threads() << " threads, " << server.address_space_mib()
        << " MiB of address space\n"
        << server.log() << server.errors();
  }
}
#endif

}  // namespace
}  // namespace trc::faults
