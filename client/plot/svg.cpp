#include "client/plot/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "client/plot/arrows.h"
#include "client/plot/frame.h"
#include "client/plot/words.h"
#include "core/base/length_unit.h"

namespace trc::plot {
namespace {

constexpr double widest = 880;
constexpr double tallest = 620;
constexpr double tallest_beside = 260;  // for a further view
constexpr double text_width = 6.7;      // for a letter at 12 pixels, on the safe side
constexpr double line_height = 17;
constexpr double edge = 14;

struct Style {
  Layer layer;
  const char* name;  // of the group
  const char* color;
  const char* width;
  bool dashed = false;  // even if it is no rapid motion
};

constexpr std::array<Style, layer_count> styles{{
    {Layer::beside, "beside", "#555", "0.9"},
    {Layer::lead, "lead", "black", "0.9"},
    {Layer::programmed, "programmed", "black", "2.4"},
    {Layer::replaced, "replaced", "red", "1.6", true},
    {Layer::masked, "masked", "red", "2.4"},
    {Layer::approach, "approach", "blue", "0.8"},
    {Layer::path, "path", "blue", "1.7"},
    {Layer::transition, "transition", "deepskyblue", "2.4"},
    {Layer::proposal, "proposal", "green", "2", true},
}};
constexpr const char* dash = "8 5";

Bounds bounds_of(const Picture& picture) {
  Bounds bounds;
  for (const Stroke& stroke : picture.strokes)
    for (const Segment& segment : stroke.segments) bounds.add(segment);
  for (const ToolCircle& tool : picture.tools) {
    bounds.add(Point(tool.center - Vector::Constant(tool.radius)));
    bounds.add(Point(tool.center + Vector::Constant(tool.radius)));
  }
  for (const Remark& warning : picture.warnings)
    if (warning.place) bounds.add(*warning.place);
  if (picture.fault && picture.fault->place) {
    const Vector room = Vector::Constant(picture.fault->tool_radius);
    bounds.add(Point(*picture.fault->place - room));
    bounds.add(Point(*picture.fault->place + room));
  }
  return bounds;
}

std::string opening(const std::string& title, double width, double height) {
  const std::string w = px(std::ceil(width));
  const std::string h = px(std::ceil(height));
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  text += "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
          "\" viewBox=\"0 0 " + w + " " + h +
          "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n";
  if (!title.empty()) text += "<title>" + escaped(title) + "</title>\n";
  return text + "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
}

class Sheet {
 public:
  // `above`: pixels of the sheet that other views occupy.
  Sheet(const Picture& picture, const SvgOptions& options, double above)
      : picture_(picture),
        options_(options),
        above_(above),
        words_(words_in(picture.language)),
        unit_(picture.inch ? mm_per_inch : 1),
        frame_(fit(bounds_of(picture), widest, above > 0 ? tallest_beside : tallest)) {
    // Both axes have the same step, so that the grid consists of squares.
    const double step = (above > 0 ? 40 : 62) / frame_.scale / unit_;
    across_ = ticks_between(frame_.world.low.x() / unit_, frame_.world.high.x() / unit_, step);
    up_ = ticks_between(frame_.world.low.y() / unit_, frame_.world.high.y() / unit_, step);
    std::size_t longest = 4;
    for (const double at : up_.at) longest = std::max(longest, decimal(at, up_.decimals).size());
    frame_.left = edge + 8 + text_width * static_cast<double>(longest);
    frame_.top = above + edge + (caption().empty() ? 0 : 24);
    width_ = std::max(frame_.left + frame_.width + edge, 360.0);
  }

  // Returns the elements of this view.
  std::string draw() {
    draw_caption();
    draw_grid();
    for (const Style& style : styles) draw_layer(style);
    draw_arrows();
    draw_tools();
    if (options_.points) draw_points();
    if (options_.numbers) draw_numbers();
    draw_warnings();
    draw_fault();
    bottom_ = frame_.top + frame_.height + 42;
    if (above_ > 0) return std::move(body_);
    bottom_ = draw_legend(bottom_);
    bottom_ = draw_texts(bottom_);
    return std::move(body_);
  }
  [[nodiscard]] double width() const { return width_; }
  // Pixels from the top of the sheet to the end of the drawing.
  [[nodiscard]] double bottom() const { return bottom_; }

 private:
  [[nodiscard]] std::string caption() const {
    if (above_ == 0) return picture_.title;
    const auto [first, second] = axis_names(picture_.plane);
    return std::string(words_.plane) + first + second;
  }

