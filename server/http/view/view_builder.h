#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/plane.h"
#include "core/session/unknown_starts.h"
#include "core/trc/result/compensated_block.h"
#include "proto/wire/setup.h"
#include "server/http/view/elements.h"
#include "server/http/view/lines.h"
#include "server/http/view/view.h"
#include "server/http/view/view_contour.h"
#include "server/http/view/view_memory.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// The input for a view.
struct ViewedProgram {
  std::shared_ptr<const std::string> text{};
  std::string name{};
  wire::ProgramSettings settings{};
  std::optional<Plane> plane{};  // that is shown; none: that of the first look
  FirstLook look{};
};

// Builds a view while a stream compensates its program: contour and path come from the stream,
// diagnostics with the answers, in another thread.
class ViewBuilder {
 public:
  ViewBuilder(ViewedProgram program, Memory& memory, ViewMemory::MakeRoom make_room);

  void take_contour(std::span<const Block> blocks);
  // The path comes after the contour that it belongs to.
  void take_path(std::span<const CompensatedBlock> blocks);
  // Whether there is memory; without it nothing more is taken.
  [[nodiscard]] bool has_memory() const;
  // Something for the view could not be had.
  void lose_memory();

  void add(const v1::Diagnostic& diagnostic);
  void set_summary(const v1::ProgramSummary& summary) { *said_.mutable_summary() = summary; }
  void set_refused() { said_.set_refused(true); }
  // The path is measured after the first picture.
  void measure_later() { said_.set_measuring(true); }
  // Null when there is no memory. Once the stream has ended. `interrupt` is called from time to
  // time, and may throw.
  [[nodiscard]] std::shared_ptr<View> finish(std::string id,
                                             const std::function<void()>& interrupt);

 private:
  // One thread puts contour and path in, another one takes the view out.
  mutable std::mutex mutex_;

  // Does `work` in a turn; without memory has_memory_ is false after it.
  template <class Work>
  void in_turn(const Work& work);
  // Finds up to so many lines. Returns whether some of them are left.
  bool find_lines(std::uint64_t count);
  void read_contour(const std::function<void()>& pass);
  void keep(const v1::Diagnostic& diagnostic);
  void add_to_path(std::span<const CompensatedBlock> blocks);
  [[nodiscard]] float tool_radius_of(const CompensatedBlock& block);
  void mark_masked(ViewContour::Whole& contour, const std::function<void()>& pass);
  void describe(const ViewContour::Whole& contour);

  Lines program_;
  wire::ProgramSettings settings_;
  std::shared_ptr<ViewMemory> memory_;
  ViewMemory::MakeRoom make_room_;
  bool has_memory_ = true;
  v1::View said_;
  std::vector<Diagnostic> masked_;  // as far as the picture needs them
  // Source::index of contour blocks that have another one in their place, as the sides of a notch
  // that kerf masking has filled.
  std::vector<std::uint32_t> replaced_;

  UnknownStarts first_on_path_;
  std::size_t found_bytes_ = 0;  // of the text: its lines are found
  const FirstLook look_;
  const Plane plane_;  // that is shown
  std::unique_ptr<ViewContour> contour_;
  // As programmed in the blocks (Source::index) from the first one on that is being added.
  std::vector<float> radii_;
  std::uint64_t first_radius_ = 0;
  float path_radius_ = 0;  // of the compensated block before
  Elements path_;
};

}  // namespace trc::server::http
