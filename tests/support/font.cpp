#include "tests/support/font.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <stdexcept>

namespace trc::support {
namespace {

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

int begin(const FT_Vector& to, void* user) {
  auto& drawn = *static_cast<Drawn*>(user);
  drawn.rings.emplace_back();
  drawn.add(drawn.place(to));
  return 0;
}

int line(const FT_Vector& to, void* user) {
  auto& drawn = *static_cast<Drawn*>(user);
  drawn.add(drawn.place(to));
  return 0;
}

int curve(const FT_Vector& control, const FT_Vector& to, void* user) {
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

}  // namespace

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
};

Font::Font(const std::string& file) : face_(std::make_unique<Face>()) {
  if (FT_Init_FreeType(&face_->library) != 0 ||
      FT_New_Face(face_->library, file.c_str(), 0, &face_->face) != 0)
    throw std::runtime_error(file + " cannot be read");
}

Font::~Font() {
  FT_Done_Face(face_->face);
  FT_Done_FreeType(face_->library);
}

std::vector<std::vector<Point>> Font::rings_of(char32_t letter, const Drawing& drawing) const {
  FT_Face face = face_->face;
  Drawn drawn{.scale = drawing.height / face->units_per_EM, .chords = drawing.chords};
  if (FT_Load_Char(face, letter, FT_LOAD_NO_SCALE) != 0) return {};
  static constexpr FT_Outline_Funcs visits{
      .move_to = [](const FT_Vector* to, void* user) { return begin(*to, user); },
      .line_to = [](const FT_Vector* to, void* user) { return line(*to, user); },
      .conic_to = [](const FT_Vector* control, const FT_Vector* to,
                     void* user) { return curve(*control, *to, user); },
      .cubic_to = [](const FT_Vector*, const FT_Vector*, const FT_Vector* to,
                     void* user) { return line(*to, user); },
      .shift = 0,
      .delta = 0};
  FT_Outline_Decompose(&face->glyph->outline, &visits, &drawn);
  for (auto& ring : drawn.rings)
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return drawn.rings;
}

}  // namespace trc::support
