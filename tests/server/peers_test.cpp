#include "server/resources/peers.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace trc::server {
namespace {

TEST(Peers, AreTheSameAsLongAsSomebodyHoldsThem) {
  Peers peers(100);
  auto mill = peers.of("mill");
  EXPECT_EQ(peers.of("mill"), mill);
  EXPECT_NE(peers.of("lathe"), mill);
  EXPECT_EQ(peers.count(), 1U);
  EXPECT_EQ(mill->memory.most_bytes(), 100U);
  mill.reset();
  EXPECT_EQ(peers.count(), 0U);
}

TEST(Peers, CountTheirStreams) {
  Peers peers(100);
  const auto mill = peers.of("mill");
  {
    Peer::Place first(*mill);
    const Peer::Place second(std::move(first));
    const Peer::Place third(*mill);
    EXPECT_EQ(mill->streams(), 2U);
  }
  EXPECT_EQ(mill->streams(), 0U);
}

TEST(Peers, ComeAndGoInManyThreads) {
  Peers peers(100);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int round = 0; round < 5000; ++round) {
        const auto peer = peers.of(round % 2 == 0 ? "even" : "odd");
        const Peer::Place place(*peer);
        EXPECT_GE(peer->streams(), 1U);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(peers.count(), 0U);
}

TEST(Peers, AreNamedByTheirAddress) {
  EXPECT_EQ(peer_of_address("ipv4:192.0.2.7:40000"), "192.0.2.7");
  EXPECT_EQ(peer_of_address("ipv6:[::1]:40000"), "::/64");
  EXPECT_EQ(peer_of_address("ipv6:%5B2001:db8:1:2:3:4:5:6%5D:40000"), "2001:db8:1:2::/64");
  EXPECT_EQ(peer_of_address("ipv6:[2001:db8:1:2:ffff::9]:1"), "2001:db8:1:2::/64");
  EXPECT_EQ(peer_of_address("ipv6:[fe80::1%25eth0]:1"), "fe80::/64");
  EXPECT_EQ(peer_of_address("ipv6:[::ffff:192.0.2.7]:1"), "192.0.2.7");
  EXPECT_EQ(peer_of_address("unix:/run/trcd.sock"), "unix");
  EXPECT_EQ(peer_of_address("inproc"), "inproc");
  EXPECT_EQ(peer_of_address(""), "");
}

}  // namespace
}  // namespace trc::server
