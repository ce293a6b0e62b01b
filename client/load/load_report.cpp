#include "client/load/load_report.h"

#include <array>
#include <cstdarg>
#include <cstdio>

#include "client/load/json_object.h"

namespace trc::cli::load {
namespace {

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

// "%.3g" would switch to exponents.
std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return {text.data(), static_cast<std::size_t>(size)};
}

std::string large(double value) {
  if (value >= 1e6) return fixed(value / 1e6, 2) + " million";
  return fixed(value, value < 100 ? 1 : 0);
}

std::string row(std::string_view name, const std::string& content) {
  std::string line(name);
  line.resize(14, ' ');
  return line + content + "\n";
}

struct Percentile {
  std::string_view name;  // for people
  const char* key;
  double share;
};
constexpr std::array<Percentile, 4> percentiles{
    {{"p50", "p50", 0.5}, {"p90", "p90", 0.9}, {"p99", "p99", 0.99}, {"p99.9", "p999", 0.999}}};

std::string latency_row(std::string_view name, const Histogram& histogram) {
  if (histogram.count() == 0) return row(name, "none");
  std::string content;
  for (const Percentile& percentile : percentiles)
    content +=
        std::string(percentile.name) + " " + fixed(ms(histogram.at(percentile.share)), 3) + "  ";
  return row(name, content + "max " + fixed(ms(histogram.max()), 3) + " ms  (" +
                       std::to_string(histogram.count()) + ")");
}

std::string plan_row(const RunDescription& run, const Plan& plan, const Job& job) {
  std::string text = plan.open_loop()
                         ? "open loop, " + fixed(plan.rate, 1) + " streams/s, at most " +
                               std::to_string(plan.streams) + " at once"
                         : "closed loop, " + std::to_string(plan.streams) + " streams at once";
  text += ", each of " + std::to_string(job.items()) +
          (job.layout() == Layout::text ? " lines" : " blocks") + ", " +
          std::to_string(job.batch()) + " a batch, " + std::string(name_of(job.layout())) + ", " +
          run.shape + ", " + std::to_string(run.connections) +
          (run.connections == 1 ? " connection, " : " connections, ");
  return text + (run.server.empty() ? "server in this process" : "server " + run.server) + "\n";
}

std::string error_rows(const Tally& tally) {
  if (tally.errors.empty()) return row("errors", "none");
  std::string rows;
  for (const auto& [name, count] : tally.errors)
    rows += row(rows.empty() ? "errors" : "", std::to_string(count) + " " + name);
  return rows + row("", tally.first_error);
}

std::string verified_row(const Tally& tally) {
  if (tally.verified == 0) return row("verified", "none");
  std::string text = std::to_string(tally.verified) + " streams, bit for bit the core's";
  if (tally.differing > 0)
    text = std::to_string(tally.differing) + " of " + std::to_string(tally.verified) +
           " streams DIFFER; " + tally.first_difference;
  return row("verified", text);
}

std::string other_rows(const Tally& tally) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(tally.cancelled, "cancelled on purpose");
  add(tally.slow, "read slowly");
  add(tally.unfinished, "unfinished when the time was over");
  return text.empty() ? "" : row("streams", text);
}

std::string server_row(const Outcome& outcome) {
  if (!outcome.server) return row("server", "not on this machine, or not to be looked at");
  const Outcome::Server& server = *outcome.server;
  const double blocks = static_cast<double>(outcome.tally.blocks_in);
  return row("server", "process " + std::to_string(server.process) + ", " +
                           fixed(ratio(1e9 * server.cpu_s, blocks), 1) + " ns CPU a block (" +
                           fixed(ratio(1e9 * server.system_s, blocks), 1) + " in the kernel), " +
                           fixed(ratio(100 * server.cpu_s, outcome.seconds), 0) + " % of a core") +
         row("memory", fixed(server.resident_mib_first, 1) + " MiB at first, " +
                           fixed(server.resident_mib_warm, 1) + " after a second, then " +
                           fixed(server.resident_mib_least, 1) + " to " +
                           fixed(server.resident_mib_most, 1));
}

std::string own_row(const Plan& plan, const Outcome& outcome) {
  std::string text =
      fixed(ratio(1e9 * outcome.own_cpu_s, static_cast<double>(outcome.tally.blocks_in)), 1) +
      " ns CPU a block, " + fixed(ratio(100 * outcome.own_cpu_s, outcome.seconds), 0) +
      " % of a core";
  if (plan.open_loop())
    text += ", at most " + fixed(ms(outcome.generator_lag), 3) + " ms behind its schedule";
  return row("this program", text);
}

