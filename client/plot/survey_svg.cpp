#include "client/plot/survey_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "client/plot/frame.h"
#include "client/plot/svg.h"
#include "client/plot/words.h"
#include "core/base/length_unit.h"

namespace trc::plot {
namespace {

constexpr double widest = 880;
constexpr double tallest = 620;
constexpr double edge = 14;
constexpr double line_height = 19;
constexpr double thinnest = 3;
constexpr double thickest = 14;

// These colors also differ for people with red-green blindness.
constexpr std::array<const char*, 8> colors{"#d55e00", "#0072b2", "#009e73", "#cc79a7",
                                            "#e69f00", "#56b4e9", "#8b5a2b", "#6a3d9a"};

Bounds bounds_of(const SurveyPicture& picture) {
  Bounds bounds;
  for (const Segment& segment : picture.contour) bounds.add(segment);
  for (const SurveyPicture::Radius& radius : picture.radii)
    if (radius.refused_at) bounds.add(*radius.refused_at);
  return bounds;
}

class Drawing {
 public:
  explicit Drawing(const SurveyPicture& picture)
      : picture_(picture), frame_(fit(bounds_of(picture), widest, tallest)) {
    frame_.left = edge;
    frame_.top = edge + (picture.title.empty() ? 0 : 24);
    for (std::size_t i = 0; i < picture.radii.size(); ++i) by_size_.push_back(i);
    std::stable_sort(by_size_.begin(), by_size_.end(), [&](std::size_t a, std::size_t b) {
      return picture.radii[a].radius > picture.radii[b].radius;
    });
  }

  std::string draw() {
    draw_field();
    draw_strokes("contour", "black", 1.6, picture_.contour);
    for (std::size_t rank = 0; rank < by_size_.size(); ++rank) {
      const SurveyPicture::Radius& radius = picture_.radii[by_size_[rank]];
      draw_strokes("uncut", color_of(rank), width_of(rank), radius.uncut);
    }
    draw_strokes("limits", "black", 4, picture_.limits);
    for (std::size_t rank = 0; rank < by_size_.size(); ++rank) draw_refusal(rank);
    const double height = draw_legend(frame_.top + frame_.height + 34);
    const std::string size = "\" width=\"" + px(width()) + "\" height=\"" + px(height) +
                             "\" viewBox=\"0 0 " + px(width()) + " " + px(height);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<svg xmlns=\"http://www.w3.org/2000/svg" +
           size +
           "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n"
           "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
           body_ + "</svg>\n";
  }

 private:
  [[nodiscard]] double width() const { return std::max(frame_.width + 2 * edge, 420.0); }
  [[nodiscard]] static const char* color_of(std::size_t rank) {
    return colors[rank % colors.size()];
  }
  // The largest radius is drawn first, below the others, and is the widest.
  [[nodiscard]] double width_of(std::size_t rank) const {
    const std::size_t last = by_size_.size() - 1;
    if (last == 0) return thinnest;
    const double share = static_cast<double>(rank) / static_cast<double>(last);
    return thickest + share * (thinnest - thickest);
  }

  void draw_text(const Point& at, const std::string& text, const std::string& attributes) {
    body_ += "<text x=\"" + px(at.x()) + "\" y=\"" + px(at.y()) + "\"" + attributes + ">" +
             escaped(text) + "</text>\n";
  }

  void draw_field() {
    if (!picture_.title.empty()) {
      body_ += "<title>" + escaped(picture_.title) + "</title>\n";
      draw_text({edge, edge + 12}, picture_.title, " font-size=\"14\" font-weight=\"bold\"");
    }
    body_ += "<rect x=\"" + px(frame_.left) + "\" y=\"" + px(frame_.top) + "\" width=\"" +
             px(frame_.width) + "\" height=\"" + px(frame_.height) +
             "\" fill=\"none\" stroke=\"#888\"/>\n";
    const auto [first, second] = axis_names(picture_.plane);
    const Point low = frame_.world.low;
    const Point high = frame_.world.high;
    const auto length = [&](double mm) {
      return picture_.inch ? decimal(mm / mm_per_inch, 3) : decimal(mm, 2);
    };
    const std::string reach = std::string(first) + " " + length(low.x()) + " … " +
                              length(high.x()) + ", " + second + " " + length(low.y()) + " … " +
                              length(high.y()) + (picture_.inch ? " in" : " mm");
    draw_text({edge, frame_.top + frame_.height + 15}, reach, " fill=\"#444\"");
  }

  void draw_strokes(const char* name, const char* color, double stroke_width,
                    const std::vector<Segment>& segments) {
    if (segments.empty()) return;
    body_ += std::string("<path class=\"") + name + "\" fill=\"none\" stroke=\"" + color +
             "\" stroke-width=\"" + px(stroke_width) + "\" d=\"" + path_data(segments, frame_) +
             "\"/>\n";
  }

  void draw_refusal(std::size_t rank) {
    const SurveyPicture::Radius& radius = picture_.radii[by_size_[rank]];
    if (!radius.refused_at) return;
    const Point at = frame_.on_sheet(*radius.refused_at);
    const double size = 6 + 2 * static_cast<double>(rank % colors.size());
    body_ += std::string("<path class=\"refused\" fill=\"none\" stroke-width=\"2\" stroke=\"") +
             color_of(rank) + "\" d=\"M" + pair(at - Vector(size, size)) + "L" +
             pair(at + Vector(size, size)) + "M" + pair(at - Vector(size, -size)) + "L" +
             pair(at + Vector(size, -size)) + "\"><title>" + escaped(radius.text) +
             "</title></path>\n";
  }

  // Returns the end of the sheet.
  double draw_legend(double y) {
    const auto entry = [&](const char* color, double stroke_width, const std::string& text) {
      body_ += "<line x1=\"" + px(edge) + "\" y1=\"" + px(y) + "\" x2=\"" + px(edge + 34) +
               "\" y2=\"" + px(y) + "\" stroke=\"" + color + "\" stroke-width=\"" +
               px(stroke_width) + "\"/>\n";
      draw_text({edge + 42, y + 4}, text, "");
      y += line_height;
    };
    entry("black", 1.6,
          words_in(picture_.language).layers[static_cast<std::size_t>(Layer::programmed)]);
    for (std::size_t rank = 0; rank < by_size_.size(); ++rank)
      entry(color_of(rank), width_of(rank), picture_.radii[by_size_[rank]].text);
    if (!picture_.largest.empty()) entry("black", 4, picture_.largest);
    return y + edge;
  }

  const SurveyPicture& picture_;
  Frame frame_;
  std::vector<std::size_t> by_size_;  // indices of the radii, the largest first
  std::string body_;
};

}  // namespace

std::string to_svg(const SurveyPicture& picture) { return Drawing(picture).draw(); }

}  // namespace trc::plot
