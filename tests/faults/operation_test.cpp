// The built server as those who run it see it: certificates, signals, probes, systemd, metrics.

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "grpc/health/v1/health.grpc.pb.h"
#include "tests/faults/raw_connection.h"
#include "tests/faults/service_manager.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::operation {
namespace {

using server::eventually;
using server::StreamAnswer;
using std::chrono::seconds;
using testing_support::content_of;
using testing_support::Folder;
using testing_support::http_answer;
using testing_support::http_get;
using testing_support::ServerProcess;

// A certificate that is its own authority, made for one test.
struct MadeCertificate {
  MadeCertificate(const Folder& folder, const std::string& name,
                  const std::string& alternative_names = "IP:127.0.0.1,DNS:localhost",
                  const std::vector<std::string>& kind_of_key = {"ec", "-pkeyopt",
                                                                 "ec_paramgen_curve:P-256"}) {
    const std::string cert_file = folder.path(name + ".pem");
    const std::string key_file = folder.path(name + ".key");
    std::vector<std::string> command{"/usr/bin/openssl", "req", "-x509", "-newkey"};
    command.insert(command.end(), kind_of_key.begin(), kind_of_key.end());
    command.insert(command.end(),
                   {"-nodes", "-days", "2", "-subj", "/CN=" + name, "-addext",
                    "subjectAltName=" + alternative_names, "-keyout", key_file, "-out", cert_file});
    const auto made = testing_support::run(command);
    EXPECT_EQ(made.code, 0) << made.err;
    cert = content_of(cert_file);
    key = content_of(key_file);
  }
  std::string cert;
  std::string key;
};

std::shared_ptr<grpc::Channel> secure_channel(const std::string& address,
                                              const grpc::SslCredentialsOptions& files) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::SslCredentials(files), arguments);
}

StreamAnswer call(const std::shared_ptr<grpc::Channel>& channel) {
  return server::run_program(channel, {}, server::g239_program);
}

// A certificate another one has signed, with the dates it is good on.
std::string signed_certificate(const Folder& folder, const std::string& name,
                               const std::string& authority, const std::string& begin,
                               const std::string& end) {
  const auto command = [](const std::vector<std::string>& words) {
    const auto made = testing_support::run(words);
    EXPECT_EQ(made.code, 0) << made.err;
  };
  const std::string request = folder.path(name + ".csr");
  const std::string cert = folder.path(name + ".pem");
  command({"/usr/bin/openssl", "req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
           "-nodes", "-subj", "/CN=" + name, "-keyout", folder.path(name + ".key"), "-out",
           request});
  folder.write("index.txt", "");
  const std::string config = folder.write(
      "ca.cnf", "[ca]\ndefault_ca=x\n[x]\ndatabase=" + folder.path("index.txt") +
                    "\nnew_certs_dir=" + folder.path("") +
                    "\nrand_serial=yes\ndefault_md=sha256\npolicy=p\nx509_extensions=e\n[p]\n"
                    "commonName=supplied\n[e]\nsubjectAltName=IP:127.0.0.1\n");
  command({"/usr/bin/openssl", "ca", "-batch", "-notext", "-config", config, "-in", request,
           "-cert", folder.path(authority + ".pem"), "-keyfile", folder.path(authority + ".key"),
           "-startdate", begin, "-enddate", end, "-out", cert});
  return content_of(cert);
}

// The pair of files the server reads, replaced as one would on a running machine.
struct Pair {
  explicit Pair(const Folder& folder) : folder_(folder) {}
  void put(const std::string& cert, const std::string& key) const {
    for (const auto& [name, content] : {std::pair{"cert.pem", cert}, {"key.pem", key}}) {
      folder_.write(std::string(name) + ".new", content);
      std::filesystem::rename(folder_.path(std::string(name) + ".new"), folder_.path(name));
    }
  }
  [[nodiscard]] std::vector<std::string> flags() const {
    return {"--tls-cert-file", folder_.path("cert.pem"),
            "--tls-key-file",  folder_.path("key.pem"),
            "--tls-refresh-s", "3600",
            "--admin-listen",  "127.0.0.1:0"};
  }
  const Folder& folder_;
};

bool has_line(const ServerProcess& server, const std::string& part) {
  return server.log().find(part) != std::string::npos;
}

