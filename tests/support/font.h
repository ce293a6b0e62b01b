#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/geometry/segment.h"

namespace trc::support {

// A TrueType font, read when a test runs.
class Font {
 public:
  // Throws where the file cannot be read.
  explicit Font(const std::string& file);
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font();

  struct Drawing {
    double height = 40;  // of capitals, about, mm
    int chords = 6;      // in place of a curve
  };
  // The outlines of a letter as closed polygons, without the first point again.
  [[nodiscard]] std::vector<std::vector<Point>> rings_of(char32_t letter,
                                                         const Drawing& drawing) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace trc::support
