#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/nc/dialect/line_words.h"
#include "core/nc/state/lead.h"

namespace trc {

// Where RL or RR stands in a block of Klartext that is not read; npos: nowhere.
[[nodiscard]] std::size_t place_of_klartext_side(std::string_view block);

// Whether a line has a block number or begins as blocks do: then a comment that seemed to go on has
// ended before it (D-61).
[[nodiscard]] bool begins_klartext_block(std::string_view line);

// The block in capitals, with single blanks, without quoted texts and without what follows `;`.
[[nodiscard]] std::string statement_of(std::string_view text);
// The label of such a statement that begins at `begin`, as LBL 1, LBL "A" or CALL LBL 1 REP 3: 1,
// or "A as it is written.
[[nodiscard]] std::string label_of(std::string_view text, std::size_t begin,
                                   std::string_view statement);
// Whether RL or RR stands in such a statement, also after other letters without a blank.
[[nodiscard]] bool has_side(std::string_view statement);
// Whether R0 stands in it after other letters without a blank: XR0.
[[nodiscard]] bool has_glued_r0(std::string_view statement);
[[nodiscard]] bool begins_with_word(std::string_view statement, std::string_view word);

// The statement that a block of Klartext that may move begins with.
enum class KlartextStatement : std::uint8_t {
  none,  // M words alone
  straight,
  polar_line,
  center,       // CC
  circle,       // C
  radius_arc,   // CR
  tangent_arc,  // CT
  polar_circle,
  polar_tangent_arc,
  rounding,
  chamfer,
  approach,
  departure,
};

// Why a block is not followed, or not allowed in a contour, and the word that causes it.
struct KlartextObstacle {
  enum class Why : std::uint8_t {
    variable,
    machine_coordinates,   // M91, M92
    untilted_coordinates,  // M130
    retract_along_tool,    // M140
    cycle_call,            // M89, M99
    corners_of_small_steps,
    open_corners,
    tip_is_led,  // M114, M128, M144
    feed_per_turn,
    // These concern the whole block, not one word:
    across_the_plane,  // an arc or a pole
    may_be_skipped,
    changed_radius,
    changed_coordinates,
    unknown_place,  // polar, from there or about a pole that is not known
  };

  [[nodiscard]] Code code() const {
    return why == Why::may_be_skipped ? Code::block_skip_undecided : Code::nc_unsupported;
  }

  Why why{};
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

// The words of a block that may move, before any of them takes effect.
struct KlartextBlock {
  struct Value {
    double value = 0;
    bool increment = false;
    std::uint32_t begin = 0;
  };

  [[nodiscard]] bool is(KlartextStatement other) const { return statement == other; }
  [[nodiscard]] bool has_variable() const {
    return unfollowed && unfollowed->why == KlartextObstacle::Why::variable;
  }
  // Marks the whole block as not followed.
  void leave_unfollowed(KlartextObstacle::Why why) {
    unfollowed = {.why = why, .begin = begin, .end = begin};
  }
  // L, LP and the arcs.
  [[nodiscard]] bool is_motion() const {
    return statement != KlartextStatement::none && statement != KlartextStatement::center &&
           statement < KlartextStatement::rounding;
  }
  [[nodiscard]] bool is_corner() const {
    return statement == KlartextStatement::rounding || statement == KlartextStatement::chamfer;
  }
  // RL, RR
  [[nodiscard]] bool selects() const { return side && *side != Side::off; }
  // For messages: CR, APPR PLT, M.
  [[nodiscard]] std::string title() const {
    std::string title(name.empty() ? "M" : name);
    if (!form.empty()) title.append(polar_lead ? " P" : " ").append(form);
    return title;
  }
  [[nodiscard]] bool is_lead() const { return statement >= KlartextStatement::approach; }
  [[nodiscard]] bool is_polar() const {
    return statement == KlartextStatement::polar_line ||
           statement == KlartextStatement::polar_circle ||
           statement == KlartextStatement::polar_tangent_arc || polar_lead;
  }
  [[nodiscard]] bool names_axes() const {
    return end[0] || end[1] || end[2] || by_parameter[0] || by_parameter[1] || by_parameter[2] ||
           !tracking.empty() || polar_radius || polar_angle;
  }

  KlartextStatement statement = KlartextStatement::none;
  std::string_view name{};  // of the statement; M words alone have none
  std::string_view form{};  // LT LN CT LCT of a lead
  std::uint32_t begin = 0;
  std::array<std::optional<Value>, 3> end{};
  std::vector<std::optional<double>> tracking{};
  std::uint64_t tracking_increments = 0;
  std::optional<Value> polar_radius{};
  std::optional<Value> polar_angle{};   // degrees
  std::optional<Value> radius{};        // R of CR and of leads, RND
  std::optional<Value> length{};        // LEN, CHF
  std::optional<Value> center_angle{};  // CCA, degrees
  std::optional<bool> clockwise{};      // DR
  std::optional<Side> side{};           // RL RR R0
  std::uint32_t side_begin = 0;
  std::optional<Value> feed{};
  bool feed_lacks_number = false;  // F stands alone: MAX or AUTO may follow, else it says nothing
  bool rapid = false;
  bool called_feed = false;  // F AUTO
  Lead lead{};
  bool polar_lead = false;
  bool to_skip = false;
  // From M words and the words that belong to them.
  bool ignores_words = false;   // M118, M128 …: what follows is theirs
  bool ignores_places = false;  // M118: X Y Z too, its limits
  bool calls_cycle = false;     // M99, M89
  bool machine_place = false;   // M91, M92
  bool feed_per_turn = false;
  // The place of a feed that is passed on as it stands: FQ1, FU, FZ.
  std::optional<std::uint32_t> open_feed{};
  // The axes whose place is a parameter, and whether something else is one.
  std::array<bool, 3> by_parameter{};
  bool other_parameter = false;
  std::optional<bool> masks{};                  // M120
  std::optional<FeedAdaptation> adapts_feed{};  // M109 M110 M111
  AxisBits leaves_on = 0;                       // an arc across the plane, which moves these
  // A parameter, M91 …: the block is copied while TRC is off.
  std::optional<KlartextObstacle> unfollowed{};
  // M97 and others, which are not allowed in a contour nor beside RL.
  std::optional<KlartextObstacle> not_in_contour{};
};

// An arc with a centre or a radius, as opposed to a tangential arc.
[[nodiscard]] inline bool is_arc_of(KlartextStatement statement) {
  using enum KlartextStatement;
  return statement == circle || statement == radius_arc || statement == polar_circle;
}

}  // namespace trc