TEST(Certificates, RotateUnderLoadWithoutAFailedStream) {
  const Folder folder;
  const MadeCertificate first(folder, "first");
  const MadeCertificate second(folder, "second");
  const Pair pair(folder);
  pair.put(first.cert, first.key);
  ServerProcess server(pair.flags());
  grpc::SslCredentialsOptions both;
  both.pem_root_certs = first.cert + second.cert;

  std::atomic<bool> done = false;
  std::atomic<int> good = 0;
  std::atomic<int> bad = 0;
  std::vector<std::thread> load;
  for (int i = 0; i < 2; ++i) {
    load.emplace_back([&] {
      while (!done) ++(call(secure_channel(server.address(), both)).status.ok() ? good : bad);
    });
  }
  const auto wait_for = [&](int more) {
    const int until = good + more;
    return eventually([&] { return good >= until; });
  };
  EXPECT_TRUE(wait_for(3));
  for (int round = 0; round < 4; ++round) {
    const MadeCertificate& next = round % 2 == 0 ? second : first;
    pair.put(next.cert, next.key);
    server.signal(SIGHUP);
    // Of two signals in a row there may be one.
    const std::string taken =
        "trc_tls_certificate_reloads_total{result=\"taken\"} " + std::to_string(round + 1);
    EXPECT_TRUE(eventually(
        [&] { return http_get(server.admin(), "/metrics").find(taken) != std::string::npos; }));
    EXPECT_TRUE(wait_for(3));
  }
  done = true;
  for (std::thread& thread : load) thread.join();
  EXPECT_EQ(bad, 0);

  // The last certificate counts: a client that trusts the one before is turned away.
  grpc::SslCredentialsOptions old;
  old.pem_root_certs = second.cert;
  EXPECT_EQ(call(secure_channel(server.address(), old)).status.error_code(), grpc::UNAVAILABLE);
}

TEST(Certificates, PairThatDoesNotMatchLeavesTheOldOne) {
  const Folder folder;
  const MadeCertificate first(folder, "first");
  const MadeCertificate second(folder, "second");
  const Pair pair(folder);
  pair.put(first.cert, first.key);
  ServerProcess server(pair.flags());
  grpc::SslCredentialsOptions trusting;
  trusting.pem_root_certs = first.cert;

  int refusals = 0;
  for (const auto& [cert, key] : {std::pair{second.cert, first.key},
                                  {std::string("no certificate"), first.key},
                                  {first.cert, std::string()}}) {
    pair.put(cert, key);
    server.signal(SIGHUP);
    ++refusals;
    EXPECT_TRUE(eventually([&] {
      return http_get(server.admin(), "/metrics")
                 .find("trc_tls_certificate_reloads_total{result=\"refused\"} " +
                       std::to_string(refusals)) != std::string::npos;
    }));
    EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
  }
  EXPECT_TRUE(has_line(server, "\"certificate_refused\""));
  // In the words of the start.
  ASSERT_EQ(std::remove(folder.path("key.pem").c_str()), 0);
  server.signal(SIGHUP);
  EXPECT_TRUE(eventually([&] {
    return has_line(server, "tls-key-file: cannot read '" + folder.path("key.pem") +
                                "': No such file or directory");
  }));
  // No secret has reached the log.
  EXPECT_EQ(server.log().find("PRIVATE"), std::string::npos);
}

TEST(Certificates, ThatWouldBreakNewConnectionsLeaveTheOldOne) {
  const Folder folder;
  const MadeCertificate first(folder, "first");
  const MadeCertificate second(folder, "second");
  const std::string expired =
      signed_certificate(folder, "expired", "second", "20200101000000Z", "20200201000000Z");
  const std::string expired_key = content_of(folder.path("expired.key"));
  const std::string later =
      signed_certificate(folder, "later", "second", "20990101000000Z", "20990201000000Z");
  const std::string later_key = content_of(folder.path("later.key"));
  const std::string good =
      signed_certificate(folder, "good", "second", "20200101000000Z", "20990201000000Z");
  const std::string good_key = content_of(folder.path("good.key"));
  const Pair pair(folder);
  pair.put(first.cert, first.key);
  ServerProcess server(pair.flags());
  grpc::SslCredentialsOptions trusting;
  trusting.pem_root_certs = first.cert + second.cert;

  const std::string torn = second.cert.substr(0, second.cert.size() / 2);
  struct Case {
    std::string cert;
    std::string key;
    std::string reason;
  };
  for (const auto& [cert, key, reason] :
       {Case{expired, expired_key, "has expired on 2020-02-01T00:00:00Z"},
        Case{later, later_key, "is not good before 2099-01-01T00:00:00Z"},
        Case{good + expired, good_key, "has not signed the one before it"},
        Case{good + torn, good_key, "holds a block that is no certificate, number 2"}}) {
    SCOPED_TRACE(reason);
    pair.put(cert, key);
    server.signal(SIGHUP);
    EXPECT_TRUE(eventually([&server, &line = reason] { return has_line(server, line); }));
    EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
  }
  EXPECT_NE(http_get(server.admin(), "/metrics")
                .find("trc_tls_certificate_reloads_total{result=\"refused\"} 4"),
            std::string::npos);
  pair.put(good + second.cert, good_key);
  server.signal(SIGHUP);
  EXPECT_TRUE(eventually([&] { return has_line(server, "certificate_taken"); }));
  EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
}