  [[nodiscard]] const char* unit() const { return picture_.inch ? "inch" : "mm"; }

  void draw_caption() {
    if (!caption().empty())
      draw_text({frame_.left, above_ + edge + 12}, caption(),
                " font-size=\"14\" font-weight=\"bold\"");
  }

  void draw_line(const Point& from, const Point& to) {
    body_ += "<line x1=\"" + px(from.x()) + "\" y1=\"" + px(from.y()) + "\" x2=\"" + px(to.x()) +
             "\" y2=\"" + px(to.y()) + "\"/>\n";
  }

  void draw_text(const Point& at, const std::string& text, const std::string& attributes) {
    body_ += "<text x=\"" + px(at.x()) + "\" y=\"" + px(at.y()) + "\"" + attributes + ">" +
             escaped(text) + "</text>\n";
  }

  void draw_grid() {
    const double right = frame_.left + frame_.width;
    const double bottom = frame_.top + frame_.height;
    body_ += "<g class=\"grid\" stroke=\"#e4e4e4\" stroke-width=\"1\">\n";
    for (const double at : across_.at)
      draw_line({frame_.x(at * unit_), frame_.top}, {frame_.x(at * unit_), bottom});
    for (const double at : up_.at)
      draw_line({frame_.left, frame_.y(at * unit_)}, {right, frame_.y(at * unit_)});
    body_ += "</g>\n<g class=\"axes\" fill=\"#444\">\n";
    body_ += "<rect x=\"" + px(frame_.left) + "\" y=\"" + px(frame_.top) + "\" width=\"" +
             px(frame_.width) + "\" height=\"" + px(frame_.height) +
             "\" fill=\"none\" stroke=\"#888\"/>\n";
    for (const double at : across_.at)
      draw_text({frame_.x(at * unit_), bottom + 15}, decimal(at, across_.decimals),
                " text-anchor=\"middle\"");
    for (const double at : up_.at)
      draw_text({frame_.left - 6, frame_.y(at * unit_) + 4}, decimal(at, up_.decimals),
                " text-anchor=\"end\"");
    const auto [first, second] = axis_names(picture_.plane);
    draw_text({right, bottom + 30}, std::string(first) + " / " + unit(),
              " text-anchor=\"end\" font-style=\"italic\"");
    draw_text({frame_.left + 6, frame_.top + 15}, std::string(second) + " / " + unit(),
              " font-style=\"italic\"");
    body_ += "</g>\n";
  }

  void draw_layer(const Style& style) {
    for (const bool rapid : {true, false}) {
      bool open = false;
      for (const Stroke& stroke : picture_.strokes) {
        if (stroke.layer != style.layer || stroke.rapid != rapid) continue;
        if (!std::exchange(open, true)) open_layer(style, rapid);
        body_ += "<path d=\"" + path_data(stroke.segments, frame_) + "\"";
        body_ += stroke.title.empty() ? "/>\n"
                                      : "><title>" + escaped(stroke.title) + "</title></path>\n";
      }
      if (open) body_ += "</g>\n";
    }
  }

  void open_layer(const Style& style, bool rapid) {
    body_ += std::string("<g class=\"") + style.name + (rapid ? " rapid" : "") +
             "\" fill=\"none\" stroke=\"" + style.color + "\" stroke-width=\"" + style.width +
             "\" stroke-linejoin=\"round\"" +
             (rapid || style.dashed ? std::string(" stroke-dasharray=\"") + dash + "\""
                                    : std::string(" stroke-linecap=\"round\"")) +
             ">\n";
    shown_.push_back({&style, rapid});
  }

  void draw_arrows() {
    body_ += "<g class=\"arrows\" fill=\"blue\">\n";
    for (const auto& [tip, ahead] : arrows_of(picture_, frame_)) {
      const Vector aside = left_of(ahead);
      body_ += "<path d=\"M" + pair(tip + 6 * ahead) + "L" + pair(tip - 5 * ahead + 4 * aside) +
               "L" + pair(tip - 5 * ahead - 4 * aside) + "Z\"/>\n";
    }
    body_ += "</g>\n";
  }

