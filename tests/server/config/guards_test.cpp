#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/server/config/configs.h"

// Settings that keep strangers out: none of them is missing in silence.
namespace trc::server {
namespace {

using configs::Environment;
using configs::expect_fault;
using configs::read;
using configs::TextFile;

TEST(ConfigGuards, HealthInPlainTextStaysOnThisMachineUnlessAllowed) {
  expect_fault(read({"--health-listen=0.0.0.0:50052"}), {"health-listen", "insecure-health"});
  expect_fault(read({"--health-listen=nowhere"}), {"health-listen"});
  EXPECT_FALSE(read({"--health-listen=127.0.0.1:50052"}).exit.has_value());
  EXPECT_FALSE(read({"--health-listen=0.0.0.0:50052", "--insecure-health"}).exit.has_value());
  EXPECT_FALSE(read({"--health-listen=0.0.0.0:50052", "--insecure"}).exit.has_value());
  // It opens no other port.
  expect_fault(read({"--listen=0.0.0.0:50051", "--insecure-health"}), {"listen", "insecure"});
}

TEST(ConfigGuards, HttpInPlainTextStaysOnThisMachineUnlessAllowed) {
  EXPECT_TRUE(read({}).config.http_listen.empty());
  expect_fault(read({"--http-listen=0.0.0.0:8080"}), {"http-listen", "insecure-http"});
  expect_fault(read({"--http-listen=nowhere"}), {"http-listen"});
  // What allows it for gRPC does not for HTTP.
  expect_fault(read({"--http-listen=0.0.0.0:8080", "--insecure"}), {"insecure-http"});
  EXPECT_FALSE(read({"--http-listen=127.0.0.1:8080"}).exit.has_value());
  EXPECT_FALSE(read({"--http-listen=0.0.0.0:8080", "--insecure-http"}).exit.has_value());
  expect_fault(read({"--http-listen=127.0.0.1:8080", "--http-cors-origins=mes.example"}),
               {"http-cors-origins", "https://"});
}

TEST(ConfigGuards, AdminInPlainTextStaysOnThisMachineUnlessAllowed) {
  for (const char* address : {"--admin-listen=0.0.0.0:9464", "--admin-listen=[::]:9464"})
    expect_fault(read({address}), {"admin-listen", "insecure-admin"});
  EXPECT_FALSE(read({"--admin-listen=127.0.0.1:9464"}).exit.has_value());
  EXPECT_FALSE(read({"--admin-listen=0.0.0.0:9464", "--insecure-admin"}).exit.has_value());
  EXPECT_FALSE(read({"--admin-listen=0.0.0.0:9464", "--insecure"}).exit.has_value());
  // It opens no other port.
  expect_fault(read({"--listen=0.0.0.0:50051", "--insecure-admin"}), {"listen", "insecure"});
  expect_fault(read({"--health-listen=0.0.0.0:50052", "--insecure-admin"}), {"health-listen"});
}

TEST(ConfigGuards, ReflectionIsForThisMachineUnlessAskedFor) {
  EXPECT_TRUE(read({"--listen=127.0.0.1:0,unix:/run/trcd.sock"}).config.reflection);
  EXPECT_FALSE(read({"--listen=127.0.0.1:0,0.0.0.0:50051", "--insecure"}).config.reflection);
  EXPECT_TRUE(read({"--listen=0.0.0.0:50051", "--insecure", "--reflection"}).config.reflection);
  EXPECT_FALSE(read({"--reflection=false"}).config.reflection);
  const CommandLine printed = read({"--print-config", "--listen=0.0.0.0:50051", "--insecure"});
  EXPECT_NE(printed.exit->text.find("reflection=false"), std::string::npos) << printed.exit->text;
  const Environment asked("TRCD_REFLECTION", "true");
  EXPECT_TRUE(read({"--listen=0.0.0.0:50051", "--insecure"}).config.reflection);
}

TEST(ConfigGuards, TrustedProxiesAreAddressesOrNetworks) {
  for (const char* none : {"proxy", "10.0.0.5:50051", "10.0.0.0/33", "10.0.0/8", "fd00::/", "/8"}) {
    const std::string flag = std::string("--trusted-proxies=") + none;
    expect_fault(read({flag.c_str()}), {"trusted-proxies", none, "10.0.0.0/8"});
  }
  EXPECT_FALSE(read({"--trusted-proxies=0.0.0.0/0,::/0,10.0.0.5,fd00::5"}).exit.has_value());
}

TEST(ConfigGuards, EmptyGuardOfTheEnvironmentIsAFault) {
  for (const char* name : {"TRCD_TLS_ALLOWED_CLIENTS", "TRCD_TLS_CLIENT_CA_FILE",
                           "TRCD_TLS_CERT_FILE", "TRCD_TLS_KEY_FILE"}) {
    const Environment empty(name, "");
    expect_fault(read({}), {name, "empty"});
  }
}

TEST(ConfigGuards, EmptyGuardOfTheCommandLineIsAFault) {
  expect_fault(read({"--tls-allowed-clients="}), {"tls-allowed-clients", "empty"});
  expect_fault(read({"--tls-allowed-clients", ""}), {"tls-allowed-clients", "empty"});
  for (const char* nobody : {"--tls-allowed-clients=,", "--tls-allowed-clients=[]",
                             "--tls-allowed-clients= , ", "--tls-allowed-clients={}"})
    expect_fault(read({nobody}), {"tls-allowed-clients", "empty"});
  expect_fault(read({"--tls-allowed-clients", ","}), {"tls-allowed-clients", "empty"});
  {
    const Environment commas("TRCD_TLS_ALLOWED_CLIENTS", ",");
    expect_fault(read({}), {"TRCD_TLS_ALLOWED_CLIENTS", "empty"});
  }
  expect_fault(read({"--tls-client-ca-file", ""}), {"tls-client-ca-file", "empty"});
}

// Who writes a list of nobody does not mean everybody.
TEST(ConfigGuards, EmptyGuardOfAFileIsAFault) {
  const TextFile pem("PEM", ".pem");
  for (const bool yaml : {false, true}) {
    const std::string is = yaml ? ": " : " = ";
    std::string files;
    for (const char* name : {"tls-cert-file", "tls-key-file", "tls-client-ca-file"})
      files += name + is + '"' + pem.path() + "\"\n";
    for (const char* nobody : {"[]", "[ ]", "\"[]\"", "\"\"", "\" , \"", "\"{}\""}) {
      const TextFile file(files + "tls-allowed-clients" + is + nobody + "\n",
                          yaml ? ".yaml" : ".toml");
      expect_fault(read({"--config", file.path().c_str()}),
                   {"line 4", "tls-allowed-clients", "empty"});
    }
    for (const char* guard : {"tls-cert-file", "tls-key-file", "tls-client-ca-file"}) {
      const TextFile file(guard + is + "\"\"\n", yaml ? ".yaml" : ".toml");
      expect_fault(read({"--config", file.path().c_str()}), {"line 1", guard, "empty"});
    }
  }
  // A guard that is not set does not come back from what was printed as one that stands empty.
  const std::string printed = read({"--print-config"}).exit->text;
  EXPECT_NE(printed.find("\n# tls-allowed-clients=[]\n"), std::string::npos) << printed;
}

TEST(ConfigGuards, NullOfAYamlListIsNoName) {
  for (const char* list :
       {" [~]", " [null]", " [press7,,]", " [press7, !!null '']", "\n-\n", "\n- press7\n- Null"}) {
    const TextFile file(std::string("tls-allowed-clients:") + list + "\n", ".yaml");
    expect_fault(read({"--config", file.path().c_str()}),
                 {"line 1", "tls-allowed-clients", "empty entry"});
  }
}

// They are compared letter by letter with what a browser sends.
TEST(ConfigGuards, OriginsThatNoBrowserSendsAreRefused) {
  for (const auto& [origin, write] : std::vector<std::pair<std::string, std::string>>{
           {"https://mes.example/", "write https://mes.example"},
           {"https://mes.example/page?a=1", "write https://mes.example"},
           {"HTTPS://Mes.Example", "write https://mes.example"},
           {"mes.example:8443", "write https://mes.example:8443"},
           {"https://mes.example:443", "write https://mes.example"},
           {"http://mes.example:80", "write http://mes.example"},
           {"http://mes.example:99999", "http-cors-origins"},
           {"http://mes.example:08080", "http-cors-origins"},
           {"http://mes.example:", "http-cors-origins"},
           {"ftp://mes.example", "http-cors-origins"},
           {"https://", "http-cors-origins"},
           {"https://a b", "http-cors-origins"},
           {"https://me@mes.example", "http-cors-origins"},
           {"null", "as browsers send it"},
           {"*", "as in https://mes.example"}})
    expect_fault(read({("--http-cors-origins=" + origin).c_str()}),
                 {"http-cors-origins", "'" + origin + "'", write});
  for (const char* origin : {"https://mes.example", "http://mes.example:8080",
                             "https://[2001:db8::1]:8443", "http://127.0.0.1:443", "https://[::1]"})
    EXPECT_FALSE(read({("--http-cors-origins=" + std::string(origin)).c_str()}).exit) << origin;
}

TEST(ConfigGuards, AllowedClientsNeedTheirAuthority) {
  expect_fault(read({"--tls-allowed-clients=mill"}), {"tls-allowed-clients", "tls-client-ca-file"});
}

TEST(ConfigGuards, PlainTextStaysOnThisMachineUnlessAllowed) {
  expect_fault(read({"--listen=0.0.0.0:50051"}), {"0.0.0.0:50051", "tls-cert-file", "insecure"});
  expect_fault(read({"--listen=[::]:50051"}), {"[::]:50051"});
  expect_fault(read({"--listen=127.example.org:50051"}), {"127.example.org"});
  EXPECT_FALSE(read({"--listen=0.0.0.0:50051", "--insecure"}).exit.has_value());
  EXPECT_FALSE(read({"--listen=[::1]:50051"}).exit.has_value());
  EXPECT_FALSE(read({"--listen=localhost:50051"}).exit.has_value());
  EXPECT_FALSE(read({"--listen=unix:/run/trcd.sock"}).exit.has_value());
}

TEST(ConfigGuards, TlsFilesComeTogetherAndCanBeRead) {
  expect_fault(read({"--tls-cert-file=/etc/hostname"}), {"tls-cert-file", "tls-key-file"});
  expect_fault(read({"--tls-client-ca-file=/etc/hostname"}), {"tls-client-ca-file"});
  expect_fault(read({"--tls-cert-file=/nonexistent", "--tls-key-file=/nonexistent"}),
               {"tls-cert-file", "/nonexistent"});
}

}  // namespace
}  // namespace trc::server