// gRPC takes such a pair, and then nobody gets in.
TEST(Certificates, ThatNoClientCouldConnectToAreRefused) {
  const Folder folder;
  const MadeCertificate good(folder, "good");
  const MadeCertificate weak(folder, "weak", "IP:127.0.0.1", {"rsa:1024"});
  const MadeCertificate curve(folder, "curve", "IP:127.0.0.1",
                              {"ec", "-pkeyopt", "ec_paramgen_curve:secp256k1"});
  const MadeCertificate of_clients(folder, "of_clients", "IP:127.0.0.1",
                                   {"rsa:2048", "-addext", "extendedKeyUsage=clientAuth"});
  const MadeCertificate authority(folder, "authority", "IP:127.0.0.1",
                                  {"rsa:2048", "-addext", "keyUsage=critical,keyCertSign"});
  const Pair pair(folder);
  pair.put(good.cert, good.key);
  ServerProcess server(pair.flags());
  grpc::SslCredentialsOptions trusting;
  trusting.pem_root_certs = good.cert;
  for (const MadeCertificate& bad : {weak, curve, of_clients, authority}) {
    pair.put(bad.cert, bad.key);
    std::vector<std::string> command{testing_support::trcd_program()};
    for (const std::string& flag : pair.flags()) command.push_back(flag);
    const auto ended = testing_support::run(command);
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("no client could connect"), std::string::npos) << ended.err;
    server.signal(SIGHUP);
    EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
  }
  EXPECT_TRUE(eventually([&] { return has_line(server, "no client could connect"); }));
  EXPECT_TRUE(eventually([&] { return has_line(server, "certificate purpose"); }));
  EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
}

TEST(Certificates, AuthoritiesThatHaveAllExpiredAreRefused) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const std::string expired =
      signed_certificate(folder, "expired", "own", "20200101000000Z", "20200201000000Z");
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  std::vector<std::string> command{testing_support::trcd_program()};
  for (const std::string& flag : pair.flags()) command.push_back(flag);
  command.insert(command.end(), {"--tls-client-ca-file", folder.write("clients.pem", expired)});
  const auto ended = testing_support::run(command);
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("clients.pem' have expired"), std::string::npos) << ended.err;
  // Of two that overlap one may be.
  folder.write("clients.pem", expired + own.cert);
  std::vector<std::string> flags = pair.flags();
  flags.insert(flags.end(), {"--tls-client-ca-file", folder.path("clients.pem")});
  const ServerProcess server(flags);
}

// The server would take them and turn away everybody they have signed for.
TEST(Certificates, AuthoritiesThatLetNobodyInAreRefused) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const MadeCertificate weak(folder, "weak", "IP:127.0.0.1", {"rsa:1024"});
  const MadeCertificate of_servers(folder, "of_servers", "IP:127.0.0.1",
                                   {"rsa:2048", "-addext", "extendedKeyUsage=serverAuth"});
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  std::vector<std::string> command{testing_support::trcd_program()};
  for (const std::string& flag : pair.flags()) command.push_back(flag);
  command.insert(command.end(), {"--tls-client-ca-file", folder.path("clients.pem")});
  for (const auto& [bad, why] : {std::pair{weak, "is too weak (1024 bits)"},
                                 std::pair{of_servers, "is not meant to vouch for clients"}}) {
    folder.write("clients.pem", own.cert + bad.cert);
    const auto ended = testing_support::run(command);
    EXPECT_EQ(ended.code, 2);
    for (const std::string& part :
         {"certificate 2 of '" + folder.path("clients.pem"), std::string(why)})
      EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  }
}