  // Draws the ends of blocks; of ends that would cover each other only one.
  void draw_points() {
    constexpr double cell = 3;  // pixels
    std::set<std::pair<int, int>> taken;
    body_ += "<g class=\"points\" fill=\"white\" stroke-width=\"1\">\n";
    for (const Stroke& stroke : picture_.strokes) {
      if (stroke.layer == Layer::proposal) continue;
      const bool path = is_path(stroke) || stroke.layer == Layer::transition;
      for (const Point& end : stroke.ends) {
        const Point at = frame_.on_sheet(end);
        if (!taken
                 .insert({static_cast<int>(std::floor(at.x() / cell)),
                          static_cast<int>(std::floor(at.y() / cell))})
                 .second)
          continue;
        body_ += "<circle cx=\"" + px(at.x()) + "\" cy=\"" + px(at.y()) + "\" r=\"2.2\" stroke=\"" +
                 (path ? "blue" : "black") + "\"/>\n";
      }
    }
    body_ += "</g>\n";
  }

  void draw_tools() {
    if (picture_.tools.empty()) return;
    body_ += "<g class=\"tool\" fill=\"#888\" fill-opacity=\"0.12\" stroke=\"#666\">\n";
    for (const ToolCircle& tool : picture_.tools) {
      const Point center = frame_.on_sheet(tool.center);
      body_ += "<circle cx=\"" + px(center.x()) + "\" cy=\"" + px(center.y()) + "\" r=\"" +
               px(tool.radius * frame_.scale) + "\"><title>" + words_.tool_radius +
               decimal(tool.radius / unit_, 6) + " " + unit() + "</title></circle>\n";
    }
    body_ += "</g>\n";
  }

  // Omits a number that would cover another one.
  void draw_numbers() {
    std::set<std::pair<int, int>> taken;
    body_ +=
        "<g class=\"numbers\" font-size=\"11\" fill=\"#222\" stroke=\"white\" stroke-width=\"3\" "
        "paint-order=\"stroke\" text-anchor=\"middle\">\n";
    for (const Label& label : picture_.numbers) {
      // Clear of the contour: beside a vertical line a label needs half its width.
      const double half_width = text_width * static_cast<double>(label.text.size()) / 2;
      const double room = 12 + half_width * std::abs(label.aside.x());
      const Point at = frame_.on_sheet(label.at) + room * Vector(label.aside.x(), -label.aside.y());
      const auto column = static_cast<int>(std::floor(at.x() / 34));
      const auto row = static_cast<int>(std::floor(at.y() / 13));
      if (!taken.insert({column, row}).second) continue;
      draw_text({at.x(), at.y() + 4}, label.text, "");
    }
    body_ += "</g>\n";
  }

  void draw_warnings() {
    bool open = false;
    for (const Remark& warning : picture_.warnings) {
      if (!warning.place) continue;
      if (!std::exchange(open, true))
        body_ += "<g class=\"warning\" stroke=\"#8a6d00\" stroke-width=\"1.2\" fill=\"gold\">\n";
      const Point at = frame_.on_sheet(*warning.place);
      body_ += "<path d=\"M" + pair(at - Vector(0, 9)) + "L" + pair(at + Vector(8, 6)) + "L" +
               pair(at + Vector(-8, 6)) + "Z\"><title>" +
               escaped(warning.text + ". " + warning.remedy) + "</title></path>\n";
    }
    if (open) body_ += "</g>\n";
  }

  void draw_fault() {
    if (!picture_.fault || !picture_.fault->place) return;
    const Point at = frame_.on_sheet(*picture_.fault->place);
    if (picture_.fault->tool_radius > 0)
      body_ += "<circle class=\"fault\" cx=\"" + px(at.x()) + "\" cy=\"" + px(at.y()) + "\" r=\"" +
               px(picture_.fault->tool_radius * frame_.scale) +
               "\" fill=\"red\" fill-opacity=\"0.08\" stroke=\"red\"/>\n";
    body_ +=
        "<g class=\"fault\" stroke=\"red\" stroke-width=\"2.5\" fill=\"none\">\n<circle cx=\"" +
        px(at.x()) + "\" cy=\"" + px(at.y()) + "\" r=\"11\"><title>" +
        escaped(picture_.fault->text + ". " + picture_.fault->remedy) + "</title></circle>\n";
    draw_line(at - Vector(6, 6), at + Vector(6, 6));
    draw_line(at - Vector(6, -6), at + Vector(6, -6));
    body_ += "</g>\n";
  }

