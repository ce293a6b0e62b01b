#include "client/cli/job.h"

#include <array>
#include <chrono>
#include <ctime>

#include "client/cli/file_name.h"
#include "client/cli/job_record.h"
#include "client/cli/result_text.h"
#include "client/cli/sha256.h"
#include "core/base/version.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/path_item.h"

namespace trc::cli {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

v1::JobFile file_of(const std::string& name, Sha256& content) {
  v1::JobFile file;
  file.set_name(text_of_name(name));
  file.set_bytes(content.bytes());
  file.set_sha256(content.digits());
  return file;
}

}  // namespace

Exit do_job(Job& job, Input& input, Reporter& reporter, const TextSink& sink) {
  const auto began = std::chrono::steady_clock::now();
  v1::JobRecord& record = job.record;
  record.set_format(record_format);
  record.set_started(utc_now());
  ResultText result(job.format, job.setup);
  Sha256 given;
  Sha256 made;
  v1::GetServerInfoResponse info;
  if (job.recorded) {
    input.watch([&](std::string_view text) { given.add(text); });
    if (const Exit exit = server_info(job.service, info); exit != Exit::done) return exit;
  }
  const Outcome outcome =
      compensate_program(job.service, job.setup, input, reporter, [&](const Answer& answer) {
        const std::string& text = result.of(answer);
        if (job.recorded) {
          for (const Diagnostic& told : answer.diagnostics)
            wire::to_proto(told, *record.add_diagnostics());
          made.add(text);
        }
        return sink(text);
      });
  if (outcome.summary) {
    to_proto(*outcome.summary, *record.mutable_summary());
    if (!sink(result.of(outcome.summary->path))) return Exit::wrong_call;
  }
  if (!job.recorded) return outcome.exit;
  *record.mutable_input() = file_of(job.input_name, given);
  *record.mutable_output() = file_of(job.output_name, made);
  record.set_output_format(job.format);
  record.set_outcome(outcome.exit == Exit::done ? "DONE" : "REFUSED");
  *record.mutable_setup() = job.setup;
  record.set_client_version(std::string(version()));
  record.set_client_commit(std::string(commit()));
  record.set_server_version(info.version());
  record.set_server_commit(info.commit());
  record.set_server(job.service.server);
  record.set_seconds(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  return outcome.exit;
}

}  // namespace trc::cli