TEST(Certificates, AuthoritiesAreReadToTheLastOne) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  std::vector<std::string> command{testing_support::trcd_program()};
  for (const std::string& flag : pair.flags()) command.push_back(flag);
  command.insert(command.end(),
                 {"--tls-client-ca-file",
                  folder.write("clients.pem", own.cert + "-----BEGIN CERTIFICATE-----\nAAAA\n"
                                                         "-----END CERTIFICATE-----\n")});
  const auto ended = testing_support::run(command);
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("clients.pem' holds a block that is no certificate, number 2"),
            std::string::npos)
      << ended.err;
}

// Who begins and says no more keeps a descriptor.
TEST(Certificates, HandshakesThatStandStillAreEnded) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  std::vector<std::string> flags = pair.flags();
  flags.insert(flags.end(), {"--keepalive-time-s", "1", "--keepalive-timeout-s", "2"});
  const ServerProcess server(flags);
  // The head of a ClientHello whose rest never comes.
  const std::string half("\x16\x03\x01\x02\x00\x01\x00\x01\xFC\x03\x03", 11);
  std::vector<std::unique_ptr<faults::RawConnection>> silent;
  for (int i = 0; i < 20; ++i) {
    silent.push_back(std::make_unique<faults::RawConnection>(server.address(), "127.0.0.2"));
    silent.back()->send_bytes(std::string_view(half).substr(0, i % 2 == 0 ? 0 : half.size()));
  }
  grpc::SslCredentialsOptions trusting;
  trusting.pem_root_certs = own.cert;
  EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
  EXPECT_TRUE(eventually([&] {
    return std::none_of(silent.begin(), silent.end(),
                        [](const auto& connection) { return connection->is_open(); });
  }));
  EXPECT_TRUE(call(secure_channel(server.address(), trusting)).status.ok());
}

TEST(Certificates, ExpiryIsAMetric) {
  const Folder folder;
  const MadeCertificate first(folder, "first");
  const Pair pair(folder);
  pair.put(first.cert, first.key);
  const ServerProcess server(pair.flags());
  const std::string metrics = http_get(server.admin(), "/metrics");
  const std::string name = "\ntrc_tls_certificate_expiry_timestamp_seconds ";
  const std::size_t at = metrics.find(name);
  ASSERT_NE(at, std::string::npos);
  const double left =
      std::stod(metrics.substr(at + name.size())) - static_cast<double>(std::time(nullptr));
  EXPECT_GT(left, 1.5 * 86400);
  EXPECT_LT(left, 2.5 * 86400);
}

TEST(Certificates, OnlyNamedClientsAreServed) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const MadeCertificate mill(folder, "mill-7");
  const MadeCertificate other(folder, "other");
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  std::vector<std::string> flags = pair.flags();
  for (const std::string& flag :
       {std::string("--tls-client-ca-file"), folder.write("clients.pem", mill.cert + other.cert),
        std::string("--tls-allowed-clients"), std::string("mill-7,mill-8")})
    flags.push_back(flag);
  const ServerProcess server(flags);
  const auto as = [&](const MadeCertificate& client) {
    grpc::SslCredentialsOptions files;
    files.pem_root_certs = own.cert;
    files.pem_cert_chain = client.cert;
    files.pem_private_key = client.key;
    return secure_channel(server.address(), files);
  };
  EXPECT_TRUE(call(as(mill)).status.ok());
  const StreamAnswer refused = call(as(other));
  EXPECT_EQ(refused.status.error_code(), grpc::PERMISSION_DENIED);
  EXPECT_EQ(refused.reason(), "CLIENT_NOT_ALLOWED");
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  EXPECT_EQ(v1::TrcService::NewStub(as(other))->GetServerInfo(&context, {}, &info).error_code(),
            grpc::PERMISSION_DENIED);
}