JsonObject latency_json(const Histogram& histogram) {
  JsonObject object;
  object.add("count", histogram.count());
  if (histogram.count() == 0) return object;
  for (const Percentile& percentile : percentiles)
    object.add(percentile.key, ms(histogram.at(percentile.share)));
  return object.add("max", ms(histogram.max()));
}

JsonObject server_json(const Outcome::Server& server, double blocks) {
  return JsonObject()
      .add("pid", static_cast<std::uint64_t>(server.process))
      .add("cpuSeconds", server.cpu_s)
      .add("systemSeconds", server.system_s)
      .add("nsPerBlock", ratio(1e9 * server.cpu_s, blocks))
      .add("residentMib", JsonObject()
                              .add("first", server.resident_mib_first)
                              .add("warm", server.resident_mib_warm)
                              .add("least", server.resident_mib_least)
                              .add("most", server.resident_mib_most)
                              .add("last", server.resident_mib_last));
}

JsonObject run_json(const RunDescription& run, const Plan& plan, const Job& job) {
  return JsonObject()
      .add("loop", plan.open_loop() ? "open" : "closed")
      .add("rate", plan.rate)
      .add("streams", plan.streams)
      .add("connections", static_cast<std::uint64_t>(run.connections))
      .add("layout", name_of(job.layout()))
      .add("shape", run.shape)
      .add("blocks", job.items())
      .add("batch", std::uint64_t{job.batch()})
      .add("server", run.server);
}

}  // namespace

std::string report_text(const RunDescription& run, const Plan& plan, const Job& job,
                        const Outcome& outcome) {
  const Tally& tally = outcome.tally;
  const auto blocks = static_cast<double>(tally.blocks_in);
  std::string text = plan_row(run, plan, job);
  text += row("measured", fixed(outcome.seconds, 2) + " s" +
                              (outcome.interrupted ? ", interrupted" : "") + ", at most " +
                              std::to_string(outcome.most_open) + " streams open");
  text += row("blocks/s", large(per(tally.blocks_in, outcome.seconds)) + " in, " +
                              large(per(tally.blocks_out, outcome.seconds)) + " out");
  text += row("streams/s", large(per(tally.completed, outcome.seconds)));
  text += row("bytes/block", fixed(per(tally.bytes_sent, blocks), 1) + " sent, " +
                                 fixed(per(tally.bytes_received, blocks), 1) + " received");
  text += latency_row("first output", tally.first_output);
  text += latency_row("batch", tally.batch);
  text += latency_row("stream", tally.stream);
  text += error_rows(tally) + other_rows(tally) + verified_row(tally);
  return text + server_row(outcome) + own_row(plan, outcome);
}

std::string report_json(const RunDescription& run, const Plan& plan, const Job& job,
                        const Outcome& outcome) {
  const Tally& tally = outcome.tally;
  const auto blocks = static_cast<double>(tally.blocks_in);
  JsonObject errors;
  for (const auto& [name, count] : tally.errors) errors.add(name, count);
  JsonObject object;
  object.add("run", run_json(run, plan, job))
      .add("seconds", outcome.seconds)
      .add("interrupted", outcome.interrupted)
      .add("mostStreamsOpen", outcome.most_open)
      .add("blocksIn", tally.blocks_in)
      .add("blocksOut", tally.blocks_out)
      .add("blocksPerSecond", per(tally.blocks_in, outcome.seconds))
      .add("streamsPerSecond", per(tally.completed, outcome.seconds))
      .add("bytesSentPerBlock", per(tally.bytes_sent, blocks))
      .add("bytesReceivedPerBlock", per(tally.bytes_received, blocks))
      .add("firstOutputMs", latency_json(tally.first_output))
      .add("batchMs", latency_json(tally.batch))
      .add("streamMs", latency_json(tally.stream))
      .add("completed", tally.completed)
      .add("cancelled", tally.cancelled)
      .add("slow", tally.slow)
      .add("unfinished", tally.unfinished)
      .add("errors", errors)
      .add("verified", tally.verified)
      .add("differing", tally.differing);
  if (!tally.first_error.empty()) object.add("firstError", tally.first_error);
  if (!tally.first_difference.empty()) object.add("firstDifference", tally.first_difference);
  if (outcome.server) object.add("server", server_json(*outcome.server, blocks));
  object.add("ownNsPerBlock", ratio(1e9 * outcome.own_cpu_s, blocks))
      .add("generatorLagMs", ms(outcome.generator_lag));
  return object.text();
}

}  // namespace trc::cli::load
