#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/length_unit.h"
#include "core/base/tolerances.h"
#include "core/nc/state/block.h"
#include "core/nc/state/corner_cut.h"
#include "core/nc/state/held_corner.h"
#include "core/nc/state/lead.h"
#include "core/nc/state/program_setup.h"
#include "core/nc/state/refusal.h"
#include "core/nc/state/tool_in_force.h"

namespace trc {

// How a mode that blocks were programmed under uses its radius.
struct RadiusUse {
  std::shared_ptr<const TrcMode> mode{};
  RadiusTerms terms{};
  Side side = Side::off;  // as programmed
};

// A set of the axes X Y Z, one bit each.
using AxisBits = std::uint8_t;
inline constexpr AxisBits all_axes = 7;
[[nodiscard]] constexpr AxisBits main_axis_bit(std::size_t axis) {
  return static_cast<AxisBits>(1U << axis);
}

// Why nobody knows where an axis stands.
enum class Unknown : std::uint8_t {
  coordinates_changed,
  without_value,  // of a variable in its word
};

// In the order of G00 … G03.
enum class MotionKind : std::uint8_t { rapid, linear, clockwise, counter_clockwise };
inline constexpr int last_motion_function = 3;
[[nodiscard]] constexpr MotionKind motion_of_function(int g_number) {
  return static_cast<MotionKind>(g_number);
}
[[nodiscard]] constexpr bool is_circle(MotionKind kind) {
  return kind == MotionKind::clockwise || kind == MotionKind::counter_clockwise;
}

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
  double feed = 0;                                // mm/min in force
  ContourRole role = ContourRole::unspecified;
  std::optional<CornerCut> corner{};  // after the motion, in a contour
  double corner_feed = 0;             // of it, mm/min; 0: that of the motion

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, kind, end, center, radius, incremental, tracking, feed, role, corner,
            corner_feed);
  }
};

// A way to the contour (APPR) whose first motion is still to come.
struct PendingLead {
  Lead lead{};
  MoveRequest request{};
  MoveRequest way{};
  Position from{};
  std::optional<Infeed> infeed{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lead, request, way, from, infeed);
  }
};

// An arc that leads to the contour, with its direction at the end.
struct ArcToContour {
  Source source{};
  Vector tangent = Vector::Zero();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, tangent);
  }
};

// The modal state and the position of one NC channel: turns requests into
// absolute blocks. NC text and motion messages both end here, so that a program
// means the same however it arrives.
//
// Functions that may refuse return whether the stream goes on; if not, Diagnostics says why.
class ProgramState {
 public:
  ProgramState(const ProgramSetup& setup, const Tolerances& tolerances, Diagnostics& diagnostics,
               std::vector<Block>& blocks);
  ProgramState(const ProgramState&) = delete;
  ProgramState& operator=(const ProgramState&) = delete;

  // The 1-based byte of the line that the next calls come from, for diagnostics;
  // 0: unknown. `of_center` is where its first I, J, K or R stands.
  void place(std::uint32_t column, std::uint32_t of_center = 0) {
    column_ = column;
    center_column_ = of_center;
  }

