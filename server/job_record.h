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

  // Goes on elsewhere; what the record holds of it is the matter of whoever has the record.
  void save(StateWriter& archive) const;
  void load(StateReader& archive);

 private:
  Sha256 content_{};
  std::uint64_t count_ = 0;
  wire::JsonLines lines_{};
  v1::PathItem item_{};
  std::string line_{};
};

// Says what the record holds, so that a change shows: last of all.
void seal(v1::JobRecord& record);

// The record of a program that goes through a stream (D-49).
class StreamedRecord {
 public:
  explicit StreamedRecord(const v1::ProgramSetup& setup);

  void add_input(std::string_view text) { given_.add(text); }
  // The next part of what comes out, in its order: text or blocks, then what is told behind them.
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
