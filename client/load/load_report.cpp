#include "client/load/load_report.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "client/load/report_words.h"
#include "core/base/text_width.h"

namespace trc::load {
namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(Layout layout) {
  switch (layout) {
    case Layout::columns:
      return "columns";
    case Layout::blocks:
      return "blocks";
    case Layout::text:
      break;
  }
  return "text";
}

double ratio(double of, double to) { return to > 0 ? of / to : 0; }
double per(std::uint64_t of, double to) { return ratio(static_cast<double>(of), to); }
double ms(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

// "%.3g" would switch to exponent notation.
std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return {text.data(), static_cast<std::size_t>(size)};
}

struct Percentile {
  std::string_view name;  // name shown to people
  const char* key;
  double share;
};
constexpr std::array<Percentile, 4> percentiles{
    {{"p50", "p50", 0.5}, {"p90", "p90", 0.9}, {"p99", "p99", 0.99}, {"p99.9", "p999", 0.999}}};

// The rows of the report in one language.
class Rows {
 public:
  explicit Rows(Language language) : language_(language) {}

  [[nodiscard]] std::string plan(const RunDescription& run, const Plan& plan,
                                 const Job& job) const {
    const std::string items =
        std::to_string(job.items()) + (job.layout() == Layout::text ? " lines, " : " blocks, ");
    return told({plan.open_loop()
                     ? "open loop, " + fixed(plan.rate, 1) + " streams/s, at most " +
                           std::to_string(plan.streams) + " at once"
                     : "closed loop, " + std::to_string(plan.streams) + " streams at once",
                 "each of " + items + std::to_string(job.batch()) + " a batch, " +
                     std::string(name_of(job.layout())) + ", " + run.shape,
                 std::to_string(run.connections) +
                     (run.connections == 1 ? " connection" : " connections"),
                 run.server.empty() ? "server in this process" : "server " + run.server}) +
           "\n";
  }

  [[nodiscard]] std::string measured(const Outcome& outcome) const {
    const Tally& tally = outcome.tally;
    const auto blocks = static_cast<double>(tally.blocks_in);
    return row("measured",
               {fixed(outcome.seconds, 2) + " s" + (outcome.interrupted ? ", interrupted" : "") +
                ", at most " + std::to_string(outcome.most_open) + " streams open"}) +
           row("blocks/s", {large(per(tally.blocks_in, outcome.seconds)) + " in, " +
                            large(per(tally.blocks_out, outcome.seconds)) + " out"}) +
           row("streams/s", {large(per(tally.completed, outcome.seconds))}) +
           row("bytes/block", {fixed(per(tally.bytes_sent, blocks), 1) + " sent, " +
                               fixed(per(tally.bytes_received, blocks), 1) + " received"});
  }

  [[nodiscard]] std::string latency(std::string_view name, const Histogram& histogram) const {
    if (histogram.count() == 0) return row(name, {"none"});
    std::string content;
    for (const Percentile& percentile : percentiles)
      content +=
          std::string(percentile.name) + " " + fixed(ms(histogram.at(percentile.share)), 3) + "  ";
    return row(name, {content + "max " + fixed(ms(histogram.max()), 3) + " ms  (" +
                      std::to_string(histogram.count()) + ")"});
  }

  [[nodiscard]] std::string errors(const Tally& tally) const {
    if (tally.errors.empty()) return row("errors", {"none"});
    std::string rows;
    for (const auto& [name, count] : tally.errors)
      rows += row(rows.empty() ? "errors" : "", {std::to_string(count) + " " + name});
    return rows + row("", {tally.first_error});
  }

  // Streams that do not measure the server.
  [[nodiscard]] std::string others(const Tally& tally) const {
    std::vector<std::string> counts;
    const auto add = [&](std::uint64_t count, const char* what) {
      if (count > 0) counts.push_back(std::to_string(count) + " " + what);
    };
    add(tally.cancelled, "cancelled on purpose");
    add(tally.slow, "read slowly");
    add(tally.unfinished, "unfinished when the time was over");
    return counts.empty() ? std::string() : row("streams", counts);
  }

  [[nodiscard]] std::string verified(const Tally& tally) const {
    const std::string count = std::to_string(tally.verified);
    if (tally.verified == 0) return row("verified", {"none"});
    if (tally.differing == 0) return row("verified", {count + " streams, bit for bit the core's"});
    return row("verified", {std::to_string(tally.differing) + " of " + count + " streams DIFFER; " +
                            tally.first_difference});
  }

  [[nodiscard]] std::string server(const Outcome& outcome) const {
    if (!outcome.server) return row("server", {"not on this machine, or not to be looked at"});
    const Outcome::Server& server = *outcome.server;
    const auto blocks = static_cast<double>(outcome.tally.blocks_in);
    return row("server", {"process " + std::to_string(server.process),
                          fixed(ratio(1e9 * server.cpu_s, blocks), 1) + " ns CPU a block (" +
                              fixed(ratio(1e9 * server.system_s, blocks), 1) + " in the kernel)",
                          share_of_core(server.cpu_s, outcome.seconds)}) +
           row("memory",
               {fixed(server.resident_mib_first, 1) + " MiB at first, " +
                fixed(server.resident_mib_warm, 1) + " after a second, then " +
                fixed(server.resident_mib_least, 1) + " to " + fixed(server.resident_mib_most, 1)});
  }

