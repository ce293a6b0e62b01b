#include <ft2build.h>
#include <gtest/gtest.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/drawn_rings.h"

// Loop removal on outlines nobody has drawn for it: the letters of Debian's fonts, read when the
// test runs, as an engraver takes them round. GEOS and the distance from every block judge.

namespace trc::support {
namespace {

constexpr const char* fonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                 "/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf",
                                 "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"};

bool is_long() { return std::getenv("TRC_TEST_LONG") != nullptr; }

// Closed polygons of a font, without the last point again.
class Font {
 public:
  explicit Font(const char* file) {
    if (FT_Init_FreeType(&library_) != 0 || FT_New_Face(library_, file, 0, &face_) != 0)
      throw std::runtime_error(std::string(file) + " cannot be read");
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }

  // Of capitals of about `height` mm; curves in `chords` each.
  [[nodiscard]] std::vector<std::vector<Point>> rings_of(char32_t letter, double height,
                                                         int chords) const {
    Drawn drawn{.scale = height / face_->units_per_EM, .chords = chords};
    if (FT_Load_Char(face_, letter, FT_LOAD_NO_SCALE) != 0) return {};
    static constexpr FT_Outline_Funcs visits{
        .move_to = [](const FT_Vector* to, void* user) { return begin(*to, user); },
        .line_to = [](const FT_Vector* to, void* user) { return line(*to, user); },
        .conic_to = [](const FT_Vector* control, const FT_Vector* to,
                       void* user) { return curve(*control, *to, user); },
        .cubic_to = [](const FT_Vector*, const FT_Vector*, const FT_Vector* to,
                       void* user) { return line(*to, user); },
        .shift = 0,
        .delta = 0};
    FT_Outline_Decompose(&face_->glyph->outline, &visits, &drawn);
    for (auto& ring : drawn.rings)
      if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    return drawn.rings;
  }

 private:
  struct Drawn {
    double scale = 1;
    int chords = 1;
    std::vector<std::vector<Point>> rings{};

    [[nodiscard]] Point place(const FT_Vector& at) const {
      return scale * Point(static_cast<double>(at.x), static_cast<double>(at.y));
    }
    void add(const Point& point) {
      if (rings.back().empty() || rings.back().back() != point) rings.back().push_back(point);
    }
  };
  static int begin(const FT_Vector& to, void* user) {
    auto& drawn = *static_cast<Drawn*>(user);
    drawn.rings.emplace_back();
    drawn.add(drawn.place(to));
    return 0;
  }
  static int line(const FT_Vector& to, void* user) {
    auto& drawn = *static_cast<Drawn*>(user);
    drawn.add(drawn.place(to));
    return 0;
  }
  static int curve(const FT_Vector& control, const FT_Vector& to, void* user) {
    auto& drawn = *static_cast<Drawn*>(user);
    const Point start = drawn.rings.back().back();
    const Point middle = drawn.place(control);
    const Point end = drawn.place(to);
    for (int k = 1; k <= drawn.chords; ++k) {
      const double t = static_cast<double>(k) / drawn.chords;
      drawn.add((1 - t) * (1 - t) * start + 2 * t * (1 - t) * middle + t * t * end);
    }
    return 0;
  }

  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

TEST(RealShapes, LettersAreGoneRoundAndAreEmptied) {
  Geos geos;
  Tally tally;
  const char32_t last = is_long() ? U'\u24ff' : U'z';
  for (const char* file : fonts) {
    const Font font(file);
    for (char32_t letter = U'!'; letter <= last; letter += is_long() ? 1 : 3)
      for (const auto& ring : font.rings_of(letter, 40, 6)) {
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
