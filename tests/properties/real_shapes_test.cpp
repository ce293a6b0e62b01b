#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "tests/support/drawn_rings.h"
#include "tests/support/font.h"
#include "tests/support/long_run.h"

// Loop removal on outlines nobody has drawn for it: the letters of Debian's fonts, read when the
// test runs, as an engraver takes them round. GEOS and the distance from every block judge.

namespace trc::support {
namespace {

constexpr const char* fonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                 "/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf",
                                 "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"};

TEST(RealShapes, LettersAreGoneRoundAndAreEmptied) {
  Geos geos;
  Tally tally;
  const char32_t last = is_long_run() ? U'\u24ff' : U'z';
  for (const char* file : fonts) {
    const Font font(file);
    for (char32_t letter = U'!'; letter <= last; letter += is_long_run() ? 1 : 3)
      for (const auto& ring : font.rings_of(letter, {.height = 40, .chords = 6})) {
        if (ring.size() < 3) continue;
        for (const double radius : {0.3, 1.0, 3.0, 7.0})
          for (const Side side : {Side::left, Side::right})
            for (const Transition transition : {Transition::circular, Transition::linear}) {
              const TrcMode mode = mode_of_ring(radius, side, transition);
              SCOPED_TRACE(std::string(file) + ", letter " +
                           std::to_string(static_cast<unsigned>(letter)) + ", " + text_of(mode));
              const auto edges = begun_with_room(ring, mode);
              if (!edges.empty()) judge(geos, edges, mode, tally);
            }
      }
  }
  EXPECT_GT(tally.compared, 300U);
  EXPECT_TRUE(tally.agrees());
  std::cout << tally.text() << '\n';
}

}  // namespace
}  // namespace trc::support