  // G41, G42, as programmed: a negative radius swaps the side (rule 1.5). A new
  // number of selection begins unless the side only changes. 900103.
  bool select(Side side, const Source& source);
  // G40. Under G239 the last equidistant point becomes the position, if the
  // selection had a contour block after its approach: a coordinate that is not
  // programmed afterwards keeps the compensated value (rule 3.6).
  // Warns of a selection without any motion (D-28); nothing is done while off.
  bool deselect(const Source& source);
  bool set_selection(Selection selection, const Source& source);  // 21317, 21318
  // G05, for the next selection or deselection: call it before those. Under G238
  // a warning (21316) and nothing else.
  bool set_tangential(const Source& source);
  bool set_transition(Transition transition, const Source& source);
  bool set_masking(Masking masking, const Source& source);
  bool set_feed_adaptation(FeedAdaptation adaptation, const Source& source);
  bool set_tangfeed_minimum(double radius, const Source& source);  // 20963
  bool set_plane(Plane plane, const Source& source);               // 20133
  // As those of ToolInForce; a change of the path under an active G238 is 90127, and while TRC is
  // active 900219, 900220 and 900222 come at once.
  bool set_tool_radius(double radius, const Source& source);
  bool change_tool_radius(double more, const Source& source);
  bool set_wear(double wear, const Source& source);
  bool set_allowance(double allowance, const Source& source);
  // RadiusTerms::scale.
  bool set_scale(double scale, const Source& source);
  // OFFN: adds to the allowance of the setup, which the program does not change.
  bool set_allowance_of_program(double allowance, const Source& source) {
    return set_allowance(setup_.allowance + allowance, source);
  }
  bool set_tool(std::int64_t number, const Source& source, const WordPlace& place = {});
  void prepare_tool(std::int64_t number, const WordPlace& place = {}) {
    tool_.prepare_tool(number, place);
  }
  bool load_tool(const Source& source);
  // The program gives a tool its radius, mm, valid from the next call of the tool on. A warning
  // where the setup gives a different one (900224).
  bool define_tool(std::int64_t number, double radius, const Source& source);
  void define_wear(std::int64_t number, double wear) { tool_.define_wear(number, wear); }
  bool call_tool(const ToolRow& row, const Source& source);
  // A STRETCH_FACTOR out of range becomes 1, with a warning (22007). 22125, 900005.
  bool set_options(const TrcOptions& options, const Source& source);
  // Of I, J and K: G161 / G162.
  [[nodiscard]] bool absolute_center() const { return absolute_center_; }
  void set_absolute_center(bool absolute) { absolute_center_ = absolute; }
  void set_circle_correction(bool correct) { circle_.correct_center = correct; }  // G165 / G164
  // G70 / G71: decides how finely coordinates are written.
  void set_length_unit(LengthUnit unit) { circle_.last_digit = last_digit(unit); }

  // The coordinates mean something else from here on (zero shift, preset): where the machine stands
  // is not known on the axes given (X Y Z) until each is programmed absolutely in a straight
  // motion. Such motions are shown as starting from the old coordinates, so that joints stay
  // shared; motions that need the position (an arc, G91, a selection but for D-170) are refused
  // (900106). While a retract is still to come, one axis of the plane that is forgotten makes the
  // other one unknown too.
  void forget_position(const std::array<bool, 3>& axes, const Source& source,
                       Unknown why = Unknown::coordinates_changed);
  // Lengths have counted in another unit than was assumed: so of each axis that the program has led
  // away from 0 (D-167).
  void forget_lengths(const Source& source);
  // G92 of Fanuc and LinuxCNC: from here on the machine stands at these coordinates, mm. Blocks
  // share their joints, so an axis of the plane that stood elsewhere becomes unknown.
  void set_position(const std::array<std::optional<double>, 3>& place, const Source& source);

  // Appends one block: a MotionBlock, or a PassiveBlock when nothing moves in the
  // plane by more than `same_point` (D-29). Such small steps add up: the sum is
  // travelled with the first block that is long enough.
  //
  // A circle needs a centre or a radius; a centre word that is missing is 0
  // relative to the start point (G162), or the coordinate of the start point
  // (G161). After a deselection under G239 that left the programmed point there
  // is none before a straight motion in the plane (D-37). 20034, 20035, 20036,
  // 21024, 21758, 90018, 90133, 90134, 900003 (centre word across the plane),
  // 900101, 900105, 900106. A centre that is shifted gets a warning (900221).
  //
  // The first motion in the plane of a selection needs a tool radius: 900219; one
  // given as 0 gets a warning once (900220).
  bool move(const MoveRequest& request);
  // The direction of the contour at its end so far; nothing where no contour has begun.
  [[nodiscard]] std::optional<Vector> tangent_of_contour() const {
    if (!mode_.active() || in_plane_blocks_ == 0) return {};
    return tangent_at_end(last_path_);
  }
  // RND and CHF of Klartext, lines of their own after a motion of a contour. `feed`: of the cut,
  // mm/min; 0: that of the motion. 900003 where the motion has no corner to be cut.
  bool cut_corner_behind(const CornerCut& cut, double feed, const Source& source);
  // APPR of Klartext and G147 of Sinumerik, after select(): the contour begins at `end` of the
  // request, whose feed is that of the lead. `way`: how the tool goes there from where it stands.
  // The lead comes out with the first motion of the contour, which gives the direction of the
  // contour. Without `infeed` the third axis travels with the feed of the lead, before it.
  // 900003 where there is no room.
  bool approach_by(const Lead& lead, const MoveRequest& request, const MoveRequest& way,
                   const std::optional<Infeed>& infeed = {});
  // DEP, G148: leaves the contour and deselects; of LCT `end` of the request is where to.
  bool depart_by(const Lead& lead, const MoveRequest& request, Climb climb);
  // Technology text, dwell …: comes out in its place, never interpreted.
  bool pass(const Source& source, std::string text);
  // Program end (M30, M02, end of text or of the stream): D-27. Only the first
  // call does anything.
  bool end(const Source& source);

