#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/tolerances.h"
#include "core/nc/block.h"

namespace trc {

// G164: no centre correction, radius differences are limited. G165 (initial):
// an inaccurate centre is shifted onto a valid circle within limits.
struct CircleCheck {
  bool correct_center = true;              // G165 / G164
  double largest_shift = 2.0;              // mm, P-CHAN-00059
  double largest_shift_factor = 0.05;      // of the corrected radius, P-CHAN-00060
  double largest_radius_difference = 0.1;  // mm, G164, P-CHAN-00171
  double largest_radius_factor = 0.01;     // of the radius, G164, P-CHAN-00172
};

// What holds before the first block.
struct ProgramSetup {
  TrcMode mode{};               // plane, mode, radius, options; side must be off
  Position start{};             // mm
  bool absolute_center = false;  // G161; G162 is the initial state (spec 10.4)
  CircleCheck circle{};
  std::vector<std::string> tracking_axes{"A", "B", "C", "U", "V", "W"};
  std::map<std::int64_t, double> tools{};  // D word -> tool radius, mm
};

enum class MotionKind : std::uint8_t { rapid, linear, clockwise, counter_clockwise };

// One programmed motion before position, plane and circle rules are applied.
// Main axes in the order X Y Z and I J K, mm. An absent coordinate keeps its value.
struct MoveRequest {
  Source source{};
  MotionKind kind = MotionKind::linear;
  std::array<std::optional<double>, 3> end{};
  std::array<std::optional<double>, 3> center{};
  std::optional<double> radius{};  // R word of a circle: positive: at most 180 degrees
  bool incremental = false;        // G91: `end` and `tracking` are differences
  std::vector<std::optional<double>> tracking{};  // by index into tracking_axes
  double feed = 0;                 // mm/min in force
};

// The modal state and the position of one NC channel: turns requests into
// absolute blocks. NC text and motion messages both end here, so that a program
// means the same however it arrives.
//
// Every function returns whether the stream goes on; Diagnostics says why not.
class ProgramState {
 public:
  ProgramState(const ProgramSetup& setup, const Tolerances& tolerances, Diagnostics& diagnostics,
               std::vector<Block>& blocks);

  // G41, G42. A new number of selection begins unless the side only changes.
  bool select(Side side, const Source& source);
  // G40. Under G239 the last equidistant point becomes the position: a
  // coordinate that is not programmed afterwards keeps the compensated value.
  bool deselect(const Source& source);
  bool set_selection(Selection selection, const Source& source);
  bool set_tangential(const Source& source);  // G05, for the next selection block
  bool set_transition(Transition transition, const Source& source);
  bool set_masking(Masking masking, const Source& source);
  bool set_feed_adaptation(FeedAdaptation adaptation, const Source& source);
  bool set_tangfeed_minimum(double radius, const Source& source);  // 20963
  bool set_plane(Plane plane, const Source& source);               // 20133
  // mm; negative swaps the side (spec 1.5).
  bool set_tool_radius(double radius, const Source& source);
  bool set_tool(std::int64_t number, const Source& source);  // D word
  bool set_options(const TrcOptions& options, const Source& source);
  void set_absolute_center(bool absolute) { absolute_center_ = absolute; }  // G161 / G162
  void set_circle_correction(bool correct) { circle_.correct_center = correct; }  // G165 / G164

  // Appends a MotionBlock, or a PassiveBlock when nothing moves in the plane.
  bool move(const MoveRequest& request);
  // Technology text, dwell …: comes out in its place, never interpreted.
  bool pass(const Source& source, std::string text);
  // Program end (M30, M02, end of text or of the stream): D-27.
  bool end(const Source& source);

  [[nodiscard]] const TrcMode& mode() const { return mode_; }
  [[nodiscard]] const Position& position() const { return position_; }
  [[nodiscard]] const ProgramSetup& setup() const { return setup_; }

 private:
};

}  // namespace trc
