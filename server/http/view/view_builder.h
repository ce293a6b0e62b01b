#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/plane.h"
#include "core/session/contour_reader.h"
#include "core/trc/result/compensated_block.h"
#include "core/trc/result/first_motions.h"
#include "proto/wire/setup.h"
#include "server/http/memory.h"
#include "server/http/view/elements.h"
#include "server/http/view/lines.h"
#include "server/http/view/view.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

// What a view is made of.
struct ViewedProgram {
  std::shared_ptr<const std::string> text{};
  std::string name{};
  wire::ProgramSettings settings{};
  std::optional<Plane> plane{};  // that is shown; none: that of the first compensated block
};

// Puts a view together while the answers come in: the contour is read beside the path.
class ViewBuilder {
 public:
  // `make_room` frees memory that matters less; false: there is none.
  ViewBuilder(ViewedProgram program, Memory& memory, std::function<bool()> make_room);

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
  void add_tool_radius(double radius);
  [[nodiscard]] float tool_radius_of(const CompensatedBlock& block);
  void mark_masked();
  // Draws what of the selection read last is no wall as what leads to one.
  void mark_leads();
  void describe();
  // Takes the memory for what there is by now.
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

  ContourReader reader_;
  FirstMotions first_on_contour_;
  FirstMotions first_on_path_;
  std::size_t read_bytes_ = 0;  // of the text
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
  // The blocks of the selection that is being read, and where its elements begin.
  std::vector<Block> selection_;
  std::size_t selection_begin_ = 0;
  // Of each line; of one that is read again and again, as in subprograms, what it had last.
  std::vector<float> radius_of_line_;
  float path_radius_ = 0;  // of the compensated block before
  Elements path_;
};

}  // namespace trc::server::http
