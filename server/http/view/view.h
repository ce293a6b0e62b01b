#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/trc/result/compensated_block.h"
#include "proto/wire/setup.h"
#include "server/http/memory.h"
#include "server/http/view/elements.h"
#include "server/http/view/lines.h"
#include "trc/v1/http.pb.h"
#include "trc/v1/setup.pb.h"

namespace trc::server::http {

// A program and its path, for somebody who looks at them. Does not change once it is made, but for
// the compensated text, which is made when it is asked for.
class View {
 public:
  View(Share share, v1::View said, Elements contour, Elements path, Lines program,
       const wire::ProgramSettings& settings)
      : share_(std::move(share)),
        said_(std::move(said)),
        contour_(std::move(contour)),
        path_(std::move(path)),
        program_(std::move(program)),
        settings_(settings) {}

  [[nodiscard]] const v1::View& said() const { return said_; }
  [[nodiscard]] const Elements& contour() const { return contour_; }
  [[nodiscard]] const Elements& path() const { return path_; }
  [[nodiscard]] const Lines& program() const { return program_; }

  [[nodiscard]] std::string tile(std::uint32_t level, std::uint32_t x, std::uint32_t y) const;
  [[nodiscard]] v1::ViewBlocks blocks_of_line(std::uint32_t line) const;
  [[nodiscard]] v1::ViewPlace place_at(double share) const;

  // The compensated text; null while it is being made.
  [[nodiscard]] std::shared_ptr<const Lines> output() const;
  // True for the one who is to make it.
  [[nodiscard]] bool begin_output() { return !output_begun_.exchange(true); }
  // `interrupt` is called now and then.
  void make_output(const std::function<void()>& interrupt);

 private:
  [[nodiscard]] v1::ViewBlock described(const Elements& elements, std::size_t index,
                                        bool on_path) const;

  Share share_;
  const v1::View said_;
  const Elements contour_;
  const Elements path_;
  const Lines program_;
  const wire::ProgramSettings settings_;
  std::atomic<bool> output_begun_{false};
  mutable std::mutex mutex_;
  std::shared_ptr<const Lines> output_;
};

// Puts a view together while the answers come in.
class ViewBuilder {
 public:
  ViewBuilder(std::string text, const v1::ProgramSetup& setup, wire::ProgramSettings settings,
              Memory& memory);

  // Takes the memory for more blocks, which `add` is then called with. False when there is none.
  [[nodiscard]] bool has_room_for(std::size_t blocks);
  void add(std::vector<CompensatedBlock> blocks);
  void add(const v1::Diagnostic& diagnostic);
  void set_summary(const v1::ProgramSummary& summary) { *said_.mutable_summary() = summary; }
  void set_refused() { said_.set_refused(true); }
  // Null when there is no memory. Nothing may be added any more.
  [[nodiscard]] std::shared_ptr<View> finish(std::string id);

  [[nodiscard]] const wire::ProgramSettings& settings() const { return settings_; }

 private:
  void add_contour(const std::vector<Block>& blocks);
  void add_path();
  void describe(const Lines& program);

  std::string text_;
  wire::ProgramSettings settings_;
  Share share_;
  v1::View said_;
  std::vector<Diagnostic> masked_;  // as far as the picture needs them
  std::vector<CompensatedBlock> blocks_;
  Plane plane_ = Plane::xy;
  Elements contour_;
  Elements path_;
};

}  // namespace trc::server::http
