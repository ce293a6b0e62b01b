#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/plane.h"
#include "core/nc/state/block.h"
#include "core/session/path_session.h"
#include "core/session/unknown_starts.h"
#include "server/http/view/elements.h"

namespace trc::server::http {

// Facts about a program needed before anything is drawn.
struct FirstLook {
  // The plane of the first compensated motion; without one, of the first motion.
  Plane plane = Plane::xy;
  bool moves = false;    // at all
  bool is_inch = false;  // the text counts in inch, there
};
// Reads as far as needed for that. `pass` is called from time to time, and may throw.
[[nodiscard]] FirstLook first_look(std::string_view text, const SessionSetup& session,
                                   const std::function<void()>& pass);

// The programmed contour for a view.
class ViewContour {
 public:
  // `shown`: the plane.
  ViewContour(const SessionSetup& session, Plane shown);

  void take(std::span<const Block> blocks);

  // The radius of the tool, as programmed, in blocks (Source::index): from the first to the last of
  // these; 0: not compensated.
  void read_radii(std::uint64_t first, std::uint64_t last, std::vector<float>& radii) const;

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
  // Marks the parts of the last selection that are no walls as leads.
  void mark_leads();

  const LeadSettings leads_;
  const Plane shown_;
  UnknownStarts first_;
  Side side_ = Side::off;  // of the motion before
  Whole whole_;
  std::vector<float> radius_of_block_;
  // The blocks of the selection that is being read, and where its elements begin.
  std::vector<Block> selection_;
  std::size_t selection_begin_ = 0;
};

}  // namespace trc::server::http
