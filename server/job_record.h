#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/state.h"
#include "core/trc/result/compensated_block.h"
#include "proto/wire/json_lines.h"
#include "server/sha256.h"
#include "trc/v1/job_record.pb.h"
#include "trc/v1/path_item.pb.h"
#include "trc/v1/setup.pb.h"

namespace trc::server {

// JobRecord::format
inline constexpr const char* job_record_format = "trc-job-record-1";

// Enters into a record its format, the start of the run (now) and the version of the client.
void begin(v1::JobRecord& record);

// Enters the digest of a file; nothing may be added to `content` afterwards.
void fill(Sha256& content, v1::JobFile& file);

// The diagnostics of a program for its record. The record stays small however many there are:
// beyond `most` only those that refuse the program are kept whole.
class ToldInRecord {
 public:
  static constexpr int most = 1000;

  void add(const v1::Diagnostic& told, v1::JobRecord& record);
  // After the last one.
  void fill(v1::JobRecord& record);

  // Saves its state to go on elsewhere; the owner of the record saves the record itself.
  void save(StateWriter& archive) const;
  void load(StateReader& archive);

 private:
  Sha256 content_{};
  std::uint64_t count_ = 0;
  wire::JsonLines lines_{};
  v1::PathItem item_{};
  std::string line_{};
};

// Enters the digest of the record itself, so that changes show: to be called last.
void seal(v1::JobRecord& record);

// The record of a program that goes through a stream (D-49).
class StreamedRecord {
 public:
  explicit StreamedRecord(const v1::ProgramSetup& setup);

  void add_input(std::string_view text) { given_.add(text); }
  // The next part of the output, in its order: text or blocks, then the diagnostics after them.
  void add_output(std::string_view text, std::span<const CompensatedBlock> blocks);
  void add_told(const v1::Diagnostic& told) {
    told_.add(told, record_);
    if (is_of_blocks()) add_line_told(told);
  }
  // The record as JSON, of a program that has been compensated, or of a refused one where there is
  // no summary. Nothing may be added afterwards.
  [[nodiscard]] std::string close(const v1::ProgramSummary* summary);

  // Goes on elsewhere, with the same setup.
  void save(StateWriter& archive) const;
  void load(StateReader& archive);

 private:
  [[nodiscard]] bool is_of_blocks() const {
    return record_.setup().output() == v1::PROGRAM_OUTPUT_BLOCKS;
  }
  void add_line_told(const v1::Diagnostic& told);
  void add_line();
  [[nodiscard]] double seconds() const;

  v1::JobRecord record_;
  Sha256 given_;
  Sha256 made_;
  ToldInRecord told_;
  wire::JsonLines lines_;
  v1::PathItem item_;
  std::string line_;
  double seconds_before_ = 0;  // elsewhere
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

// JobRecord::sha256 as it has to be for the text of a record. Empty: the text is no JSON object.
[[nodiscard]] std::string digest_of_record(const std::string& json);

}  // namespace trc::server
