#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/resources/memory_account.h"
#include "tests/client/commands/called.h"
#include "tests/support/places.h"
#include "tests/support/process.h"

namespace trc::testing_support {
namespace {

bool within_seconds(int seconds, const std::function<bool()>& true_now) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (!true_now()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

TEST(Server, GivesTheSameBytesAsTheOwnProcess) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  for (const char* format : {"nc", "listing"}) {
    const Ended own = trc({"compensate", "-", "--format", format}, demo);
    const Ended remote =
        trc({"compensate", "-", "--format", format, "--server", server.address()}, demo);
    EXPECT_EQ(remote.code, 0) << remote.err;
    EXPECT_EQ(remote.out, own.out);
  }
  const Ended refused = trc({"compensate", "-", "--server", server.address()}, violating);
  const Ended own = trc({"compensate", "-"}, violating);
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.err, own.err);
  EXPECT_EQ(refused.out, own.out);
}

TEST(Server, TakesLongPrograms) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  const std::string text = trc({"generate", "--shape", "gear", "--blocks", "50000"}).out;
  const Ended own = trc({"compensate", "-"}, text);
  const Ended remote = trc({"compensate", "-", "--server", server.address()}, text);
  EXPECT_EQ(remote.code, 0) << remote.err;
  EXPECT_GT(remote.out.size(), 50000u * 20);
  EXPECT_TRUE(remote.out == own.out);
}

TEST(Server, IsNamedWhenItCannotBeReached) {
  // Port 1 of the loopback address: nobody listens there.
  for (const char* command : {"compensate", "verify"}) {
    const Ended ended = trc({command, "-", "--server", "127.0.0.1:1"}, demo);
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("127.0.0.1:1"), std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find("gRPC"), std::string::npos);
    EXPECT_EQ(ended.err.find("rpc"), std::string::npos);
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_EQ(trc({"health", "--server", "127.0.0.1:1"}).code, 3);
  EXPECT_EQ(trc({"info", "--server", "127.0.0.1:1"}).code, 3);
}

// Each line stands alone: what gRPC has to say for itself is in it, in plain words.
TEST(Server, ThatCannotBeReachedIsToldApart) {
  const auto said = [](std::vector<std::string> words, int code) {
    words.insert(words.begin(), {"compensate", "-", "--wait", "0"});
    const Ended ended = trc(words, demo);
    EXPECT_EQ(ended.code, code) << ended.err;
    return ended.err;
  };
  const std::string cannot = "trc: cannot reach a server at ";
  EXPECT_EQ(said({"--server", "127.0.0.1:1"}, 3),
            cannot + "127.0.0.1:1: nothing listens there; is trcd running?\n");
  EXPECT_EQ(said({"--server", "http://127.0.0.1:1"}, 2),
            "trc: 'http://127.0.0.1:1' is no address of a gRPC server: write HOST:PORT without "
            "http://\n");

  const auto file = [](const std::string& name) {
    return source_dir() + "/tests/server/certificates/" + name;
  };
  const std::string key = file("client_key.pem");
  const std::string certificate = file("client_cert.pem");
  EXPECT_EQ(said({"--server", "127.0.0.1:1", "--tls-ca", key}, 2),
            "trc: --tls-ca: '" + key + "' holds no certificate\n");
  EXPECT_EQ(said({"--server", "127.0.0.1:1", "--tls-cert", certificate, "--tls-key",
                  file("server_key.pem")},
                 2),
            "trc: --tls-key: '" + file("server_key.pem") + "' does not belong to '" + certificate +
                "'\n");
  EXPECT_EQ(
      said({"--server", "127.0.0.1:1", "--tls-cert", certificate, "--tls-key", certificate}, 2),
      "trc: --tls-key: '" + certificate + "' holds no key without pass phrase\n");

  const ServerProcess server(
      {"--tls-cert-file", file("server_cert.pem"), "--tls-key-file", file("server_key.pem")});
  ASSERT_NE(server.address(), "");
  EXPECT_EQ(said({"--server", server.address(), "--tls-ca", certificate}, 3),
            cannot + server.address() + ": its certificate is not one that --tls-ca vouches for\n");
  EXPECT_EQ(said({"--server", server.address()}, 3).find("closes the connection: with --tls-ca"),
            (cannot + server.address() + ": what listens there ").size());
}

