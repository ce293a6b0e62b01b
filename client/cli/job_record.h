#pragma once

#include <string>
#include <vector>

#include "trc/v1/job_record.pb.h"

namespace trc::cli {

// The record as JSON, for people too; schema in proto/job_record.schema.json.
[[nodiscard]] std::string text_of(const v1::JobRecord& record);

// Returns what is wrong with the text, as a sentence; empty: it is in `record`.
[[nodiscard]] std::string record_from(const std::string& text, v1::JobRecord& record);

// Whether the text of a record that could be read is as it was written, its layout apart: a
// sentence about what is not, or empty.
[[nodiscard]] std::string fault_of_seal(const std::string& text, const v1::JobRecord& record);

// Whether the file holds these bytes and no others.
[[nodiscard]] bool is_content_of(const v1::JobFile& filed, const std::string& path);
// Whether it holds what came out. The summary line of `jsonl`, which the record leaves out, may be
// any; that it is there is asked for.
[[nodiscard]] bool is_output_of(const v1::JobRecord& filed, const std::string& path);

// Each a sentence about what the record of a second run says otherwise: the bytes of input and
// output, what was told and what was measured. Versions and times may differ.
[[nodiscard]] std::vector<std::string> differences(const v1::JobRecord& filed,
                                                   const v1::JobRecord& again);

}  // namespace trc::cli
