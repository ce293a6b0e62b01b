#include "core/nc/dialect/klartext_functions.h"

#include <optional>

#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_effects.h"
#include "core/nc/dialect/klartext_statements.h"
#include "core/nc/dialect/reading.h"

// M functions of Klartext.

namespace trc {
namespace {

using Why = KlartextObstacle::Why;

// Why a block with this M function is not followed; empty: it is followed. `active`: TRC is active.
std::optional<Why> why_unfollowed(int m, bool active) {
  switch (m) {
    case 91:
    case 92:
      return Why::machine_coordinates;
    case 130:
      return Why::untilted_coordinates;
    case 140:
      return Why::retract_along_tool;
    default:
      break;
  }
  if (!active) return {};
  switch (m) {
    case 89:
    case 99:
      return Why::cycle_call;
    case 97:
      return Why::corners_of_small_steps;
    case 98:
      return Why::open_corners;
    case 114:
    case 128:
    case 144:
      return Why::tip_is_led;
    case 136:
      return Why::feed_per_turn;
    default:
      return {};
  }
}

WordRole role_of_function(int m) {
  const bool stops = (m >= 0 && m <= 2) || m == 30;
  const bool shapes_contour = (m >= 109 && m <= 111) || m == 120;
  return stops ? WordRole::stop : shapes_contour ? WordRole::trc : WordRole::technology;
}

void take_klartext_function(Reading& reading, int m, KlartextBlock& block) {
  take_klartext_effects(reading, effects_of_function(m));
  switch (m) {
    case 89:
    case 99:
      block.calls_cycle = true;
      break;
    case 91:
    case 92:
      block.machine_place = true;
      break;
    case 109:
    case 110:
    case 111:
      // M110 is like CFIN if it reduces the feed (D-125).
      block.adapts_feed = m == 109   ? FeedAdaptation::on
                          : m == 110 ? FeedAdaptation::inside
                                     : FeedAdaptation::off;
      break;
    case 120:
      block.masks = false;  // LA gives the look-ahead (D-134)
      break;
    case 136:
      block.feed_per_turn = true;
      break;
    case 94:
    case 103:
    case 112:
    case 114:
    case 128:
    case 144:
      block.ignores_words = true;
      break;
    case 118:
      block.ignores_words = block.ignores_places = true;
      break;
    case 124:
    case 138:
    case 140:
    case 197:
    case 200:  // 200 to 204: V, the voltage of a laser
    case 201:
    case 202:
    case 203:
    case 204:
      block.ignores_words = true;
      break;
    default:
      break;
  }
}

}  // namespace

bool read_klartext_function(Reading& reading, const KlartextWord& word, ProgramLine& line,
                            KlartextBlock& block) {
  // A higher number is unknown to every control: a function of the machine.
  constexpr double most = 9999;
  const int m = word.value >= 0 && word.value <= most ? static_cast<int>(word.value) : -1;
  const auto note = [&](std::optional<Why> why, std::optional<KlartextObstacle>& obstacle) {
    if (why && !obstacle) obstacle = {.why = *why, .begin = word.begin, .end = word.end};
  };
  note(why_unfollowed(m, reading.trc_active()), block.unfollowed);
  note(why_unfollowed(m, true), block.not_in_contour);
  line.ends_program |= m == 2 || m == 30;
  take_klartext_function(reading, m, block);
  add(line, word, role_of_function(m));
  return true;
}

}  // namespace trc