TEST(ExitCode, SaysThatALimitWasMet) {
  const ServerProcess server({"--max-blocks-per-selection", "3"});
  ASSERT_NE(server.address(), "");
  // Loops are removed from the whole, so that the server holds all of it.
  std::string masking = demo;
  masking.insert(masking.find("N40"), "N35 G141\n");
  const Ended ended = trc({"compensate", "-", "--server", server.address()}, masking);
  EXPECT_EQ(ended.code, 4) << ended.err;
  EXPECT_NE(ended.err.find("error"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
}

std::string masked_generated() {
  std::string masking = trc({"generate", "--shape", "meander", "--blocks", "8000"}).out;
  masking.insert(masking.find("\nN40") + 1, "N35 G141\n");
  return masking;
}

TEST(OwnLimits, AreOptionsAndEndWithTheCodeOfLimits) {
  const std::string masking = masked_generated();
  const auto ended = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"compensate", "-"});
    return trc(options, masking);
  };
  EXPECT_EQ(ended({}).code, 0);
  const Ended blocks = ended({"--max-blocks-per-selection", "1000"});
  EXPECT_EQ(blocks.code, 4) << blocks.err;
  EXPECT_NE(blocks.err.find("1000"), std::string::npos) << blocks.err;
  EXPECT_EQ(blocks.out, "");
  if (!server::counts_heap) return;
  const Ended memory = ended({"--max-session-memory-mib", "1"});
  EXPECT_EQ(memory.code, 4) << memory.err;
  EXPECT_NE(memory.err.find("max-session-memory-mib"), std::string::npos) << memory.err;
  EXPECT_EQ(memory.out, "");
}

TEST(OwnLimits, MustFitTogetherAndAreOfNoServer) {
  const Ended sum =
      trc({"compensate", "-", "--memory-limit-mib", "64", "--max-session-memory-mib", "100"}, demo);
  EXPECT_EQ(sum.code, 2);
  EXPECT_NE(sum.err.find("--memory-limit-mib: "), std::string::npos) << sum.err;
  const Ended other =
      trc({"compensate", "-", "--server", "127.0.0.1:1", "--max-blocks-per-selection", "5"}, demo);
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("trc info --server"), std::string::npos) << other.err;
}

// A program that does not end, through a pipe that this object holds open.
class Endless {
 public:
  explicit Endless(const std::string& server)
      : path_(made(folder_)),
        client_({trc_program(), "compensate", path_, "--server", server}),
        // No other program may hold it open.
        text_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)) {
    const std::string begin = demo.substr(0, demo.size() / 2);
    EXPECT_EQ(::write(text_, begin.data(), begin.size()), static_cast<ssize_t>(begin.size()));
  }
  ~Endless() { end(); }
  Endless(const Endless&) = delete;
  Endless& operator=(const Endless&) = delete;

  int end() {
    if (const int text = std::exchange(text_, -1); text >= 0) ::close(text);
    return client_.wait();
  }

 private:
  static std::string made(const Folder& folder) {
    std::string path = folder.path("endless.nc");
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }

  Folder folder_;
  std::string path_;
  Process client_;
  int text_;
};

bool has_one_stream(const ServerProcess& server) {
  return within_seconds(20, [&] {
    return http_get(server.admin(), "/metrics").find("\ntrc_streams_active 1\n") !=
           std::string::npos;
  });
}

