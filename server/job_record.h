#pragma once

#include <cstdint>
#include <string>

#include "proto/wire/json_lines.h"
#include "server/sha256.h"
#include "trc/v1/job_record.pb.h"
#include "trc/v1/path_item.pb.h"

namespace trc::server {

// JobRecord::format
inline constexpr const char* job_record_format = "trc-job-record-1";

// Says of a record what it is, when the run began (now) and which version of the client ran.
void begin(v1::JobRecord& record);

// Says which bytes a file has; nothing may be added to `content` afterwards.
void fill(Sha256& content, v1::JobFile& file);

// What was told of a program, as its record says it. However much that is, the record stays small:
// beyond `most` only what refuses the program is kept whole.
class ToldInRecord {
 public:
  static constexpr int most = 1000;

  void add(const v1::Diagnostic& told, v1::JobRecord& record);
  // Behind the last one.
  void fill(v1::JobRecord& record);

 private:
  Sha256 content_{};
  std::uint64_t count_ = 0;
  wire::JsonLines lines_{};
  v1::PathItem item_{};
  std::string line_{};
};

// Says what the record holds, so that a change shows: last of all.
void seal(v1::JobRecord& record);

// JobRecord::sha256 as it has to be for the text of a record. Empty: the text is no JSON object.
[[nodiscard]] std::string digest_of_record(const std::string& json);

}  // namespace trc::server