  [[nodiscard]] const TrcMode& mode() const { return mode_; }
  [[nodiscard]] const ToolInForce& tool() const { return tool_; }
  // For each mode of the blocks so far, in order; only with ProgramSetup::every_radius.
  [[nodiscard]] const std::vector<RadiusUse>& radius_uses() const { return radius_uses_; }
  [[nodiscard]] RadiusUse radius_use() const {
    return {shared_mode_, tool_.terms(), programmed_side_};
  }
  // Whether the start of some motion depends on the radius (rule 3.6).
  [[nodiscard]] bool moves_by_radius() const { return moves_by_radius_; }
  // The plane that the program has named last.
  [[nodiscard]] Plane programmed_plane() const { return next_plane_.value_or(mode_.plane); }
  // Where the last block ended, mm.
  [[nodiscard]] const Position& position() const { return position_; }
  // Whether this may be a feed, mm/min; 0 is none.
  [[nodiscard]] bool is_feed(double feed) const {
    return feed > 0 && feed <= tolerances_.largest_feed;
  }
  [[nodiscard]] const ProgramSetup& setup() const { return setup_; }
  // TRC is active, or its retract motion is still to come.
  [[nodiscard]] bool contour_open() const { return mode_.active() || retract_pending_; }
  // After a deselection without motion the tool stands beside the end of the contour. Its position
  // has become unknown before it has left, so how it leaves is not known.
  [[nodiscard]] bool retract_is_lost() const {
    const PlaneAxes axes = axes_of(mode_.plane);
    return retract_pending_ && !(known_[axes.first] && known_[axes.second]);
  }
  // The axes (X Y Z) in which such a tool still stands beside the contour.
  [[nodiscard]] const std::array<bool, 3>& beside_contour() const { return beside_contour_; }
  // A copied motion has led these axes to where they would also stand without TRC.
  void have_left_contour(const std::array<bool, 3>& axes) {
    for (std::size_t axis = 0; axis < axes.size(); ++axis) beside_contour_[axis] &= !axes[axis];
  }
  // Whether the place of a main axis is known.
  [[nodiscard]] bool is_known(std::size_t axis) const { return known_[axis]; }
  // G91 holds from there on.
  void count_increments_since(const Source& source) { increments_since_ = source; }
  // TRC is selected; the motion that leads to the contour is still to come.
  [[nodiscard]] bool awaits_approach() const { return mode_.active() && in_plane_blocks_ == 0; }
  // LINUXCNC: that motion is an arc. It becomes an arc tangential to the contour, as if G05 stood
  // beside the selection; 900003 unless it ends in the direction of the next block (D-110).
  bool approach_on_arc(MoveRequest request);
  // The Source::index of the first block not given out yet; without one the largest number.
  [[nodiscard]] std::uint64_t held_from() const {
    if (lead_) return lead_->request.source.index;
    const std::vector<Block>& held = corner_.blocks();
    return held.empty() ? std::numeric_limits<std::uint64_t>::max() : index_of(held.front());
  }
  // No motion in the plane has followed the last G40 yet.
  [[nodiscard]] bool just_deselected() const { return just_deselected_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(tool_, column_, mode_, shared_mode_, programmed_side_, tangential_requested_,
            absolute_center_, circle_.correct_center, circle_.last_digit, position_, target_,
            known_, programmed_, position_forgotten_, why_unknown_, displaced_, tracking_,
            selected_, selections_, in_plane_blocks_, has_approach_, last_path_, last_index_,
            last_part_, last_mode_, retract_pending_, left_at_height_, beside_contour_,
            just_deselected_, next_plane_, corner_, lead_, arc_to_contour_, ended_,
            increments_since_);
    terms_in_mode_ = tool_.terms();
  }

 private:
  static constexpr std::array<const char*, 3> axis_words{"X", "Y", "Z"};

