#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <string>

#include "server/server.h"
#include "tests/server/calls.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace trc::server {
namespace {

// Certificates of an authority that exists for these tests only.
std::string file(const std::string& name) {
  return testing_support::source_dir() + "/tests/server/certificates/" + name;
}

Config with_tls() {
  Config config;
  config.listen = {"127.0.0.1:0"};
  config.log_level = "off";
  config.tls_cert_file = file("server_cert.pem");
  config.tls_key_file = file("server_key.pem");
  return config;
}

grpc::StatusCode call(const Server& server, const grpc::SslCredentialsOptions& options) {
  const auto channel = grpc::CreateChannel("127.0.0.1:" + std::to_string(server.ports().front()),
                                           grpc::SslCredentials(options));
  return run_program(channel, {}, g239_program).status.error_code();
}

grpc::SslCredentialsOptions trusting() {
  grpc::SslCredentialsOptions options;
  options.pem_root_certs = testing_support::content_of(file("ca_cert.pem"));
  return options;
}

grpc::SslCredentialsOptions with_certificate() {
  grpc::SslCredentialsOptions options = trusting();
  options.pem_cert_chain = testing_support::content_of(file("client_cert.pem"));
  options.pem_private_key = testing_support::content_of(file("client_key.pem"));
  return options;
}

TEST(Tls, ClientThatTrustsTheAuthorityIsServed) {
  const auto started = Server::start(with_tls());
  ASSERT_NE(started.server, nullptr) << started.fault;
  EXPECT_EQ(call(*started.server, trusting()), grpc::OK);
}

TEST(Tls, PlainTextIsRefused) {
  const auto started = Server::start(with_tls());
  ASSERT_NE(started.server, nullptr) << started.fault;
  const auto channel =
      grpc::CreateChannel("127.0.0.1:" + std::to_string(started.server->ports().front()),
                          grpc::InsecureChannelCredentials());
  EXPECT_EQ(run_program(channel, {}, g239_program).status.error_code(), grpc::UNAVAILABLE);
}

TEST(Tls, ClientCertificateIsDemandedWhereAnAuthorityIsNamed) {
  Config config = with_tls();
  config.tls_client_ca_file = file("ca_cert.pem");
  const auto started = Server::start(config);
  ASSERT_NE(started.server, nullptr) << started.fault;
  EXPECT_EQ(call(*started.server, trusting()), grpc::UNAVAILABLE);
  EXPECT_EQ(call(*started.server, with_certificate()), grpc::OK);
}

}  // namespace
}  // namespace trc::server
