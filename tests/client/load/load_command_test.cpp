#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/process.h"

// `trc load` as it is called, against trcd on loopback.

namespace trc::testing_support {
namespace {

using Words = std::vector<std::string>;

Words command(Words options) {
  options.insert(options.begin(), {trc_program(), "load"});
  return options;
}

// A member of the report, also "server.nsPerBlock".
class Report {
 public:
  explicit Report(const std::string& json) {
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(json, &object_).ok()) << json;
  }
  [[nodiscard]] double number(const std::string& path) const { return at(path).number_value(); }
  [[nodiscard]] std::string text(const std::string& path) const { return at(path).string_value(); }
  [[nodiscard]] bool has(const std::string& path) const {
    return at(path).kind_case() != google::protobuf::Value::KIND_NOT_SET;
  }

 private:
  [[nodiscard]] google::protobuf::Value at(const std::string& path) const {
    const google::protobuf::Struct* object = &object_;
    std::string rest = path;
    for (;;) {
      const auto dot = rest.find('.');
      const auto found = object->fields().find(rest.substr(0, dot));
      if (found == object->fields().end()) return {};
      if (dot == std::string::npos) return found->second;
      object = &found->second.struct_value();
      rest = rest.substr(dot + 1);
    }
  }
  google::protobuf::Struct object_;
};

Ended load(const ServerProcess& server, Words options) {
  options.insert(options.begin(), {"--server", server.address(), "--json"});
  return run(command(options));
}

Report loaded(const ServerProcess& server, const Words& options) {
  const Ended ended = load(server, options);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  return Report(ended.out);
}

TEST(LoadCommand, ReportsWhatItMeasured) {
  const ServerProcess server;
  const Report report = loaded(server, {"--closed", "--streams", "3", "--blocks", "500", "--batch",
                                        "100", "--duration", "1", "--verify", "1"});
  EXPECT_EQ(report.text("run.loop"), "closed");
  EXPECT_EQ(report.number("run.blocks"), 504);
  EXPECT_NEAR(report.number("seconds"), 1, 0.2);
  EXPECT_EQ(report.number("mostStreamsOpen"), 3);
  EXPECT_GT(report.number("completed"), 3);
  EXPECT_GE(report.number("verified"), report.number("completed"));
  EXPECT_EQ(report.number("differing"), 0);
  EXPECT_GT(report.number("blocksPerSecond"), 504);
  EXPECT_GT(report.number("streamsPerSecond"), 1);
  EXPECT_GT(report.number("blocksOut"), 0.9 * report.number("blocksIn"));
  EXPECT_GT(report.number("bytesSentPerBlock"), 20);
  EXPECT_GT(report.number("bytesReceivedPerBlock"), 20);
  // Six batches a stream; those of the three last streams may be answered when the time is over.
  EXPECT_GE(report.number("batchMs.count"), 6 * (report.number("streamMs.count") - 3));
  for (const std::string what : {"firstOutputMs", "batchMs", "streamMs"}) {
    EXPECT_GT(report.number(what + ".p50"), 0) << what;
    EXPECT_LE(report.number(what + ".p50"), report.number(what + ".p99")) << what;
    EXPECT_LE(report.number(what + ".p99"), report.number(what + ".p999") + 1e-9) << what;
    EXPECT_LE(report.number(what + ".p999"), report.number(what + ".max") + 1e-9) << what;
  }
  EXPECT_GT(report.number("server.nsPerBlock"), 10);
  EXPECT_GT(report.number("server.residentMib.most"), 1);
  EXPECT_GT(report.number("ownNsPerBlock"), 1);
}

TEST(LoadCommand, RunsTheServiceItselfWithoutAServer) {
  const Ended ended = run(command({"--jobs", "2", "--blocks", "20", "--duration", "20"}));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("server in this process"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("errors        none"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("p99.9"), std::string::npos) << ended.out;
}

TEST(LoadCommand, LayoutsDifferOnTheWireAlone) {
  const ServerProcess server;
  const Words options{"--jobs", "20", "--blocks", "400", "--duration", "20", "--verify", "1"};
  const auto with = [&](const char* layout) {
    Words all = options;
    all.insert(all.end(), {"--layout", layout});
    return loaded(server, all);
  };
  const Report columns = with("columns");
  const Report blocks = with("blocks");
  const Report text = with("text");
  EXPECT_EQ(columns.number("verified"), 20);
  EXPECT_EQ(blocks.number("verified"), 20);
  EXPECT_EQ(text.number("verified"), 20);
  EXPECT_EQ(columns.number("blocksOut"), blocks.number("blocksOut"));
  EXPECT_GT(blocks.number("bytesReceivedPerBlock"), 1.5 * columns.number("bytesReceivedPerBlock"));
  EXPECT_EQ(text.number("run.blocks"), 405);
}

TEST(LoadCommand, BatchAndBlocksSayWhatAStreamIs) {
  const ServerProcess server;
  const Report report = loaded(server, {"--jobs", "5", "--blocks", "96", "--batch", "10",
                                        "--duration", "20", "--shape", "star"});
  EXPECT_EQ(report.text("run.shape"), "star");
  EXPECT_EQ(report.number("completed"), 5);
  EXPECT_EQ(report.number("blocksIn"), 500);
  EXPECT_EQ(report.number("batchMs.count"), 50);
}

TEST(LoadCommand, ShapesAndSeedsGiveOtherPaths) {
  const ServerProcess server;
  const Words options{"--jobs",     "1",  "--blocks", "600",
                      "--duration", "20", "--set",    "transition=G26"};
  const auto blocks_out = [&](const Words& more) {
    Words all = options;
    all.insert(all.end(), more.begin(), more.end());
    return loaded(server, all).number("blocksOut");
  };
  const double random = blocks_out({"--shape", "random"});
  EXPECT_NE(random, blocks_out({"--shape", "random", "--seed", "2"}));
  EXPECT_NE(random, blocks_out({"--shape", "square"}));
}

TEST(LoadCommand, OpenLoopKeepsItsRate) {
  const ServerProcess server;
  const Report report = loaded(server, {"--rate", "50", "--streams", "20", "--blocks", "20",
                                        "--duration", "1", "--ramp", "0.5"});
  EXPECT_EQ(report.text("run.loop"), "open");
  EXPECT_NEAR(report.number("streamMs.count"), 50, 2);
  EXPECT_EQ(report.number("unfinished"), 0);
}

TEST(LoadCommand, OpensAsManyConnectionsAsAsked) {
  const ServerProcess server({"--admin-listen", "127.0.0.1:0"});
  const auto accepted = [&] {
    const std::string name = "\ntrc_connections_accepted_total ";
    const std::string metrics = http_get(server.admin(), "/metrics");
    const auto at = metrics.find(name);
    return at == std::string::npos ? -1 : std::stod(metrics.substr(at + name.size()));
  };
  const double before = accepted();
  ASSERT_GE(before, 0);
  const Words options{"--streams", "6", "--jobs", "12", "--blocks", "5", "--duration", "20"};
  loaded(server, options);
  EXPECT_EQ(accepted(), before + 1);
  Words four = options;
  four.insert(four.end(), {"--connections", "4"});
  EXPECT_EQ(loaded(server, four).number("run.connections"), 4);
  EXPECT_EQ(accepted(), before + 5);
}

TEST(LoadCommand, SlowReadersAndCancelledStreamsAreNoErrors) {
  const ServerProcess server;
  const Report report =
      loaded(server, {"--jobs", "40", "--streams", "8", "--blocks", "50", "--duration", "30",
                      "--slow-reader", "0.1", "--cancel-rate", "0.25"});
  EXPECT_EQ(report.number("cancelled"), 10);
  // Every twentieth is both, and cancelled.
  EXPECT_GE(report.number("slow"), 1);
  EXPECT_LE(report.number("slow"), 4);
  EXPECT_EQ(report.number("completed") + report.number("cancelled"), 40);
  EXPECT_EQ(report.number("streamMs.count"), report.number("completed") - report.number("slow"));
}

TEST(LoadCommand, MaskingLetsAToolThroughThatIsTooLarge) {
  const ServerProcess server;
  const Words tool{"--jobs", "2",       "--blocks", "240",   "--duration",
                   "20",     "--shape", "random",   "--set", "tool_radius=500"};
  const Ended refused = load(server, tool);
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("the core refuses this contour: 900"), std::string::npos)
      << refused.err;
  Words masked = tool;
  masked.insert(masked.end(), {"--masking", "--verify", "1"});
  const Report report = loaded(server, masked);
  EXPECT_EQ(report.number("verified"), 2);
  EXPECT_EQ(report.number("differing"), 0);
}

TEST(LoadCommand, MakesTheContourForTheToolRadius) {
  const ServerProcess server;
  const Words options{"--jobs",     "1",       "--blocks",     "300",
                      "--duration", "20",      "--set",        "tool_radius=5",
                      "--shape",    "meander", "--tool-radius"};
  Words fitting = options;
  fitting.emplace_back("5");
  EXPECT_EQ(loaded(server, fitting).number("completed"), 1);
  // The troughs are five times as narrow.
  Words tight = options;
  tight.emplace_back("1");
  EXPECT_EQ(load(server, tight).code, 1);
}

TEST(LoadCommand, CountsErrorsByStatus) {
  const ServerProcess server;
  const Ended ended = load(server, {"--jobs", "3", "--blocks", "240", "--duration", "20",
                                    "--verify", "0", "--set", "tool_radius=500"});
  EXPECT_EQ(ended.code, 1);
  const Report report(ended.out);
  EXPECT_TRUE(report.has("errors.INVALID_ARGUMENT LINE_REVERSED") ||
              report.text("firstError") != "")
      << ended.out;
  EXPECT_EQ(report.number("completed"), 0);
}

TEST(LoadCommand, EndsWithTheReportSoFarWhenInterrupted) {
  const ServerProcess server;
  Process process(
      command({"--server", server.address(), "--json", "--duration", "60", "--blocks", "50"}));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(), 0);
  const Report report(process.out());
  EXPECT_TRUE(report.has("interrupted"));
  EXPECT_LT(report.number("seconds"), 30);
  EXPECT_GT(report.number("completed"), 0);
}

