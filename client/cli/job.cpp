#include "client/cli/job.h"

#include <chrono>

#include "client/cli/file_name.h"
#include "client/cli/result_text.h"
#include "proto/wire/diagnostic.h"
#include "proto/wire/path_item.h"
#include "server/job_record.h"

namespace trc::cli {
namespace {

v1::JobFile file_of(const std::string& name, server::Sha256& content) {
  v1::JobFile file;
  file.set_name(text_of_name(name));
  server::fill(content, file);
  return file;
}

}  // namespace

Exit do_job(Job& job, Input& input, Reporter& reporter, const TextSink& sink) {
  const auto began = std::chrono::steady_clock::now();
  v1::JobRecord& record = job.record;
  server::begin(record);
  ResultText result(job.format, job.setup);
  server::Sha256 given;
  server::Sha256 made;
  server::ToldInRecord told;
  if (job.recorded) input.watch([&](std::string_view text) { given.add(text); });
  const Outcome outcome =
      compensate_program(job.service, job.setup, input, reporter, [&](const Answer& answer) {
        const std::string& text = result.of(answer);
        if (job.recorded) {
          for (const Diagnostic& found : answer.diagnostics) {
            v1::Diagnostic message;
            wire::to_proto(found, message);
            told.add(message, record);
          }
          made.add(text);
        }
        return sink(text);
      });
  job.summary = outcome.summary;
  if (outcome.summary) {
    to_proto(*outcome.summary, *record.mutable_summary());
    if (!sink(result.of(outcome.summary->path))) return Exit::wrong_call;
  }
  if (!job.recorded) return outcome.exit;
  *record.mutable_input() = file_of(job.input_name, given);
  *record.mutable_output() = file_of(job.output_name, made);
  told.fill(record);
  record.set_output_format(job.format);
  record.set_outcome(outcome.exit == Exit::done ? "DONE" : "REFUSED");
  *record.mutable_setup() = job.setup;
  const std::size_t release = outcome.core_version.find('+');
  record.set_server_version(outcome.core_version.substr(0, release));
  if (release != std::string::npos)
    record.set_server_commit(outcome.core_version.substr(release + 1));
  record.set_server(job.service.server);
  record.set_seconds(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  server::seal(record);
  return outcome.exit;
}

}  // namespace trc::cli
