#pragma once

#include <string>
#include <vector>

#include "trc/v1/job_record.pb.h"

namespace trc::cli {

// The record as JSON, for people too; schema in proto/job_record.schema.json.
[[nodiscard]] std::string text_of(const v1::JobRecord& record);

// Returns what is wrong with the text, as a sentence; empty: it is in `record`.
[[nodiscard]] std::string record_from(const std::string& text, v1::JobRecord& record);

// Whether the text declares itself a record, whatever else it holds.
[[nodiscard]] bool is_record(const std::string& text);

// The file that a record names: by its name, in the working directory or in the folder of the
// record, or by the last part of that name beside the record. Where there is none, the name.
[[nodiscard]] std::string file_of_record(const v1::JobFile& filed, const std::string& record);

// Whether the text of a readable record is as it was written, apart from its layout: a sentence
// about the difference, or empty.
[[nodiscard]] std::string fault_of_seal(const std::string& text, const v1::JobRecord& record);

// Whether the file holds these bytes and no others.
[[nodiscard]] bool is_content_of(const v1::JobFile& filed, const std::string& path);
// Whether it holds the output of the record. The summary line of `jsonl`, which the record leaves
// out, may differ, but must be there.
[[nodiscard]] bool is_output_of(const v1::JobRecord& filed, const std::string& path);

// The differences of the record of a second run, a sentence each: the bytes of input and output,
// the diagnostics and the measurements. Versions and times may differ.
[[nodiscard]] std::vector<std::string> differences(const v1::JobRecord& filed,
                                                   const v1::JobRecord& again);

}  // namespace trc::cli
