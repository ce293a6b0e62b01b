#include "server/job_record.h"

#include <array>
#include <ctime>
#include <string>

#include "core/base/archive.h"
#include "core/base/version.h"
#include "proto/wire/canonical_json.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/json.h"

namespace trc::server {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace

void begin(v1::JobRecord& record) {
  record.set_format(job_record_format);
  record.set_started(utc_now());
  record.set_client_version(std::string(version()));
  record.set_client_commit(std::string(commit()));
}

void fill(Sha256& content, v1::JobFile& file) {
  file.set_bytes(content.bytes());
  file.set_sha256(content.digits());
}

void ToldInRecord::add(const v1::Diagnostic& told, v1::JobRecord& record) {
  *item_.mutable_diagnostic() = told;
  line_.clear();
  lines_.append(item_, line_);
  content_.add(line_);
  ++count_;
  if (record.diagnostics_size() < most || told.severity() == v1::Diagnostic::ERROR)
    *record.add_diagnostics() = told;
}

void ToldInRecord::fill(v1::JobRecord& record) {
  record.mutable_all_diagnostics()->set_count(count_);
  record.mutable_all_diagnostics()->set_sha256(content_.digits());
}

void ToldInRecord::save(StateWriter& archive) const {
  content_.save(archive);
  archive(count_);
}

void ToldInRecord::load(StateReader& archive) {
  content_.load(archive);
  archive(count_);
}

StreamedRecord::StreamedRecord(const v1::ProgramSetup& setup) {
  begin(record_);
  v1::ProgramSetup& kept = *record_.mutable_setup();
  kept = setup;
  // These fields concern this stream alone.
  kept.clear_record();
  kept.mutable_path()->clear_want_resume_tokens();
  kept.mutable_path()->clear_resume_token();
  record_.set_output_format(is_of_blocks() ? "jsonl" : "nc");
  record_.mutable_input()->set_name(setup.file_name().empty() ? "-" : setup.file_name());
  record_.mutable_output()->set_name("-");
  record_.set_server_version(std::string(version()));
  record_.set_server_commit(std::string(commit()));
}

void StreamedRecord::add_output(std::string_view text, std::span<const CompensatedBlock> blocks) {
  made_.add(text);
  for (const CompensatedBlock& block : blocks) {
    wire::to_proto(block, *item_.mutable_block());
    add_line();
  }
}

void StreamedRecord::add_line_told(const v1::Diagnostic& told) {
  *item_.mutable_diagnostic() = told;
  add_line();
}

void StreamedRecord::add_line() {
  line_.clear();
  lines_.append(item_, line_);
  made_.add(line_);
}

double StreamedRecord::seconds() const {
  const std::chrono::duration<double> here = std::chrono::steady_clock::now() - began_;
  return seconds_before_ + here.count();
}

std::string StreamedRecord::close(const v1::ProgramSummary* summary) {
  fill(given_, *record_.mutable_input());
  fill(made_, *record_.mutable_output());
  told_.fill(record_);
  record_.set_outcome(summary != nullptr ? "DONE" : "REFUSED");
  if (summary != nullptr) *record_.mutable_summary() = *summary;
  record_.set_seconds(seconds());
  seal(record_);
  return wire::json_of(record_);
}

void StreamedRecord::save(StateWriter& archive) const {
  given_.save(archive);
  made_.save(archive);
  told_.save(archive);
  v1::JobRecord so_far;
  *so_far.mutable_diagnostics() = record_.diagnostics();
  so_far.set_started(record_.started());
  archive(so_far.SerializeAsString(), seconds());
}

void StreamedRecord::load(StateReader& archive) {
  given_.load(archive);
  made_.load(archive);
  told_.load(archive);
  std::string so_far;
  archive(so_far, seconds_before_);
  record_.MergeFromString(so_far);
}

void seal(v1::JobRecord& record) {
  record.clear_sha256();
  record.set_sha256(digest_of_record(wire::json_of(record)));
}

std::string digest_of_record(const std::string& json) {
  google::protobuf::Struct object;
  if (!wire::Json().read(json, object).empty()) return {};
  object.mutable_fields()->erase("sha256");
  Sha256 content;
  content.add(wire::canonical_json(object));
  return content.digits();
}

}  // namespace trc::server