TEST(Wait, ForAServerThatIsFullIsSaidAndEnds) {
  const ServerProcess server({"--max-streams", "1", "--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.address(), "");
  Endless first(server.address());
  ASSERT_TRUE(has_one_stream(server));
  const Folder folder;
  const std::string file = folder.write("part.nc", demo);
  const auto waiting = [&](const std::string& seconds) {
    return trc({"compensate", file, "--server", server.address(), "--wait", seconds});
  };
  const Ended at_once = waiting("0");
  EXPECT_EQ(at_once.code, 4) << at_once.err;
  EXPECT_NE(at_once.err.find("max-streams"), std::string::npos) << at_once.err;
  EXPECT_EQ(at_once.err.find("waiting"), std::string::npos) << at_once.err;
  const Ended later = waiting("2.5");
  EXPECT_EQ(later.code, 4) << later.err;
  const std::string said = "has no room now: ";
  EXPECT_NE(later.err.find(said), std::string::npos) << later.err;
  EXPECT_EQ(later.err.find(said), later.err.rfind(said)) << later.err;
  EXPECT_NE(later.err.find("; waiting for up to 2.5 s (--wait)\n"), std::string::npos) << later.err;

  // Who has waited gets the place that becomes free.
  Process patient({trc_program(), "compensate", file, "--server", server.address()});
  ASSERT_TRUE(within_seconds(20, [&] { return patient.err().find(said) != std::string::npos; }));
  EXPECT_EQ(first.end(), 0);
  EXPECT_EQ(patient.wait(), 0) << patient.err();
  EXPECT_EQ(patient.out(), trc({"compensate", file}).out);
}

TEST(Wait, OfASurveyForAServerThatIsFull) {
  const ServerProcess server({"--max-streams", "1", "--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.address(), "");
  Endless first(server.address());
  ASSERT_TRUE(has_one_stream(server));
  const Folder folder;
  const std::string file = folder.write("part.nc", demo);
  const std::vector<std::string> question{"radii", file,       "--radii",
                                          "2,4",   "--server", server.address()};
  std::vector<std::string> at_once = question;
  at_once.insert(at_once.end(), {"--wait", "0"});
  EXPECT_EQ(trc(at_once).code, 4);

  std::vector<std::string> words = question;
  words.insert(words.begin(), trc_program());
  Process patient(words);
  EXPECT_TRUE(within_seconds(
      20, [&] { return patient.err().find("has no room now: ") != std::string::npos; }));
  EXPECT_EQ(first.end(), 0);
  EXPECT_EQ(patient.wait(), 0) << patient.err();
  EXPECT_EQ(patient.out(), trc({"radii", file, "--radii", "2,4"}).out);
}

TEST(Server, ThatShutsDownIsToldFromOneThatIsNotThere) {
  ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.address(), "");
  Endless first(server.address());
  ASSERT_TRUE(has_one_stream(server));
  server.signal(SIGTERM);
  Ended draining;
  const auto is_refused = [&] {
    draining = trc({"compensate", "-", "--server", server.address(), "--wait", "0"}, demo);
    return draining.code == 3;
  };
  EXPECT_TRUE(within_seconds(20, is_refused));
  EXPECT_NE(draining.err.find("is there, but shuts down"), std::string::npos) << draining.err;
  const Ended waited =
      trc({"compensate", "-", "--server", server.address(), "--wait", "1.5"}, demo);
  EXPECT_EQ(waited.code, 3);
  EXPECT_NE(waited.err.find("shuts down; waiting for up to 1.5 s (--wait)"), std::string::npos)
      << waited.err;
  first.end();
  EXPECT_EQ(server.wait(), 0);
  const Ended down = trc({"compensate", "-", "--server", server.address()}, demo);
  EXPECT_EQ(down.code, 3);
  EXPECT_NE(down.err.find("cannot reach a server at"), std::string::npos) << down.err;
}

TEST(Server, OfAMisspeltVariableIsToldToBeNone) {
  const Folder folder;
  const std::string program = folder.write("part.nc", demo);
  const auto told = [&](const std::string& variable, std::vector<std::string> call) {
    call.insert(call.begin(), trc_program());
    Process process(call, 0, {variable + "=127.0.0.1:1"});
    EXPECT_EQ(process.wait(), 0) << variable;
    return process.err();
  };
  EXPECT_EQ(
      told("TRC_SEVER", {"compensate", program}),
      "trc: note: the environment variable TRC_SEVER is not read; did you mean TRC_SERVER?\n");
  EXPECT_NE(told("TRC_SEVER", {"compensate", program, "--output-dir", folder.path("out")})
                .find("did you mean TRC_SERVER"),
            std::string::npos);
  EXPECT_EQ(told("TRC_SEVER", {"compensate", program, "-q"}), "");
  EXPECT_EQ(told("TRC_SEVER", {"compensate", program, "--server", ""}), "");
  EXPECT_EQ(told("TRC_SEVER", {"explain", "90019"}), "");
  // Of tests, of packages for other languages, of Kubernetes beside a service named trc.
  for (const char* other : {"TRC_TEST_LONG", "TRC_TRCD", "TRC_CLI", "TRC_TEST_SEED", "TRC_BENCH",
                            "TRC_SERVICE_HOST", "TRC_SERVICE_PORT"})
    EXPECT_EQ(told(other, {"compensate", program}), "") << other;
}

TEST(Server, IsThatOfTheEnvironmentUnlessAnotherIsNamed) {
  const Folder folder;
  const std::string program = folder.write("part.nc", demo);
  const auto with_variable = [&](const std::string& value, std::vector<std::string> call) {
    call.insert(call.begin(), trc_program());
    Process process(call, 0, {"TRC_SERVER=" + value});
    const int code = process.wait();
    return std::pair(code, process.err());
  };
  const auto [nobody, told] = with_variable("127.0.0.1:1", {"compensate", program});
  EXPECT_EQ(nobody, 3);
  EXPECT_NE(told.find("127.0.0.1:1"), std::string::npos) << told;
  EXPECT_EQ(with_variable("127.0.0.1:1", {"compensate", program, "--server", ""}).first, 0);
  EXPECT_EQ(with_variable("", {"compensate", program}).first, 0);
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  EXPECT_EQ(with_variable(server.address(), {"health"}).first, 0);
  EXPECT_EQ(with_variable("127.0.0.1:1", {"health", "--server", server.address()}).first, 0);
  EXPECT_NE(trc({"compensate", "--help"}).out.find("TRC_SERVER"), std::string::npos);
}

TEST(Server, IsAskedForHealthAndInfo) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  const Ended health = trc({"health", "--server", server.address()});
  EXPECT_EQ(health.code, 0) << health.err;
  EXPECT_EQ(health.out, "serving\n");
  const Ended info = trc({"info", "--server", server.address()});
  EXPECT_EQ(info.code, 0) << info.err;
  // Some limits are filled in from the memory there is, and are those of the server.
  const auto tables = [](const std::string& text) {
    return text.substr(text.find("#TRC options"));
  };
  EXPECT_EQ(tables(info.out), tables(trc({"info"}).out));
}

TEST(Health, NeedsAServerToAsk) { EXPECT_EQ(trc({"health"}).code, 2); }

TEST(Health, DoesNotWaitLongForAServerThatHangs) {
  const ServerProcess server;
  ASSERT_NE(server.address(), "");
  server.signal(SIGSTOP);
  const auto start = std::chrono::steady_clock::now();
  const Ended health = trc({"health", "--server", server.address(), "--timeout-s", "1"});
  const auto took = std::chrono::steady_clock::now() - start;
  server.signal(SIGCONT);
  EXPECT_EQ(health.code, 3);
  EXPECT_EQ(health.out, "");
  EXPECT_GE(took, std::chrono::seconds(1));
  EXPECT_LT(took, std::chrono::seconds(8));
}

TEST(Health, TellsAServerThatIsAboutToStopFromOneThatServes) {
  ServerProcess server({"--health-listen", "127.0.0.1:0", "--admin-listen", "127.0.0.1:0"});
  ASSERT_NE(server.health(), "");
  EXPECT_EQ(trc({"health", "--server", server.health()}).code, 0);

  // A program that does not end, so that the server has something to wait for.
  const Folder folder;
  const std::string endless = folder.path("endless.nc");
  ASSERT_EQ(::mkfifo(endless.c_str(), 0600), 0);
  Process client({trc_program(), "compensate", endless, "--server", server.address()});
  std::ofstream text(endless);
  text << demo.substr(0, demo.size() / 2) << std::flush;
  const auto one_stream = [&] {
    return http_get(server.admin(), "/metrics").find("\ntrc_streams_active 1\n") !=
           std::string::npos;
  };
  ASSERT_TRUE(within_seconds(20, one_stream));

  server.signal(SIGTERM);
  Ended health;
  EXPECT_TRUE(within_seconds(20, [&] {
    health = trc({"health", "--server", server.health()});
    return health.code == 1;
  })) << health.err;
  EXPECT_EQ(health.out, "not serving\n");
  text.close();
  client.wait();
  EXPECT_EQ(server.wait(), 0);
}

}  // namespace
}  // namespace trc::testing_support