  // Lists only layers that the picture shows. Returns where the next part may begin.
  double draw_legend(double y) {
    double x = edge;
    std::sort(shown_.begin(), shown_.end());
    body_ += "<g class=\"legend\">\n";
    const auto entry = [&](const std::string& sample, double sample_width,
                           const std::string& text) {
      const double room = sample_width + 8 + text_width * static_cast<double>(text.size()) + 22;
      if (x > edge && x + room > width_) {
        x = edge;
        y += line_height + 3;
      }
      body_ += "<g transform=\"translate(" + px(x) + " " + px(y) + ")\">" + sample + "</g>\n";
      draw_text({x + sample_width + 8, y + 4}, text, "");
      x += room;
    };
    for (const auto& [style, rapid] : shown_)
      entry(std::string("<line x1=\"0\" y1=\"0\" x2=\"34\" y2=\"0\" stroke=\"") + style->color +
                "\" stroke-width=\"" + style->width + "\"" +
                (rapid || style->dashed ? std::string(" stroke-dasharray=\"") + dash + "\""
                                        : std::string()) +
                "/>",
            34,
            std::string(words_.layers[static_cast<std::size_t>(style->layer)]) +
                (rapid ? words_.rapid : ""));
    if (!picture_.tools.empty())
      entry(
          "<circle cx=\"7\" cy=\"0\" r=\"7\" fill=\"#888\" fill-opacity=\"0.12\" stroke=\"#666\"/>",
          14, words_.tool + std::string(", R ") + radii() + " " + unit());
    body_ += "</g>\n";
    return y + line_height;
  }

  // For example "10, 20": each radius once, in order of use.
  [[nodiscard]] std::string radii() const {
    constexpr std::size_t most_told = 6;
    std::vector<std::string> told;
    for (const ToolCircle& tool : picture_.tools) {
      std::string radius = decimal(tool.radius / unit_, 4);
      if (std::find(told.begin(), told.end(), radius) == told.end())
        told.push_back(std::move(radius));
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(told.size(), most_told); ++i)
      text += (i == 0 ? "" : ", ") + told[i];
    return told.size() > most_told ? text + " …" : text;
  }

  // Writes the first warnings, the error and the first notes, each with its remedy.
  double draw_texts(double y) {
    y = draw_remarks(picture_.warnings, words_.more_warnings, "#8a6d00", y);
    if (picture_.fault) {
      y = draw_wrapped(picture_.fault->text, "red", y + 6);
      y = draw_wrapped(picture_.fault->remedy, "#555", y);
    }
    return draw_remarks(picture_.notes, words_.more_notes, "#222", y);
  }

  double draw_remarks(const std::vector<Remark>& remarks, const char* more, const char* color,
                      double y) {
    constexpr std::size_t most_told = 4;
    const std::size_t told = std::min(remarks.size(), most_told);
    for (std::size_t i = 0; i < told; ++i) {
      y = draw_wrapped(remarks[i].text, color, y + (i == 0 ? 6 : 0));
      // Remarks with the same remedy in a row show it once.
      if (i + 1 == told || remarks[i + 1].remedy != remarks[i].remedy)
        y = draw_wrapped(remarks[i].remedy, "#555", y);
    }
    if (remarks.size() > told)
      y = draw_wrapped(std::to_string(remarks.size() - told) + more, color, y);
    return y;
  }

  double draw_wrapped(const std::string& text, const std::string& color, double y) {
    if (text.empty()) return y;
    const auto letters = static_cast<std::size_t>((width_ - 2 * edge) / text_width);
    for (const std::string& line : wrapped(text, letters)) {
      draw_text({edge, y}, line, " fill=\"" + color + "\"");
      y += line_height;
    }
    return y;
  }

  const Picture& picture_;
  const SvgOptions& options_;
  const double above_;
  const Words& words_;
  const double unit_;  // mm
  Frame frame_;
  Ticks across_;
  Ticks up_;
  double width_ = 0;
  double bottom_ = 0;
  std::vector<std::pair<const Style*, bool>> shown_;
  std::string body_;
};

}  // namespace

std::string to_svg(const Picture& picture, const SvgOptions& options) {
  return to_svg(std::span(&picture, 1), options);
}

std::string to_svg(std::span<const Picture> views, const SvgOptions& options) {
  std::string body;
  double width = 0;
  double height = 0;
  for (const Picture& picture : views) {
    Sheet sheet(picture, options, height);
    body += sheet.draw();
    width = std::max(width, sheet.width());
    height = sheet.bottom();
  }
  return opening(views.empty() ? std::string() : views.front().title, width, height) + body +
         "</svg>\n";
}

}  // namespace trc::plot
