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

#include "core/session/contour_reader.h"
#include "core/session/program_session.h"
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

  // As it was when the view was made.
  [[nodiscard]] const v1::View& said() const { return said_; }
  // With what was measured since.
  [[nodiscard]] v1::View said_by_now() const;
  [[nodiscard]] const Elements& contour() const { return contour_; }
  [[nodiscard]] const Elements& path() const { return path_; }
  [[nodiscard]] const Lines& program() const { return program_; }

  [[nodiscard]] std::string tile(std::uint32_t level, std::uint32_t x, std::uint32_t y) const;
  [[nodiscard]] v1::ViewBlocks blocks_of_line(std::uint32_t line) const;
  [[nodiscard]] v1::ViewPlace place_at(double share) const;

  // The compensated text; null while it is being made. What was left to be measured is measured
  // then too.
  [[nodiscard]] std::shared_ptr<const Lines> output() const;
  // True for the one who is to make it.
  [[nodiscard]] bool begin_output() { return !output_begun_.exchange(true); }
  // `interrupt` is called now and then, and may throw. What takes too long to measure is left
  // unmeasured.
  void make_output(const std::function<void()>& interrupt);
  // Nobody will ask for it any more.
  void give_up() { given_up_ = true; }
  [[nodiscard]] bool is_given_up() const { return given_up_; }

 private:
  [[nodiscard]] std::string compensated_text(Verify verify, const std::function<void()>& interrupt);
  void measure(const ProgramSession& session, const std::vector<Diagnostic>& found);
  [[nodiscard]] v1::ViewBlock described(const Elements& elements, std::size_t index,
                                        bool on_path) const;

  Share share_;
  const v1::View said_;
  const Elements contour_;
  const Elements path_;
  const Lines program_;
  const wire::ProgramSettings settings_;
  std::atomic<bool> output_begun_{false};
  std::atomic<bool> given_up_{false};
  mutable std::mutex mutex_;
  std::shared_ptr<const Lines> output_;
  v1::View measured_;  // what said_ lacks
};

// Puts a view together while the answers come in: the contour is read beside the path.
class ViewBuilder {
 public:
  // `plane` is shown, none: that of the first compensated block. `make_room` frees memory that
  // matters less; false: there is none.
  ViewBuilder(std::string text, const v1::ProgramSetup& setup, wire::ProgramSettings settings,
              std::optional<Plane> plane, Memory& memory, std::function<bool()> make_room);

  // False when there is no memory.
  [[nodiscard]] bool add(const std::vector<CompensatedBlock>& blocks);
  void add(const v1::Diagnostic& diagnostic);
  void set_summary(const v1::ProgramSummary& summary) { *said_.mutable_summary() = summary; }
  void set_refused() { said_.set_refused(true); }
  // The path is measured behind the first picture.
  void measure_later() { said_.set_measuring(true); }
  // Null when there is no memory. Nothing may be added any more.
  [[nodiscard]] std::shared_ptr<View> finish(std::string id);

  [[nodiscard]] const wire::ProgramSettings& settings() const { return settings_; }

 private:
  // A piece of the contour; false at its end, or where there is no memory.
  bool read_contour();
  void add_contour(const std::vector<Block>& blocks);
  void add_contour(const Block& block);
  // Where nothing is compensated the first motion says which plane is shown.
  void settle_plane();
  void settle_plane(std::optional<Plane> own);
  void mark_masked();
  void describe(const Lines& program);
  // Takes the memory for what there is by now.
  bool account();

  std::string text_;
  wire::ProgramSettings settings_;
  Share share_;
  std::function<bool()> make_room_;
  bool has_memory_ = true;
  v1::View said_;
  std::vector<Diagnostic> masked_;  // as far as the picture needs them

  ContourReader reader_;
  std::size_t read_bytes_ = 0;  // of the text
  std::uint64_t read_lines_ = 0;
  // Read before it was known which plane is shown.
  std::vector<Block> waiting_;
  std::optional<Plane> asked_plane_;
  std::optional<Plane> plane_;  // that is shown
  Plane own_plane_ = Plane::xy;
  // Of the motion before.
  Side side_ = Side::off;
  Elements contour_;
  // Of each element of the contour: Source::index of its block.
  std::vector<std::uint32_t> contour_blocks_;
  // Of each line; of one that is read again and again, as in subprograms, what it had last.
  std::vector<float> radius_of_line_;
  Elements path_;
};

}  // namespace trc::server::http
