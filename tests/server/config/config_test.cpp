#include "server/config/config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/config/configs.h"

namespace trc::server {
namespace {

using configs::Environment;
using configs::expect_fault;
using configs::read;
using configs::TextFile;

TEST(ServerConfig, StartsWithTheDocumentedDefaults) {
  const CommandLine result = read({});
  ASSERT_FALSE(result.exit.has_value()) << result.exit->text;
  const Config& config = result.config;
  EXPECT_EQ(config, Config{});
  EXPECT_EQ(config.listen, std::vector<std::string>{"127.0.0.1:50051"});
  EXPECT_EQ(config.max_message_bytes, 1048576U);
  EXPECT_EQ(config.max_blocks_per_selection, 20'000'000U);
  for (const std::uint32_t open :
       {config.memory_limit_mib, config.max_session_memory_mib, config.max_grpc_buffer_mib,
        config.max_streams, config.max_streams_per_peer, config.max_memory_per_peer_mib,
        config.max_connections_per_peer, config.http_max_connections_per_peer,
        config.http_max_memory_per_peer_mib})
    EXPECT_EQ(open, 0U);
  EXPECT_EQ(config.max_selection_cpu_s, 120U);
  EXPECT_EQ(config.max_stream_cpu_s, 7200U);
  EXPECT_EQ(config.max_streams_per_connection, 64U);
  EXPECT_EQ(config.max_line_bytes, 65536U);
  EXPECT_EQ(config.max_passive_blocks, 10'000U);
  EXPECT_EQ(config.idle_timeout_s, 300U);
  EXPECT_EQ(config.keepalive_time_s, 30U);
  EXPECT_EQ(config.drain_timeout_s, 30U);
  EXPECT_EQ(config.max_early_cancels, 200U);
  EXPECT_EQ(config.max_overhead_kib_per_s, 2048U);
  EXPECT_EQ(config.stall_timeout_s, 10U);
  EXPECT_EQ(config.max_log_lines_per_s, 1000U);
}

TEST(ServerConfig, FlagWinsOverEnvironmentAndEnvironmentOverFile) {
  const TextFile file("max-streams = 10\nidle-timeout-s = 20\ndrain-timeout-s = 30\n");
  const Environment streams("TRCD_MAX_STREAMS", "11");
  const Environment idle("TRCD_IDLE_TIMEOUT_S", "21");
  const CommandLine result = read({"--config", file.path().c_str(), "--max-streams=12"});
  ASSERT_FALSE(result.exit.has_value()) << result.exit->text;
  EXPECT_EQ(result.config.max_streams, 12U);
  EXPECT_EQ(result.config.idle_timeout_s, 21U);
  EXPECT_EQ(result.config.drain_timeout_s, 30U);
}

TEST(ServerConfig, WrongValueIsToldByWhereItComesFrom) {
  const Environment streams("TRCD_MAX_STREAMS", "x");
  const CommandLine of_variable = read({});
  expect_fault(of_variable, {"TRCD_MAX_STREAMS: 'x'"});
  EXPECT_EQ(of_variable.exit->text.find("--max-streams"), std::string::npos);
  expect_fault(read({"--max-streams", "y"}), {"--max-streams: 'y'"});
  expect_fault(read({"--max-streams=y"}), {"--max-streams: 'y'"});
}

TEST(ServerConfig, EnvironmentNamesTheFile) {
  const TextFile file("worker-threads = 3\n");
  const Environment config("TRCD_CONFIG", file.path().c_str());
  const CommandLine result = read({});
  ASSERT_FALSE(result.exit.has_value()) << result.exit->text;
  EXPECT_EQ(result.config.worker_threads, 3U);
}

TEST(ServerConfig, FileHoldsListsAndSwitches) {
  const TextFile file(
      "listen = [\"127.0.0.1:0\", \"unix:/run/trcd.sock\"]\nreflection = false\n"
      "log-level = \"warning\"  # a comment\n");
  const CommandLine result = read({"--config", file.path().c_str()});
  ASSERT_FALSE(result.exit.has_value()) << result.exit->text;
  EXPECT_EQ(result.config.listen, (std::vector<std::string>{"127.0.0.1:0", "unix:/run/trcd.sock"}));
  EXPECT_FALSE(result.config.reflection);
  EXPECT_EQ(result.config.log_level, "warning");
}

TEST(ServerConfig, YamlNamesTheSameSettings) {
  const TextFile file(
      "# a comment\nlisten: [\"127.0.0.1:0\", \"unix:/run/trcd.sock\"]\nreflection: false\n"
      "max-streams: 7\n",
      ".yaml");
  const CommandLine result = read({"--config", file.path().c_str()});
  ASSERT_FALSE(result.exit.has_value()) << result.exit->text;
  EXPECT_EQ(result.config.listen, (std::vector<std::string>{"127.0.0.1:0", "unix:/run/trcd.sock"}));
  EXPECT_FALSE(result.config.reflection);
  EXPECT_EQ(result.config.max_streams, 7U);
}

TEST(ServerConfig, RefusesAFileThatIsNoYaml) {
  for (const char* text : {"max-streams: 3\n- 4\n", "max-streams: 3\nidle: [\n", "just text\n",
                           "max-streams: {a: 1}\n"})
    expect_fault(read({"--config", TextFile(text, ".yml").path().c_str()}),
                 {"configuration file /", ".yml, line "});
  expect_fault(read({"--config", TextFile("no-such-setting: 3\n", ".yml").path().c_str()}),
               {"there is no setting 'no-such-setting'"});
}

TEST(ServerConfig, RefusesAYamlFileThatSaysOneThingTwice) {
  expect_fault(
      read({"--config", TextFile("max-streams: 3\nmax-streams: 4\n", ".yml").path().c_str()}),
      {".yml, line 2", "'max-streams' is there already"});
  expect_fault(
      read({"--config", TextFile("max-streams: 3\n---\nmax-streams: 4\n", ".yml").path().c_str()}),
      {".yml, line 3", "one document"});
  EXPECT_FALSE(read({"--config", TextFile("---\nmax-streams: 3\n", ".yml").path().c_str()}).exit);
  EXPECT_FALSE(read({"--config", TextFile("# nothing\n", ".yml").path().c_str()}).exit);
}

TEST(ServerConfig, YamlThatIsNoPlainValueNamesItsSetting) {
  for (const char* text :
       {"max-streams: {a: 1}\n", "max-streams: [[1]]\n", "max-streams: &m {a: 1}\n",
        "listen: &all [*all]\n", "listen: [{a: 1}]\n"}) {
    const std::string name = std::string(text).substr(0, std::string(text).find(':'));
    const TextFile file(std::string("\n") + text, ".yaml");
    expect_fault(read({"--config", file.path().c_str()}), {"line 2", "'" + name + "' must be"});
  }
  expect_fault(read({"--config", TextFile("? [a]\n: 1\n", ".yaml").path().c_str()}),
               {"line 1", "must name a setting"});
}

TEST(ServerConfig, SwitchesAreTrueOrFalse) {
  for (const char* value : {"5", "1", "0", "yes", "on", "True", "t", "-1"}) {
    expect_fault(read({("--insecure=" + std::string(value)).c_str()}),
                 {"--insecure", "true or false", value});
    const Environment variable("TRCD_INSECURE", value);
    expect_fault(read({}), {"TRCD_INSECURE", "true or false", value});
  }
  expect_fault(read({"--config", TextFile("insecure = 1\n").path().c_str()}),
               {"line 1", "--insecure", "true or false"});
  expect_fault(read({"--config", TextFile("reflection: yes\n", ".yaml").path().c_str()}),
               {"line 1", "--reflection", "true or false"});
  EXPECT_TRUE(read({"--insecure"}).config.insecure);
  const Environment variable("TRCD_INSECURE", "true");
  EXPECT_TRUE(read({}).config.insecure);
  EXPECT_FALSE(read({"--insecure=false"}).config.insecure);
}

TEST(ServerConfig, PrintedConfigurationReadsBackAsTheSame) {
  const CommandLine printed =
      read({"--print-config", "--listen=127.0.0.1:0,unix:/tmp/x.sock", "--max-streams=7",
            "--reflection=false", "--log-level=error", "--admin-listen=127.0.0.1:9464",
            "--health-listen=127.0.0.1:0", "--resume-key-file=/run/trcd/key", "--insecure-admin",
            "--max-early-cancels=3", "--max-overhead-kib-per-s=99", "--stall-timeout-s=4",
            "--max-log-lines-per-s=17", "--memory-limit-mib=2048", "--max-streams-per-peer=3",
            "--max-memory-per-peer-mib=100", "--max-connections-per-peer=9",
            "--max-selection-cpu-s=7", "--max-stream-cpu-s=8"});
  ASSERT_TRUE(printed.exit.has_value());
  ASSERT_EQ(printed.exit->code, 0) << printed.exit->text;
  const TextFile file(printed.exit->text);
  const CommandLine again = read({"--config", file.path().c_str()});
  ASSERT_FALSE(again.exit.has_value()) << again.exit->text << "\n" << printed.exit->text;
  EXPECT_EQ(again.config, printed.config) << printed.exit->text;
}

// One that is not the default, for each setting. Files are those of the test.
std::vector<std::string> other_values(const std::string& file) {
  std::vector<std::string> flags{"--listen=127.0.0.1:0,unix:/tmp/x.sock",
                                 "--tls-allowed-clients=mill,lathe",
                                 "--http-cors-origins=https://a.example,https://b.example",
                                 "--trusted-proxies=10.0.0.5,fd00::/8",
                                 "--tls-cert-file=" + file,
                                 "--tls-key-file=" + file,
                                 "--tls-client-ca-file=" + file,
                                 "--admin-listen=127.0.0.1:1",
                                 "--health-listen=127.0.0.1:2",
                                 "--http-listen=127.0.0.1:3",
                                 "--resume-key-file=/run/a \"quoted\" \\ key",
                                 "--reflection=false",
                                 "--log-level=debug"};
  const std::string printed = read({"--print-config"}).exit->text;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.substr(0, line.find('='));
    const std::string value = line.substr(line.find('=') + 1);
    const bool given = std::any_of(flags.begin(), flags.end(), [&](const std::string& flag) {
      return flag.starts_with("--" + name + "=");
    });
    if (given) continue;
    if (value == "false") flags.push_back("--" + name + "=true");
    if (value.find_first_not_of("0123456789") == std::string::npos)
      flags.push_back("--" + name + "=" + std::to_string(std::stoull(value) + 1));
  }
  return flags;
}

TEST(ServerConfig, EverySettingReadsBackAsItWasPrinted) {
  const TextFile pem("PEM", ".pem");
  const std::string printed_plain = read({"--print-config"}).exit->text;
  const auto lines = std::count(printed_plain.begin(), printed_plain.end(), '\n');
  const std::vector<std::string> flags = other_values(pem.path());
  ASSERT_EQ(static_cast<std::ptrdiff_t>(flags.size()), lines) << printed_plain;
  std::vector<const char*> call{"--print-config"};
  for (const std::string& flag : flags) call.push_back(flag.c_str());
  const CommandLine printed = read(call);
  ASSERT_EQ(printed.exit->code, 0) << printed.exit->text;
  const TextFile file(printed.exit->text);
  const CommandLine again = read({"--config", file.path().c_str()});
  ASSERT_FALSE(again.exit.has_value()) << again.exit->text << "\n" << printed.exit->text;
  EXPECT_EQ(again.config, printed.config) << printed.exit->text;
  EXPECT_EQ(again.config.tls_allowed_clients, (std::vector<std::string>{"mill", "lathe"}));
  EXPECT_EQ(again.config.resume_key_file, "/run/a \"quoted\" \\ key");
  // The printed defaults read back as the defaults.
  const TextFile plain(printed_plain);
  const CommandLine defaults = read({"--config", plain.path().c_str()});
  ASSERT_FALSE(defaults.exit.has_value()) << defaults.exit->text << "\n" << printed_plain;
  EXPECT_EQ(defaults.config, Config{});
}

TEST(ServerConfig, ListsAreListsInBothKindsOfFile) {
  const TextFile pem("PEM", ".pem");
  const std::string tls = pem.path();
  for (const bool yaml : {false, true}) {
    const std::string is = yaml ? ": " : " = ";
    std::string text;
    for (const char* name : {"tls-cert-file", "tls-key-file", "tls-client-ca-file"})
      text += name + is + '"' + tls + "\"\n";
    text += "tls-allowed-clients" + is + "[\"a\", \"b\"]\nhttp-cors-origins" + is + "[]\n";
    const TextFile file(text, yaml ? ".yaml" : ".toml");
    const CommandLine result = read({"--config", file.path().c_str()});
    ASSERT_FALSE(result.exit.has_value()) << result.exit->text;
    EXPECT_EQ(result.config.tls_allowed_clients, (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(result.config.http_cors_origins.empty());
  }
  for (const char* text : {"listen = []\n", "\nmax-streams = [1, 2]\n"})
    expect_fault(read({"--config", TextFile(text).path().c_str()}), {".toml, line "});
}

TEST(ServerConfig, FaultsOfAFileNameItAndTheLine) {
  const auto told = [](const std::string& text, const std::string& ending,
                       const std::vector<std::string>& words) {
    const TextFile file(text, ending);
    std::vector<std::string> all = words;
    all.push_back(file.path());
    expect_fault(read({"--config", file.path().c_str()}), all);
  };
  told("\nmax-streams = 1000001\n", ".toml", {"line 2", "max-streams"});
  told("\n\nlog-level: loud\n", ".yaml", {"line 3", "log-level"});
  told("\ntls-allowed-clients:\n", ".yaml", {"line 2", "tls-allowed-clients", "no value"});
  told("tls-allowed-clients: ','\n", ".yaml", {"tls-allowed-clients", "empty"});
  told("tls-allowed-clients = \",\"\n", ".toml", {"tls-allowed-clients", "empty"});
  told("tls-allowed-clients: ['']\n", ".yaml", {"line 1", "empty entry"});
  told("tls-allowed-clients = [\"mill\", \"\"]\n", ".toml", {"line 1", "empty entry"});
  told("# settings\nmax-streem = 3\n", ".toml", {"line 2", "did you mean max-streams?"});
  told("\nmax-streams = 1.5\n", ".toml", {"line 2", "max-streams"});
  told("\nlisten = [\n\"127.0.0.1:0\",\n1.5]\n", ".toml", {"line 4", "listen"});
  told("config = \"other.toml\"\n", ".toml", {"line 1", "there is no setting 'config'"});
  told("log-level = \"de\\u0000bug\"\n", ".toml", {"line 1", "log-level", "control character"});
}

// The parser recurses for each part of a key.
TEST(ServerConfig, AKeyOfVeryManyPartsIsAFault) {
  std::string key = "a";
  for (int part = 0; part < 50'000; ++part) key += ".a";
  for (const std::string& line : {key + "=1\n", "[" + key + "]\n", "x={" + key + "=1}\n"}) {
    const TextFile file("\n" + line);
    expect_fault(read({"--config", file.path().c_str()}), {"line 2", "16 dots"});
  }
  std::string names = "listen = [";
  for (int port = 50'000; port < 50'010; ++port)
    names += "\"127.0.0.1:" + std::to_string(port) + "\",";
  const TextFile many(names + "]  # 1.2.3.4.5.6.7.8.9.10.11.12.13.14.15.16.17.18\n");
  const CommandLine result = read({"--config", many.path().c_str()});
  EXPECT_FALSE(result.exit.has_value()) << result.exit->text;
}

TEST(ServerConfig, AnEmptyNameOfTheFileIsAFaultThatSaysSo) {
  const Environment empty("TRCD_CONFIG", "");
  expect_fault(read({}), {"TRCD_CONFIG", "empty"});
  const TextFile file("max-streams = 3\n");
  EXPECT_EQ(read({"--config", file.path().c_str()}).config.max_streams, 3u);
}

TEST(ServerConfig, FormerNameOfASettingIsAFaultThatTellsTheNewOne) {
  expect_fault(read({"--max-riders=7"}), {"--max-riders", "called --max-passive-blocks now"});
  expect_fault(read({"--max-riders", "7"}), {"called --max-passive-blocks now"});
  expect_fault(read({"--max-streem=7"}), {"--max-streem;", "did you mean --max-streams?"});
  {
    const Environment former("TRCD_MAX_RIDERS", "7");
    expect_fault(read({}), {"TRCD_MAX_RIDERS", "called TRCD_MAX_PASSIVE_BLOCKS now"});
  }
  const TextFile file("max-riders = 7\n");
  expect_fault(read({"--config", file.path().c_str()}),
               {"line 1", "called max-passive-blocks now"});
  const CommandLine now = read({"--max-passive-blocks=7"});
  ASSERT_FALSE(now.exit.has_value()) << now.exit->text;
  EXPECT_EQ(now.config.max_passive_blocks, 7U);
}

TEST(ServerConfig, UnknownVariableOfTheEnvironmentIsAFault) {
  {
    const Environment misspelt("TRCD_MAX_STREEMS", "3");
    expect_fault(read({}), {"TRCD_MAX_STREEMS", "did you mean TRCD_MAX_STREAMS?"});
  }
  {
    const Environment far("TRCD_COLOUR", "red");
    expect_fault(read({}), {"TRCD_COLOUR"});
  }
  // What Kubernetes and linked containers set beside a service named trcd.
  const Environment host("TRCD_SERVICE_HOST", "10.0.0.1");
  const Environment port("TRCD_PORT", "tcp://10.0.0.1:50051");
  const Environment named("TRCD_SERVICE_PORT_GRPC", "50051");
  const Environment address("TRCD_PORT_50051_TCP_ADDR", "10.0.0.1");
  EXPECT_FALSE(read({}).exit.has_value());
}

TEST(ServerConfig, HelpNamesEverySettingAndItsVariable) {
  const CommandLine result = read({"--help"});
  ASSERT_TRUE(result.exit.has_value());
  EXPECT_EQ(result.exit->code, 0);
  for (const char* name : {"--listen", "TRCD_LISTEN", "--max-session-memory-mib",
                           "TRCD_KEEPALIVE_TIMEOUT_S", "--print-config"})
    EXPECT_NE(result.exit->text.find(name), std::string::npos) << name;
}

TEST(ServerConfig, RefusesWhatItDoesNotKnow) {
  expect_fault(read({"--max-stream=3"}), {"--max-stream"});
  const TextFile file("max-stream = 3\n");
  expect_fault(read({"--config", file.path().c_str()}), {"there is no setting 'max-stream'"});
  expect_fault(read({"--config", "/nonexistent/trcd.toml"}), {"/nonexistent/trcd.toml"});
}

TEST(ServerConfig, RefusesAFileThatIsNoToml) {
  const TextFile file("max-streams = 3\nidle-timeout-s = = 4\n");
  expect_fault(read({"--config", file.path().c_str()}), {"line 2"});
}

TEST(ServerConfig, RefusesValuesOutOfRange) {
  expect_fault(read({"--max-streams=1000001"}), {"max-streams"});
  expect_fault(read({"--max-streams=-1"}), {"max-streams"});
  expect_fault(read({"--max-streams=many"}), {"max-streams"});
  // Neither 8 nor 16.
  expect_fault(read({"--max-streams=010"}), {"max-streams", "010"});
  expect_fault(read({"--max-streams=0x10"}), {"max-streams", "0x10"});
  expect_fault(read({"--max-message-bytes=99999999999"}), {"max-message-bytes"});
  expect_fault(read({"--log-level=loud"}), {"log-level"});
  const Environment idle("TRCD_IDLE_TIMEOUT_S", "soon");
  expect_fault(read({}), {"TRCD_IDLE_TIMEOUT_S", "soon"});
}

TEST(ServerConfig, RefusesAddressesThatAreNone) {
  for (const char* address : {"--listen=localhost", "--listen=:50051", "--listen=127.0.0.1:66000",
                              "--listen=::1:50051", "--listen=unix:", "--listen=127.0.0.1:"})
    expect_fault(read({address}), {"listen"});
  expect_fault(read({("--listen=unix:/" + std::string(200, 'x')).c_str()}), {"longer than 107"});
  expect_fault(read({"--admin-listen=9464"}), {"admin-listen"});
}

}  // namespace
}  // namespace trc::server