  [[nodiscard]] std::string own(const Plan& plan, const Outcome& outcome) const {
    const auto blocks = static_cast<double>(outcome.tally.blocks_in);
    std::vector<std::string> parts{
        fixed(ratio(1e9 * outcome.own_cpu_s, blocks), 1) + " ns CPU a block",
        share_of_core(outcome.own_cpu_s, outcome.seconds)};
    if (plan.open_loop())
      parts.push_back("at most " + fixed(ms(outcome.generator_lag), 3) + " ms behind its schedule");
    return row("this program", parts);
  }

 private:
  static std::string large(double value) {
    if (value >= 1e6) return fixed(value / 1e6, 2) + " million";
    return fixed(value, value < 100 ? 1 : 0);
  }

  static std::string share_of_core(double cpu_s, double seconds) {
    return fixed(ratio(100 * cpu_s, seconds), 0) + " % of a core";
  }

  [[nodiscard]] std::string told(const std::vector<std::string>& parts) const {
    std::string text;
    for (const std::string& part : parts)
      text.append(text.empty() ? "" : ", ").append(said(part, language_));
    return text;
  }

  [[nodiscard]] std::string row(std::string_view name,
                                const std::vector<std::string>& parts) const {
    constexpr std::size_t width = 14;
    std::string line = said(name, language_);
    line.append(width - width_of(line), ' ');
    return line + told(parts) + "\n";
  }

  Language language_;
};

Json latency_json(const Histogram& histogram) {
  Json object{{"count", histogram.count()}};
  if (histogram.count() == 0) return object;
  for (const Percentile& percentile : percentiles)
    object[percentile.key] = ms(histogram.at(percentile.share));
  object["max"] = ms(histogram.max());
  return object;
}

Json server_json(const Outcome::Server& server, double blocks) {
  return {{"pid", server.process},
          {"cpuSeconds", server.cpu_s},
          {"systemSeconds", server.system_s},
          {"nsPerBlock", ratio(1e9 * server.cpu_s, blocks)},
          {"residentMib",
           {{"first", server.resident_mib_first},
            {"warm", server.resident_mib_warm},
            {"least", server.resident_mib_least},
            {"most", server.resident_mib_most},
            {"last", server.resident_mib_last}}}};
}

Json run_json(const RunDescription& run, const Plan& plan, const Job& job) {
  return {{"loop", plan.open_loop() ? "open" : "closed"},
          {"rate", plan.rate},
          {"streams", plan.streams},
          {"connections", run.connections},
          {"layout", name_of(job.layout())},
          {"shape", run.shape},
          {"blocks", job.items()},
          {"batch", job.batch()},
          {"server", run.server}};
}

}  // namespace

std::string report_text(const RunDescription& run, const Plan& plan, const Job& job,
                        const Outcome& outcome, Language language) {
  const Rows rows(language);
  const Tally& tally = outcome.tally;
  return rows.plan(run, plan, job) + rows.measured(outcome) +
         rows.latency("first output", tally.first_output) + rows.latency("batch", tally.batch) +
         rows.latency("stream", tally.stream) + rows.errors(tally) + rows.others(tally) +
         rows.verified(tally) + rows.server(outcome) + rows.own(plan, outcome);
}

std::string report_json(const RunDescription& run, const Plan& plan, const Job& job,
                        const Outcome& outcome) {
  const Tally& tally = outcome.tally;
  const auto blocks = static_cast<double>(tally.blocks_in);
  Json object{{"run", run_json(run, plan, job)},
              {"seconds", outcome.seconds},
              {"interrupted", outcome.interrupted},
              {"mostStreamsOpen", outcome.most_open},
              {"blocksIn", tally.blocks_in},
              {"blocksOut", tally.blocks_out},
              {"blocksPerSecond", per(tally.blocks_in, outcome.seconds)},
              {"streamsPerSecond", per(tally.completed, outcome.seconds)},
              {"bytesSentPerBlock", per(tally.bytes_sent, blocks)},
              {"bytesReceivedPerBlock", per(tally.bytes_received, blocks)},
              {"firstOutputMs", latency_json(tally.first_output)},
              {"batchMs", latency_json(tally.batch)},
              {"streamMs", latency_json(tally.stream)},
              {"completed", tally.completed},
              {"cancelled", tally.cancelled},
              {"slow", tally.slow},
              {"unfinished", tally.unfinished},
              {"errors", Json::object()},
              {"verified", tally.verified},
              {"differing", tally.differing}};
  for (const auto& [name, count] : tally.errors) object["errors"][name] = count;
  if (!tally.first_error.empty()) object["firstError"] = tally.first_error;
  if (!tally.first_difference.empty()) object["firstDifference"] = tally.first_difference;
  if (outcome.server) object["server"] = server_json(*outcome.server, blocks);
  object["ownNsPerBlock"] = ratio(1e9 * outcome.own_cpu_s, blocks);
  object["generatorLagMs"] = ms(outcome.generator_lag);
  // Reasons from foreign servers need not be valid text.
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trc::load
