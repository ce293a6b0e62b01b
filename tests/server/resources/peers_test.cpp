#include "server/resources/peers.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/in_process.h"
#include "server/rpc/caller.h"
#include "tests/server/calls.h"
#include "trc/v1/trc_service.grpc.pb.h"

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

// A stream that is open as long as this object, for a client of HTTP.
struct StreamOfHttp {
  StreamOfHttp(v1::TrcService::Stub& stub, const std::string& client) {
    context.AddMetadata(client_of_http, client);
    stream = stub.CompensatePath(&context);
    v1::CompensatePathResponse response;
    accepted = stream->Write(setup_request(v1::PathSetup())) && stream->Read(&response);
  }
  ~StreamOfHttp() {
    context.TryCancel();
    stream->Finish();
  }
  StreamOfHttp(const StreamOfHttp&) = delete;
  StreamOfHttp& operator=(const StreamOfHttp&) = delete;

  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<v1::CompensatePathRequest, v1::CompensatePathResponse>>
      stream;
  bool accepted = false;
};

TEST(Peers, OfHttpAreThoseWhoAsk) {
  Config config = InProcessServer::quiet();
  config.max_streams_per_peer = 1;
  const InProcessServer server(config);
  const auto stub = v1::TrcService::NewStub(server.channel());
  const StreamOfHttp one(*stub, "192.0.2.7");
  EXPECT_TRUE(one.accepted);
  EXPECT_FALSE(StreamOfHttp(*stub, "192.0.2.7").accepted);
  EXPECT_TRUE(StreamOfHttp(*stub, "192.0.2.8").accepted);
}

}  // namespace
}  // namespace trc::server