  // known_position.cpp
  void forget_what_stands_beside(const Source& source);
  void forget_axis(std::size_t axis, const Source& source, Unknown why);
  bool report(const Source& source, Code code, std::string detail = {},
              std::vector<DiagnosticValue> values = {});
  bool refuse(const Source& source, Refusal refusal);

  // Every change of the mode goes through here, so that blocks given out keep
  // the mode they were programmed under.
  TrcMode& change_mode();
  const std::shared_ptr<const TrcMode>& shared_mode() {
    if (!shared_mode_) share_mode();
    return shared_mode_;
  }
  void share_mode();
  void update_side();
  // Takes over the change of the tool, or reports its refusal.
  bool follow_tool(std::optional<Refusal> refusal, const Source& source);
  // Checks D-40 and D-43 at the first motion of a selection.
  bool check_radius(const Source& source);

  // The end of the request on an axis that it names.
  [[nodiscard]] double end_on(std::size_t axis, const MoveRequest& request) const {
    return *request.end[axis] + (request.incremental ? target_[axis] : 0);
  }
  // Where new blocks go: they wait while a corner or a lead waits.
  [[nodiscard]] std::vector<Block>& sink() {
    return corner_.waits() || lead_ ? corner_.blocks() : blocks_;
  }
  bool refuse_corner(const Source& source);
  // Refuses the corner that waits for the motion after it, at the place of the corner.
  bool refuse_held_corner();
  bool refuse_open_lead();
  // Whether a motion may have a corner that is cut: at feed, in the plane alone.
  enum class CutCorners : std::uint8_t { possible, impossible };
  [[nodiscard]] CutCorners cut_corners_at(const MoveRequest& request, const Position& end,
                                          const TrackingTravel& tracking) const;
  bool check_corner(const MoveRequest& request, CutCorners corners);
  [[nodiscard]] bool is_corner_interrupted() const;
  bool cut_corner_before(const MoveRequest& request, Segment& path, CutCorners corners);
  [[nodiscard]] bool is_point(const Segment& path) const;
  void hold_for_corner(const MoveRequest& request);
  bool approach_contour(const Segment& contour);
  bool goes_on_from_arc(const Segment& contour);
  [[nodiscard]] ContourEnd contour_end(const Point& point, const Vector& tangent) const;
  [[nodiscard]] TrackingTravel standing_tracking() const;
  void travel_across(const MoveRequest& request);
  void come_down(const PendingLead& pending);
  [[nodiscard]] bool stands_still_at_selection(const MoveRequest& request) const;
  [[nodiscard]] bool leads_back(const MoveRequest& request, const Position& end) const;
  [[nodiscard]] bool is_above_left_contour(const Position& end) const;
  [[nodiscard]] bool find_end(const MoveRequest& request, Position& end) const;
  [[nodiscard]] Refusal end_out_of_range(const MoveRequest& request) const;
  [[nodiscard]] bool all_known() const { return known_[0] && known_[1] && known_[2]; }
  [[nodiscard]] std::string told_increments() const;
  [[nodiscard]] std::optional<Refusal> unknown_start(const MoveRequest& request) const;
  [[nodiscard]] std::optional<std::size_t> axis_of_unknown_start() const;
  // A direct approach that names both axes of the plane ends where it does from wherever the tool
  // comes (D-170).
  [[nodiscard]] bool approaches_from_anywhere(const MoveRequest& request) const;
  // An axis of the plane whose position was never given before the first motion of a selection,
  // which names it ...
  [[nodiscard]] std::optional<std::size_t> axis_of_assumed_start(const MoveRequest& request) const;
  // ... or keeps it, so that the contour would begin there.
  [[nodiscard]] std::optional<std::size_t> axis_kept_from_assumed_start(
      const MoveRequest& request) const;
  bool refuse_assumed_start(const Source& source, std::size_t axis);
  bool move_straight(const MoveRequest& request, const Position& end);
  bool move_on_circle(const MoveRequest& request, const Position& end);
  struct ProgrammedCircle {
    Arc arc{};
    double center_shift = 0;  // mm, by which G165 has corrected the centre
    double width = 0;         // mm, what that does to the arc (width_about())
  };
  // programmed_circle.cpp
  [[nodiscard]] std::optional<Refusal> circle(const MoveRequest& request, const Position& end,
                                              ProgrammedCircle& programmed) const;
  [[nodiscard]] ArcUse use_of_arcs() const {
    return mode_.active() ? ArcUse::with_equidistant : ArcUse::as_programmed;
  }
  // Exactly one of centre and radius must be given, in the plane.
  [[nodiscard]] std::optional<Refusal> check_circle_words(const MoveRequest& request) const;
  [[nodiscard]] Point center_of(const MoveRequest& request, const Point& start,
                                bool absolute) const;
  [[nodiscard]] Refusal misfit(CircleFault&& fault, const MoveRequest& request,
                               const CircleEnds& ends) const;
  [[nodiscard]] DiagnosticPoint standing_point() const {
    return {.x = position_[0], .y = position_[1], .z = position_[2]};
  }
  bool move_tracking(const MoveRequest& request, TrackingTravel& travel);
  bool travel_on_tracking_axes(const MoveRequest& request, TrackingTravel& travel);
  void enter_target(const MoveRequest& request, const Position& end);
  // Source::part of the next motion of a block.
  std::uint8_t part_of(std::uint64_t index) {
    last_part_ = index == last_index_ ? static_cast<std::uint8_t>(last_part_ + 1) : 0;
    last_index_ = index;
    return last_part_;
  }
  // After the first motion of the contour.
  [[nodiscard]] bool is_in_contour() const { return mode_.active() && in_plane_blocks_ > 0; }
  template <class Shape>
  bool append_between_corners(const MoveRequest& request, const Shape& shape, const Position& end,
                              TrackingTravel&& tracking);
  template <class Shape>
  void append_motion(const MoveRequest& request, const Shape& path, const Position& end,
                     TrackingTravel&& tracking, std::vector<Block>& to);
  void append_passive(const MoveRequest& request, const Position& end, TrackingTravel tracking);
  [[nodiscard]] Point last_equidistant_point() const;

