#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/session/program_session.h"
#include "proto/wire/setup.h"
#include "server/http/view/elements.h"
#include "server/http/view/lines.h"
#include "server/http/view/view_memory.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// How often a square may be divided.
inline constexpr std::uint32_t most_level = 24;
// Of findings, in a view.
inline constexpr int most_diagnostics = 1000;

// A square of the quadtree over a view, counted from the lowest corner.
struct TileName {
  std::uint32_t level = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

// The parts of a view that never change.
struct ViewParts {
  v1::View said{};
  Elements contour{};
  Elements path{};
  Lines program;
  wire::ProgramSettings settings{};
};

// A program and its path, to be shown. It does not change once made, except for the compensated
// text, which is made on demand.
class View {
 public:
  // `memory`: what it takes.
  View(std::shared_ptr<ViewMemory> memory, ViewParts parts)
      : memory_(std::move(memory)), parts_(std::move(parts)) {}

  // As it was when the view was made.
  [[nodiscard]] const v1::View& said() const { return parts_.said; }
  // With the measurements made since.
  [[nodiscard]] v1::View said_by_now() const;
  [[nodiscard]] const Elements& contour() const { return parts_.contour; }
  [[nodiscard]] const Elements& path() const { return parts_.path; }
  [[nodiscard]] const Lines& program() const { return parts_.program; }

  // Drawn more coarsely where half a pixel would take more segments.
  [[nodiscard]] std::string tile(const TileName& name, std::size_t most_segments) const;
  [[nodiscard]] v1::ViewBlocks blocks_of_line(std::uint64_t line) const;
  [[nodiscard]] v1::ViewPlace place_at(double share) const;

  // The compensated text; null while it is being made, and where there is no memory for it.
  // Postponed measurements are made with it.
  [[nodiscard]] std::shared_ptr<const Lines> output() const;
  // There was no memory for the compensated text.
  [[nodiscard]] bool lacks_output() const;
  // True for the caller who has to make it.
  [[nodiscard]] bool begin_output() { return !output_begun_.exchange(true); }
  // `interrupt` is called from time to time, and may throw. Measurements that take too long are
  // given up. `make_room` must not give up this view.
  void make_output(const std::function<void()>& interrupt, const ViewMemory::MakeRoom& make_room);
  // To be called when the view is no longer needed.
  void give_up() { given_up_ = true; }
  [[nodiscard]] bool is_given_up() const { return given_up_; }

 private:
  // While the text is made; `pass` charges what it takes, and may throw.
  struct Making {
    ViewMemory::Turn& turn;
    std::function<void()> pass{};
  };
  [[nodiscard]] std::shared_ptr<const Lines> compensated_lines(const Making& making);
  [[nodiscard]] std::string compensated_text(Verify verify, const Making& making);
  void measure(const ProgramSession& session, const std::vector<Diagnostic>& found);
  // One of the contour or of the path.
  [[nodiscard]] v1::ViewBlock described(const Elements& elements, std::size_t index) const;

  std::shared_ptr<ViewMemory> memory_;
  const ViewParts parts_;
  std::atomic<bool> output_begun_{false};
  std::atomic<bool> given_up_{false};
  mutable std::mutex mutex_;
  std::shared_ptr<const Lines> output_;
  bool lacks_output_ = false;
  v1::View measured_;  // what parts_.said lacks
};

}  // namespace trc::server::http