// A URI may read like the name of somebody else's machine.
TEST(Certificates, NameThatIsAUriIsNoName) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const MadeCertificate plain(folder, "stranger", "URI:mill-7");
  const MadeCertificate named(folder, "another", "URI:spiffe://plant/mill-7");
  const MadeCertificate host(folder, "third", "DNS:mill-7");
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  const auto served = [&](const MadeCertificate& client, const std::string& allowed) {
    std::vector<std::string> flags = pair.flags();
    flags.insert(flags.end(), {"--tls-client-ca-file", folder.write("clients.pem", client.cert),
                               "--tls-allowed-clients", allowed});
    const ServerProcess server(flags);
    grpc::SslCredentialsOptions files;
    files.pem_root_certs = own.cert;
    files.pem_cert_chain = client.cert;
    files.pem_private_key = client.key;
    return call(secure_channel(server.address(), files)).status.error_code();
  };
  EXPECT_EQ(served(plain, "mill-7"), grpc::PERMISSION_DENIED);
  EXPECT_EQ(served(named, "mill-7"), grpc::PERMISSION_DENIED);
  EXPECT_EQ(served(named, "spiffe://plant/mill-7"), grpc::OK);
  EXPECT_EQ(served(host, "mill-7"), grpc::OK);
}

TEST(Certificates, ThatCannotBeUsedIsSaidBeforeAPortOpens) {
  const Folder folder;
  const MadeCertificate first(folder, "first");
  const MadeCertificate second(folder, "second");
  const Pair pair(folder);
  pair.put(first.cert, second.key);
  std::vector<std::string> command{testing_support::trcd_program()};
  for (const std::string& flag : pair.flags()) command.push_back(flag);
  const auto ended = testing_support::run(command);
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("does not belong to"), std::string::npos) << ended.err;
}

std::string health_of(const std::string& address, const std::string& service = "") {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + seconds(20));
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(service);
  grpc::health::v1::HealthCheckResponse response;
  const auto status = grpc::health::v1::Health::NewStub(
                          grpc::CreateChannel(address, grpc::InsecureChannelCredentials()))
                          ->Check(&context, request, &response);
  return status.ok() ? grpc::health::v1::HealthCheckResponse::ServingStatus_Name(response.status())
                     : status.error_message();
}

TEST(Probes, HealthIsServedInPlainTextBesideTls) {
  const Folder folder;
  const MadeCertificate own(folder, "own");
  const Pair pair(folder);
  pair.put(own.cert, own.key);
  std::vector<std::string> flags = pair.flags();
  flags.insert(flags.end(), {"--health-listen", "127.0.0.1:0"});
  const ServerProcess server(flags);
  EXPECT_EQ(health_of(server.health()), "SERVING");
  // The port of health serves nothing else.
  const StreamAnswer answer =
      call(grpc::CreateChannel(server.health(), grpc::InsecureChannelCredentials()));
  EXPECT_EQ(answer.status.error_code(), grpc::UNIMPLEMENTED);
}

TEST(Probes, HealthOpenToOtherMachinesKeepsTheLimits) {
  const ServerProcess server(
      {"--health-listen", "0.0.0.0:0", "--insecure-health", "--max-message-bytes", "4096"});
  EXPECT_EQ(health_of(server.health()), "SERVING");
  EXPECT_EQ(health_of(server.health(), "trc.v1.TrcService"), "SERVING");
  EXPECT_NE(health_of(server.health(), std::string(5000, 'x')).find("larger than max"),
            std::string::npos);
}

TEST(Probes, HealthAndReadinessFollowTheDrain) {
  ServerProcess server({"--admin-listen", "127.0.0.1:0", "--health-listen", "127.0.0.1:0"});
  EXPECT_EQ(http_get(server.admin(), "/healthz"), "ok\n");
  EXPECT_EQ(http_get(server.admin(), "/readyz"), "ready\n");
  // A stream holds the drain up.
  auto stub = v1::TrcService::NewStub(
      grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  auto stream = stub->CompensatePath(&context);
  v1::CompensatePathResponse response;
  ASSERT_TRUE(stream->Write(server::setup_request(v1::PathSetup())) && stream->Read(&response));
  server.signal(SIGTERM);
  EXPECT_TRUE(eventually([&] { return http_get(server.admin(), "/readyz") == "draining\n"; }));
  EXPECT_EQ(http_get(server.admin(), "/healthz"), "ok\n");
  EXPECT_EQ(health_of(server.health()), "NOT_SERVING");
  context.TryCancel();
  stream->Finish();
  EXPECT_EQ(server.wait(), 0);
}

TEST(Probes, ThoseThatAskForTheHeadAloneAreAnswered) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  for (const char* path : {"/healthz", "/readyz", "/metrics"}) {
    const std::string answer = http_answer(
        server.admin(), "HEAD " + std::string(path) + " HTTP/1.1\r\nHost: trcd\r\n\r\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 ")) << answer;
    EXPECT_TRUE(answer.ends_with("\r\n\r\n")) << answer;
  }
}

