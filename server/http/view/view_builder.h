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
#include "core/trc/result/compensated_block.h"
#include "core/trc/result/first_motions.h"
#include "proto/wire/setup.h"
#include "server/http/memory.h"
#include "server/http/view/elements.h"
#include "server/http/view/lines.h"
#include "server/http/view/view.h"
#include "server/http/view/view_contour.h"
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
  // `make_room` frees memory that matters less; false: there is none.
  ViewBuilder(ViewedProgram program, Memory& memory, std::function<bool()> make_room);

  void take_contour(std::span<const Block> blocks);
  // The path comes after the contour that it belongs to.
  void take_path(std::span<const CompensatedBlock> blocks);
  // Whether there is memory; without it nothing more is taken.
  [[nodiscard]] bool has_memory() const;

  void add(const v1::Diagnostic& diagnostic);
  void set_summary(const v1::ProgramSummary& summary) { *said_.mutable_summary() = summary; }
  void set_refused() { said_.set_refused(true); }
  // The path is measured after the first picture.
  void measure_later() { said_.set_measuring(true); }
  // Null when there is no memory. Once the stream has ended.
  [[nodiscard]] std::shared_ptr<View> finish(std::string id);

 private:
  // One thread puts contour and path in, another one takes the view out.
  mutable std::mutex mutex_;

  // Finds up to so many lines.
  void find_lines(std::uint64_t count);
  void read_contour();
  [[nodiscard]] float tool_radius_of(const CompensatedBlock& block);
  void mark_masked(ViewContour::Whole& contour);
  void describe(const ViewContour::Whole& contour);
  // Takes the memory for the present content.
  bool account();

  Lines program_;
  wire::ProgramSettings settings_;
  Share share_;
  std::function<bool()> make_room_;
  bool has_memory_ = true;
  v1::View said_;
  std::vector<Diagnostic> masked_;  // as far as the picture needs them
  // Source::index of contour blocks that have another one in their place, as the sides of a notch
  // that kerf masking has filled.
  std::vector<std::uint32_t> replaced_;

  FirstMotions first_on_path_;
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
