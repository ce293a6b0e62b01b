#pragma once

#include <cstdint>
#include <string>

#include "client/load/digest.h"
#include "client/load/sample_contour.h"
#include "client/load/sample_program.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::load {

enum class Layout {
  columns,  // CompensatePath, both ways in columns
  blocks,   // CompensatePath, both ways in one message a block
  text,     // CompensateProgram, from NC text to NC text
};

// The work of every stream of a run. Shared by all of them; never changes.
class Job {
 public:
  // `setup`: what differs from the defaults. The requests must be free of faults.
  Job(const ShapeRequest& shape, Layout layout, std::uint32_t batch, v1::ProgramSetup setup);
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  [[nodiscard]] Layout layout() const { return layout_; }
  [[nodiscard]] const v1::ProgramSetup& setup() const { return setup_; }
  // Blocks of the contour with selection and deselection, or lines.
  [[nodiscard]] std::uint64_t items() const;
  // Items in a request.
  [[nodiscard]] std::uint32_t batch() const { return batch_; }
  [[nodiscard]] std::uint64_t batches() const { return (items() + batch_ - 1) / batch_; }

  // Replaces the content by the batch of that number.
  void write(std::uint64_t number, v1::BlockColumns& columns) const;
  void write(std::uint64_t number, v1::BlockBatch& batch) const;
  // `text` without its position.
  void write(std::uint64_t number, v1::ProgramText& text) const;

 private:
  struct Range {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };
  [[nodiscard]] Range range_of(std::uint64_t batch) const;
  // Calls one of `out.command(side)`, `out.line(end)` and `out.arc(element, center from start)`.
  template <class Out>
  void write_item(std::uint64_t item, Out& out) const;

  SampleContour contour_;
  SampleProgram program_;
  Layout layout_;
  std::uint32_t batch_;
  v1::ProgramSetup setup_;
};

// The result of the job by the core of this process. `refused`: why there is none, else empty.
[[nodiscard]] ExpectedResult expected_of(const Job& job, std::string& refused);

}  // namespace trc::load