TEST(Reload, ChangesTheLogLevelAndNothingElse) {
  const Folder folder;
  const std::string config = folder.write("trcd.yaml", "log-level: info\nmax-streams: 7\n");
  ServerProcess server({"--config", config});
  const auto channel = grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials());
  const auto calls = [&] {
    const std::string log = server.log();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = log.find("\"event\":\"rpc\"", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  ASSERT_TRUE(call(channel).status.ok());
  ASSERT_TRUE(eventually([&] { return calls() == 1; }));

  folder.write("trcd.yaml", "log-level: nonsense\n");
  server.signal(SIGHUP);
  EXPECT_TRUE(eventually([&] { return has_line(server, "\"reload_refused\""); }));

  folder.write("trcd.yaml", "log-level: warning\nmax-streams: 1\n");
  server.signal(SIGHUP);
  EXPECT_TRUE(eventually([&] {
    return has_line(server, "\"event\":\"restart_needed\",\"settings\":\"max-streams\"");
  }));
  // The last line at the old level cannot be waited for, as there is none: the calls show it.
  EXPECT_TRUE(eventually([&] {
    const std::size_t before = calls();
    EXPECT_TRUE(call(channel).status.ok());
    EXPECT_TRUE(call(channel).status.ok());
    return calls() == before;
  }));
}

TEST(ServiceManager, IsToldWhatTheServerDoes) {
  const Folder folder;
  faults::ServiceManager manager(folder.path("notify"));
  ServerProcess server({}, "127.0.0.1:0", 0,
                       {"NOTIFY_SOCKET=" + folder.path("notify"), "WATCHDOG_USEC=400000"});
  EXPECT_TRUE(manager.hears("READY=1"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  server.signal(SIGHUP);
  EXPECT_TRUE(manager.hears("RELOADING=1\nMONOTONIC_USEC="));
  EXPECT_TRUE(manager.hears("READY=1"));
  server.signal(SIGTERM);
  EXPECT_TRUE(manager.hears("STOPPING=1"));
  EXPECT_EQ(server.wait(), 0);
}

TEST(Telemetry, TraceGoesOnInLogAndAnswer) {
  ServerProcess server;
  grpc::ClientContext context;
  const std::string trace = "4bf92f3577b34da6a3ce929d0e0e4736";
  context.AddMetadata("traceparent", "00-" + trace + "-00f067aa0ba902b7-01");
  v1::GetServerInfoResponse info;
  ASSERT_TRUE(v1::TrcService::NewStub(
                  grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()))
                  ->GetServerInfo(&context, {}, &info)
                  .ok());
  const auto found = context.GetServerInitialMetadata().find("trace-id");
  ASSERT_NE(found, context.GetServerInitialMetadata().end());
  EXPECT_EQ(std::string(found->second.data(), found->second.size()), trace);
  EXPECT_TRUE(eventually([&] {
    return has_line(server, "\"trace_id\":\"" + trace + "\"") &&
           has_line(server, "\"parent_id\":\"00f067aa0ba902b7\"");
  }));
}

TEST(Telemetry, MetricsHaveTheirNames) {
  ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  ASSERT_TRUE(
      call(grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials())).status.ok());
  const StreamAnswer refused = server::run_program(
      grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()), {}, "G999\n");
  EXPECT_EQ(refused.status.error_code(), grpc::INVALID_ARGUMENT);
  const std::string page = http_get(server.admin(), "/metrics");
  for (const char* name :
       {"grpc_server_started_total{", "grpc_server_handled_total{",
        "grpc_server_msg_received_total{", "grpc_server_msg_sent_total{",
        "grpc_server_handling_seconds_count{", "trc_batch_seconds_bucket{", "trc_blocks_total{",
        "trc_streams_active ", "trc_pool_queue_depth ", "trc_errors_total{",
        "trc_session_memory_bytes ", "trc_connections_accepted_total ",
        "trc_connections_refused_total ", "trc_build_info{"})
    EXPECT_NE(page.find(std::string("\n") + name), std::string::npos) << name;
}

}  // namespace
}  // namespace trc::operation
