#pragma once

#include <string>

#include "server/sha256.h"
#include "trc/v1/job_record.pb.h"

namespace trc::server {

// JobRecord::format
inline constexpr const char* job_record_format = "trc-job-record-1";

// Says of a record what it is, when the run began (now) and which version of the client ran.
void begin(v1::JobRecord& record);

// Says which bytes a file has; nothing may be added to `content` afterwards.
void fill(Sha256& content, v1::JobFile& file);

// Says what the record holds, so that a change shows: last of all.
void seal(v1::JobRecord& record);

// JobRecord::sha256 as it has to be for the text of a record. Empty: the text is no JSON object.
[[nodiscard]] std::string digest_of_record(const std::string& json);

}  // namespace trc::server
