#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/session/path_session.h"
#include "core/trc/result/first_motions.h"
#include "server/http/view/elements.h"

namespace trc::server::http {

// What must be known of a program before anything of it is drawn.
struct FirstLook {
  // Of the first compensated motion; where there is none, of the first one.
  Plane plane = Plane::xy;
  bool moves = false;    // at all
  bool is_inch = false;  // the text counts in inch, there
};
// Reads as far as that takes. `pass` is called now and then.
[[nodiscard]] FirstLook first_look(std::string_view text, const SessionSetup& session,
                                   const std::function<void()>& pass);

// The programmed contour as a view has it.
class ViewContour {
 public:
  // `shown`: the plane.
  ViewContour(const SessionSetup& session, Plane shown);

  void take(std::span<const Block> blocks);

  // The radius of the tool, as programmed, in blocks (Source::index): from the first to the last of
  // these; 0: not compensated.
  void read_radii(std::uint64_t first, std::uint64_t last, std::vector<float>& radii) const;
  // Bytes held.
  [[nodiscard]] std::size_t bytes() const;

  struct Whole {
    Elements elements{};
    std::vector<std::uint32_t> blocks{};  // of each element: Source::index of its block
    std::vector<double> tool_radii{};     // the first ones, each once
  };
  // Nothing may be taken any more.
  [[nodiscard]] Whole finish();

 private:
  void add(const Block& block);
  void add_tool_radius(double radius);
  // Draws what of the selection read last is no wall as what leads to one.
  void mark_leads();

  const LeadSettings leads_;
  const Plane shown_;
  FirstMotions first_;
  Side side_ = Side::off;  // of the motion before
  Whole whole_;
  std::vector<float> radius_of_block_;
  // The blocks of the selection that is being read, and where its elements begin.
  std::vector<Block> selection_;
  std::size_t selection_begin_ = 0;
};

}  // namespace trc::server::http