  ProgramSetup setup_;
  Tolerances tolerances_;
  Diagnostics& diagnostics_;
  std::vector<Block>& blocks_;

  ToolInForce tool_;
  RadiusTerms terms_in_mode_{};  // those that mode_ has its radius from
  std::uint32_t column_ = 0;
  std::uint32_t center_column_ = 0;  // of the line that is read
  TrcMode mode_;
  std::shared_ptr<const TrcMode> shared_mode_{};  // a copy of mode_; empty: out of date
  Side programmed_side_ = Side::off;              // G41, G42 before a negative radius swaps
  Source selected_{};                             // the G41 or G42 in force
  bool tangential_requested_ = false;
  bool absolute_center_ = false;
  CircleCheck circle_;

  Position position_{};  // where the last block ended
  // As programmed. Differs from position_ by steps that were too short to travel.
  Position target_{};
  std::array<bool, 3> known_{true, true, true};
  std::array<bool, 3> programmed_{};            // a motion has led there
  std::array<Source, 3> position_forgotten_{};  // by what, of the axes that are not known
  std::array<Unknown, 3> why_unknown_{};        // of these
  // A deselection under G239 has left the tool beside the programmed point, and no straight motion
  // in the plane has followed yet.
  bool displaced_ = false;
  bool moves_by_radius_ = false;
  std::vector<RadiusUse> radius_uses_{};
  std::vector<double> tracking_{};  // positions; empty until one is programmed

  // The selection in force, or the last one.
  std::uint32_t selections_ = 0;
  std::uint64_t in_plane_blocks_ = 0;
  bool has_approach_ = false;  // the first of them leads to the contour
  Segment last_path_{};
  std::uint64_t last_index_ = std::numeric_limits<std::uint64_t>::max();
  std::uint8_t last_part_ = 0;
  std::shared_ptr<const TrcMode> last_mode_{};
  bool retract_pending_ = false;
  double left_at_height_ = 0;  // mm, across the plane, where the contour of that retract ended
  std::array<bool, 3> beside_contour_{};
  bool just_deselected_ = false;
  std::optional<Plane> next_plane_{};  // named after a bare G40
  Source increments_since_{};          // where G91 stands last
  HeldCorner corner_{};
  std::optional<PendingLead> lead_{};
  std::optional<ArcToContour> arc_to_contour_{};  // whose next block is still to come
  bool ended_ = false;
};

}  // namespace trc
