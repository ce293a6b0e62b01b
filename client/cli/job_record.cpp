#include "client/cli/job_record.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "client/cli/file_name.h"
#include "proto/wire/json.h"
#include "server/job_record.h"
#include "server/sha256.h"

namespace trc::cli {
namespace {

using google::protobuf::util::MessageDifferencer;

void compare_files(const char* what, const v1::JobFile& filed, const v1::JobFile& again,
                   std::vector<std::string>& found) {
  if (filed.sha256() == again.sha256() && filed.bytes() == again.bytes()) return;
  found.push_back(std::string(what) + ": SHA-256 is " + again.sha256() + " of " +
                  std::to_string(again.bytes()) + " bytes, the record says " + filed.sha256() +
                  " of " + std::to_string(filed.bytes()));
}

v1::ProgramSummary without_times(v1::ProgramSummary summary) {
  summary.mutable_path()->clear_wall_time_seconds();
  summary.mutable_path()->clear_cpu_time_seconds();
  return summary;
}

// Whether the file begins with the recorded bytes; if so, the stream is after them.
bool begins_with(std::ifstream& stream, const v1::JobFile& filed) {
  server::Sha256 content;
  std::array<char, 65536> piece{};
  while (content.bytes() < filed.bytes()) {
    const auto wanted = std::min<std::uint64_t>(piece.size(), filed.bytes() - content.bytes());
    stream.read(piece.data(), static_cast<std::streamsize>(wanted));
    if (stream.gcount() == 0) return false;
    content.add({piece.data(), static_cast<std::size_t>(stream.gcount())});
  }
  return content.digits() == filed.sha256();
}

bool is_at_end(std::ifstream& stream) { return stream.peek() == std::ifstream::traits_type::eof(); }

}  // namespace

bool is_content_of(const v1::JobFile& filed, const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return stream && begins_with(stream, filed) && is_at_end(stream);
}

bool is_output_of(const v1::JobRecord& filed, const std::string& path) {
  if (filed.output_format() != "jsonl") return is_content_of(filed.output(), path);
  std::ifstream stream(path, std::ios::binary);
  std::string summary;
  return stream && begins_with(stream, filed.output()) && std::getline(stream, summary) &&
         summary.starts_with(R"({"summary":)") && is_at_end(stream);
}

std::string text_of(const v1::JobRecord& record) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  std::string text;
  // Cannot fail: a message of known fields always has a JSON form.
  static_cast<void>(google::protobuf::util::MessageToJsonString(record, &text, options));
  return text;
}

std::string record_from(const std::string& text, v1::JobRecord& record) {
  const std::string fault = wire::Json().read(text, record);
  if (!fault.empty())
    return (is_record(text) ? "it has been changed: " : "it is no record of a job: ") + fault;
  if (record.format() != server::job_record_format)
    return "it is no record of a job: format is \"" + record.format() + "\"";
  return {};
}

bool is_record(const std::string& text) {
  google::protobuf::Struct object;
  if (!google::protobuf::util::JsonStringToMessage(text, &object).ok()) return false;
  const auto format = object.fields().find("format");
  return format != object.fields().end() &&
         format->second.string_value() == server::job_record_format;
}

std::string file_of_record(const v1::JobFile& filed, const std::string& record) {
  namespace fs = std::filesystem;
  const fs::path named = name_of_text(filed.name());
  const fs::path folder = fs::path(record).parent_path();
  for (const fs::path& path : {named, folder / named, folder / named.filename()}) {
    std::error_code missing;
    if (fs::exists(path, missing)) return path;
  }
  return named;
}

std::string fault_of_seal(const std::string& text, const v1::JobRecord& record) {
  const std::string now = server::digest_of_record(text);
  if (record.sha256() == now) return {};
  if (record.sha256().empty()) return "it has been changed: its own SHA-256 is not there";
  return "it has been changed since it was written: its SHA-256 is " + now +
         ", the one in it says " + record.sha256();
}

std::vector<std::string> differences(const v1::JobRecord& filed, const v1::JobRecord& again) {
  std::vector<std::string> found;
  compare_files("input", filed.input(), again.input(), found);
  compare_files("output", filed.output(), again.output(), found);
  if (filed.outcome() != again.outcome())
    found.push_back("outcome: " + again.outcome() + ", the record says " + filed.outcome());
  MessageDifferencer differencer;
  std::string report;
  differencer.ReportDifferencesToString(&report);
  const auto compare = [&](const char* what, const auto& a, const auto& b) {
    report.clear();
    if (differencer.Compare(a, b)) return;
    std::istringstream lines(report);
    for (std::string line; std::getline(lines, line);)
      found.push_back(std::string(what) + ": " + line);
  };
  compare("summary", without_times(filed.summary()), without_times(again.summary()));
  v1::JobRecord told_then;
  v1::JobRecord told_now;
  *told_then.mutable_diagnostics() = filed.diagnostics();
  *told_then.mutable_all_diagnostics() = filed.all_diagnostics();
  *told_now.mutable_diagnostics() = again.diagnostics();
  *told_now.mutable_all_diagnostics() = again.all_diagnostics();
  compare("diagnostics", told_then, told_now);
  return found;
}

}  // namespace trc::cli