TEST(LoadCommand, SaysWhatIsWrong) {
  EXPECT_EQ(run(command({"--streams", "0"})).code, 2);
  EXPECT_EQ(run(command({"--rate", "5", "--closed"})).code, 2);
  EXPECT_EQ(run(command({"--shape", "cube"})).code, 2);
  EXPECT_EQ(run(command({"--layout", "rows"})).code, 2);
  EXPECT_EQ(run(command({"--cancel-rate", "2"})).code, 2);
  const Ended spiral = run(command({"--shape", "spiral", "--blocks", "1000000"}));
  EXPECT_EQ(spiral.code, 2);
  EXPECT_NE(spiral.err.find("at most"), std::string::npos) << spiral.err;
  const Ended setting = run(command({"--set", "tool_radios=5"}));
  EXPECT_EQ(setting.code, 2);
  EXPECT_NE(setting.err.find("tool_radius"), std::string::npos) << setting.err;
  const Ended nobody = run(command({"--server", "127.0.0.1:1", "--duration", "1"}));
  EXPECT_EQ(nobody.code, 3);
  EXPECT_NE(nobody.err.find("cannot reach a server"), std::string::npos) << nobody.err;
}

TEST(LoadCommand, KeepsToTheLimitsOfTheServer) {
  const ServerProcess server({"--max-blocks-per-batch", "1024", "--max-streams", "5"});
  const Ended batch = load(server, {"--batch", "1025"});
  EXPECT_EQ(batch.code, 2);
  EXPECT_NE(batch.err.find("the server admits 1024"), std::string::npos) << batch.err;
  const Ended streams = load(server, {"--batch", "1024", "--streams", "6"});
  EXPECT_EQ(streams.code, 2);
  EXPECT_NE(streams.err.find("the server admits 5"), std::string::npos) << streams.err;
}

TEST(LoadCommand, TellsALostServerFromAWrongOne) {
  auto server = std::make_unique<ServerProcess>();
  Process process(command({"--server", server->address(), "--json", "--duration", "2", "--blocks",
                           "100000", "--verify", "0"}));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  server->signal(SIGKILL);
  EXPECT_EQ(process.wait(), 3) << process.out();
}

}  // namespace
}  // namespace trc::testing_support
