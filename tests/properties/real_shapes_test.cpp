#include <ft2build.h>
#include <gtest/gtest.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/buffer_judge.h"
#include "tests/support/run.h"
#include "tests/support/slow_clearance.h"
#include "tests/support/slow_shapes.h"

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

// Of the middle of an edge, the other edges being farther.
bool has_room(const std::vector<Segment>& edges, const Point& tool, double radius) {
  return std::all_of(edges.begin(), edges.end(), [&](const Segment& edge) {
    return slow_distance(tool, edge) >= radius * (1 - 1e-9);
  });
}

// Begun in the middle of an edge where the tool has room; none where there is none. Coordinates of
// three decimals.
std::vector<Segment> begun_with_room(std::vector<Point> ring, const TrcMode& mode) {
  for (Point& point : ring)
    point = Point(std::round(1e3 * point.x()) / 1e3, std::round(1e3 * point.y()) / 1e3);
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  const double shift = mode.side == Side::left ? mode.tool_radius : -mode.tool_radius;
  std::vector<Segment> edges;
  for (std::size_t k = 0; k < ring.size(); ++k)
    edges.emplace_back(Line{.start = ring[k], .end = ring[(k + 1) % ring.size()]});
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point& end = ring[(k + 1) % ring.size()];
    const Vector along = end - ring[k];
    if (along.norm() < 0.01) continue;
    Point begin = ring[k] + 0.5 * along;
    begin = Point(std::round(1e3 * begin.x()) / 1e3, std::round(1e3 * begin.y()) / 1e3);
    if (begin == end || begin == ring[k]) continue;
    const Point tool = begin + shift * Vector(-along.y(), along.x()).normalized();
    if (!has_room(edges, tool, mode.tool_radius)) continue;
    std::rotate(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(k), edges.end());
    edges.front() = Line{.start = begin, .end = end};
    edges.emplace_back(Line{.start = ring[k], .end = begin});
    return edges;
  }
  return {};
}

struct Tally {
  std::size_t compared = 0;
  std::size_t refused = 0;
  std::size_t different = 0;
};

void judge(Geos& geos, const std::vector<Segment>& edges, const TrcMode& mode, Tally& tally) {
  const auto outline = points_along(edges, 1e-4 * mode.tool_radius);
  if (!geos.is_simple(geos.polygon(outline))) return;
  Contour contour;
  contour.blocks = edges;
  const Point first = point_at(edges.front(), 0);
  contour.approach = {.start = first + Vector(1000, 300), .end = first};
  contour.retract = {.start = first, .end = first + Vector(1000, -300)};
  const Outcome outcome = compensate(contour, mode, {.batch = 0});
  ++tally.compared;
  if (outcome.stopped) {
    ++tally.refused;
    ADD_FAILURE() << message_of(*outcome.error()) << '\n' << contour;
    return;
  }
  std::vector<Segment> path;
  for (const CompensatedBlock& block : moving(outcome.blocks))
    if (block.origin == Origin::programmed || block.origin == Origin::transition)
      path.push_back(block.path);
  ASSERT_FALSE(path.empty());
  const double radius = mode.tool_radius;
  EXPECT_GE(least_distance(path, edges).distance, radius - 1e-4) << contour;
  if (mode.transition == Transition::linear) return;
  const auto difference = difference_of(geos, outline, outcome, mode);
  // GEOS simplifies what it widens by up to a hundredth of the radius.
  if (!difference || difference->farthest > 0.02 * radius ||
      difference->area > 0.02 * radius * difference->length) {
    ++tally.different;
    std::cout << "different: R " << radius << ", " << (difference ? difference->farthest : -1)
              << " off\n";
  }
}

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
              TrcMode mode;
              mode.side = side;
              mode.tool_radius = radius;
              mode.selection = mode.deselection = Selection::direct;
              mode.transition = transition;
              mode.masking = Masking::on;
              mode.options.remove_masked_blocks = true;
              SCOPED_TRACE(std::string(file) + ", letter " +
                           std::to_string(static_cast<unsigned>(letter)) + ", " + text_of(mode));
              const auto edges = begun_with_room(ring, mode);
              if (!edges.empty()) judge(geos, edges, mode, tally);
            }
      }
  }
  EXPECT_GT(tally.compared, 300U);
  // A neck as wide as the tool may be open here and closed there.
  EXPECT_LE(200 * tally.different, tally.compared);
  std::cout << tally.compared << " compared, " << tally.refused << " refused, " << tally.different
            << " different\n";
}

}  // namespace
}  // namespace trc::support
