#include "server/job_record.h"

#include <array>
#include <ctime>
#include <string>

#include "core/base/version.h"
#include "proto/wire/canonical_json.h"
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
