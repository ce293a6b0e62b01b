#include "client/plot/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "client/plot/frame.h"

namespace trc::plot {
namespace {

constexpr double widest = 880;
constexpr double tallest = 620;
constexpr double text_width = 6.7;  // of a letter at 12 pixels, on the safe side
constexpr double line_height = 17;
constexpr double edge = 14;

struct Style {
  Layer layer;
  const char* name;  // of the group
  const char* color;
  const char* width;
  const char* legend;
  bool dashed = false;  // also where it is no rapid motion
};

constexpr std::array<Style, 7> styles{{
    {Layer::lead, "lead", "black", "0.9", "lead-in, lead-out"},
    {Layer::programmed, "programmed", "black", "2.4", "programmed contour"},
    {Layer::replaced, "replaced", "red", "1.6", "as programmed, replaced", true},
    {Layer::masked, "masked", "red", "2.4", "masked or removed"},
    {Layer::path, "path", "blue", "1.5", "compensated path"},
    {Layer::transition, "transition", "deepskyblue", "2.4", "transition block"},
    {Layer::proposal, "proposal", "green", "2", "proposed instead", true},
}};
constexpr const char* dash = "8 5";

std::array<const char*, 2> axis_names(Plane plane) {
  switch (plane) {
    case Plane::zx:
      return {"Z", "X"};
    case Plane::yz:
      return {"Y", "Z"};
    case Plane::xy:
      break;
  }
  return {"X", "Y"};
}

std::string px(double value) { return decimal(value, 3); }
std::string pair(const Point& point) { return px(point.x()) + " " + px(point.y()); }

Bounds bounds_of(const Picture& picture) {
  Bounds bounds;
  for (const Stroke& stroke : picture.strokes)
    for (const Segment& segment : stroke.segments) bounds.add(segment);
  for (const ToolCircle& tool : picture.tools) {
    bounds.add(Point(tool.center - Vector::Constant(tool.radius)));
    bounds.add(Point(tool.center + Vector::Constant(tool.radius)));
  }
  for (const Warning& warning : picture.warnings)
    if (warning.place) bounds.add(*warning.place);
  if (picture.fault && picture.fault->place) {
    const Vector room = Vector::Constant(picture.fault->tool_radius);
    bounds.add(Point(*picture.fault->place - room));
    bounds.add(Point(*picture.fault->place + room));
  }
  return bounds;
}

// Words of `text` in lines of at most `most` letters.
std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
  std::vector<std::string> lines;
  std::string rest = text;
  while (rest.size() > most) {
    std::size_t cut = rest.rfind(' ', most);
    if (cut == std::string::npos || cut == 0) cut = most;
    lines.push_back(rest.substr(0, cut));
    rest.erase(0, rest.find_first_not_of(' ', cut));
  }
  lines.push_back(rest);
  return lines;
}

class Sheet {
 public:
  Sheet(const Picture& picture, const SvgOptions& options)
      : picture_(picture), options_(options), frame_(fit(bounds_of(picture), widest, tallest)) {
    // One step for both axes, so that the grid shows squares.
    const double step = 62 / frame_.scale;
    across_ = ticks_between(frame_.world.low.x(), frame_.world.high.x(), step);
    up_ = ticks_between(frame_.world.low.y(), frame_.world.high.y(), step);
    std::size_t longest = 4;
    for (const double mm : up_.at) longest = std::max(longest, decimal(mm, up_.decimals).size());
    frame_.left = edge + 8 + text_width * static_cast<double>(longest);
    frame_.top = edge + (picture.title.empty() ? 0 : 24);
    width_ = std::max(frame_.left + frame_.width + edge, 360.0);
  }

  std::string draw() {
    draw_grid();
    for (const Style& style : styles) draw_layer(style);
    draw_arrows();
    draw_tools();
    if (options_.numbers) draw_numbers();
    draw_warnings();
    draw_fault();
    double below = frame_.top + frame_.height + 42;
    below = draw_legend(below);
    below = draw_texts(below);
    return opening(below) + body_ + "</svg>\n";
  }

 private:
  [[nodiscard]] std::string opening(double height) const {
    const std::string w = px(std::ceil(width_));
    const std::string h = px(std::ceil(height));
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    text += "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
            "\" viewBox=\"0 0 " + w + " " + h +
            "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n";
    if (!picture_.title.empty()) text += "<title>" + escaped(picture_.title) + "</title>\n";
    text += "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    if (!picture_.title.empty())
      text += "<text x=\"" + px(frame_.left) + "\" y=\"" + px(edge + 12) +
              "\" font-size=\"14\" font-weight=\"bold\">" + escaped(picture_.title) + "</text>\n";
    return text;
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
    for (const double mm : across_.at)
      draw_line({frame_.x(mm), frame_.top}, {frame_.x(mm), bottom});
    for (const double mm : up_.at) draw_line({frame_.left, frame_.y(mm)}, {right, frame_.y(mm)});
    body_ += "</g>\n<g class=\"axes\" fill=\"#444\">\n";
    body_ += "<rect x=\"" + px(frame_.left) + "\" y=\"" + px(frame_.top) + "\" width=\"" +
             px(frame_.width) + "\" height=\"" + px(frame_.height) +
             "\" fill=\"none\" stroke=\"#888\"/>\n";
    for (const double mm : across_.at)
      draw_text({frame_.x(mm), bottom + 15}, decimal(mm, across_.decimals),
                " text-anchor=\"middle\"");
    for (const double mm : up_.at)
      draw_text({frame_.left - 6, frame_.y(mm) + 4}, decimal(mm, up_.decimals),
                " text-anchor=\"end\"");
    const auto [first, second] = axis_names(picture_.plane);
    draw_text({right, bottom + 30}, std::string(first) + " / mm",
              " text-anchor=\"end\" font-style=\"italic\"");
    draw_text({frame_.left + 6, frame_.top + 15}, std::string(second) + " / mm",
              " font-style=\"italic\"");
    body_ += "</g>\n";
  }

  // One elliptical arc command spans at most half a turn: at more, the flag for
  // the larger arc would hang on how the ends were rounded.
  void append_arc(std::string& d, const Arc& arc) const {
    const double radius = (arc.start - arc.center).norm() * frame_.scale;
    const bool halved = std::abs(arc.sweep) > std::numbers::pi * (1 + 1e-9);
    // Seen from above, y upwards, counter-clockwise is positive; on the sheet y
    // runs down, where SVG calls the same sense 0.
    const char* sense = arc.sweep > 0 ? "0" : "1";
    const auto append = [&](const Point& to) {
      d += "A" + px(radius) + " " + px(radius) + " 0 0 " + sense + " " + pair(frame_.on_sheet(to));
    };
    if (halved) append(place_at(arc, 0.5).point);
    append(arc.end);
  }

  [[nodiscard]] std::string path_data(const std::vector<Segment>& segments) const {
    std::string d;
    std::optional<Point> reached;
    for (const Segment& segment : segments) {
      const Place start = place_at(segment, 0);
      if (!reached || *reached != start.point) d += "M" + pair(frame_.on_sheet(start.point));
      const Place end = place_at(segment, 1);
      const auto* arc = std::get_if<Arc>(&segment);
      if (arc && (arc->start - arc->center).norm() * frame_.scale > 0.01) {
        append_arc(d, *arc);
      } else {
        d += "L" + pair(frame_.on_sheet(end.point));
      }
      reached = end.point;
    }
    return d;
  }

  void draw_layer(const Style& style) {
    for (const bool rapid : {true, false}) {
      bool open = false;
      for (const Stroke& stroke : picture_.strokes) {
        if (stroke.layer != style.layer || stroke.rapid != rapid) continue;
        if (!std::exchange(open, true)) open_layer(style, rapid);
        body_ += "<path d=\"" + path_data(stroke.segments) + "\"";
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

  // At most eighty arrows, at least a hundred pixels of path apart, each in the
  // middle of a piece that is long enough to carry it.
  void draw_arrows() {
    double whole = 0;
    for (const Stroke& stroke : picture_.strokes)
      if (stroke.layer == Layer::path)
        for (const Segment& segment : stroke.segments) whole += extent_of(segment) * frame_.scale;
    const double apart = std::max(100.0, whole / 80);
    body_ += "<g class=\"arrows\" fill=\"blue\">\n";
    double since = apart;
    for (const Stroke& stroke : picture_.strokes) {
      if (stroke.layer != Layer::path) continue;
      for (const Segment& segment : stroke.segments) {
        const double length = extent_of(segment) * frame_.scale;
        since += length;
        if (length < 36 || since < apart) continue;
        since = 0;
        draw_arrow(place_at(segment, 0.5));
      }
    }
    body_ += "</g>\n";
  }

  void draw_arrow(const Place& place) {
    const Point tip = frame_.on_sheet(place.point);
    const Vector ahead(place.direction.x(), -place.direction.y());
    const Vector aside = left_of(ahead);
    body_ += "<path d=\"M" + pair(tip + 6 * ahead) + "L" + pair(tip - 5 * ahead + 4 * aside) + "L" +
             pair(tip - 5 * ahead - 4 * aside) + "Z\"/>\n";
  }

  void draw_tools() {
    if (picture_.tools.empty()) return;
    body_ += "<g class=\"tool\" fill=\"#888\" fill-opacity=\"0.12\" stroke=\"#666\">\n";
    for (const ToolCircle& tool : picture_.tools) {
      const Point center = frame_.on_sheet(tool.center);
      body_ += "<circle cx=\"" + px(center.x()) + "\" cy=\"" + px(center.y()) + "\" r=\"" +
               px(tool.radius * frame_.scale) + "\"><title>tool radius " + decimal(tool.radius, 6) +
               " mm</title></circle>\n";
    }
    body_ += "</g>\n";
  }

  // A number that would lie on another one is left out.
  void draw_numbers() {
    std::set<std::pair<int, int>> taken;
    body_ +=
        "<g class=\"numbers\" font-size=\"11\" fill=\"#222\" stroke=\"white\" stroke-width=\"3\" "
        "paint-order=\"stroke\" text-anchor=\"middle\">\n";
    for (const Label& label : picture_.numbers) {
      // Clear of the contour: beside an upright line a label needs half its width.
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
    for (const Warning& warning : picture_.warnings) {
      if (!warning.place) continue;
      if (!std::exchange(open, true))
        body_ += "<g class=\"warning\" stroke=\"#8a6d00\" stroke-width=\"1.2\" fill=\"gold\">\n";
      const Point at = frame_.on_sheet(*warning.place);
      body_ += "<path d=\"M" + pair(at - Vector(0, 9)) + "L" + pair(at + Vector(8, 6)) + "L" +
               pair(at + Vector(-8, 6)) + "Z\"><title>" + escaped(warning.text) +
               "</title></path>\n";
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
        px(at.x()) + "\" cy=\"" + px(at.y()) + "\" r=\"11\"/>\n";
    draw_line(at - Vector(6, 6), at + Vector(6, 6));
    draw_line(at - Vector(6, -6), at + Vector(6, -6));
    body_ += "</g>\n";
  }

  // Only what the picture shows. Returns where the next thing below may begin.
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
            34, std::string(style->legend) + (rapid ? ", rapid" : ""));
    if (!picture_.tools.empty())
      entry(
          "<circle cx=\"7\" cy=\"0\" r=\"7\" fill=\"#888\" fill-opacity=\"0.12\" stroke=\"#666\"/>",
          14, "tool, R " + decimal(picture_.tools.front().radius, 4) + " mm");
    body_ += "</g>\n";
    return y + line_height;
  }

  // The first warnings and the error, in words.
  double draw_texts(double y) {
    constexpr std::size_t most_told = 4;
    const std::size_t told = std::min(picture_.warnings.size(), most_told);
    for (std::size_t i = 0; i < told; ++i)
      y = draw_wrapped(picture_.warnings[i].text, "#8a6d00", y + (i == 0 ? 6 : 0));
    if (picture_.warnings.size() > told)
      y = draw_wrapped(std::to_string(picture_.warnings.size() - told) + " more warnings",
                       "#8a6d00", y);
    return picture_.fault ? draw_wrapped(picture_.fault->text, "red", y + 6) : y;
  }

  double draw_wrapped(const std::string& text, const std::string& color, double y) {
    const auto letters = static_cast<std::size_t>((width_ - 2 * edge) / text_width);
    for (const std::string& line : wrapped(text, letters)) {
      draw_text({edge, y}, line, " fill=\"" + color + "\"");
      y += line_height;
    }
    return y;
  }

  const Picture& picture_;
  const SvgOptions& options_;
  Frame frame_;
  Ticks across_;
  Ticks up_;
  double width_ = 0;
  std::vector<std::pair<const Style*, bool>> shown_;
  std::string body_;
};

}  // namespace

std::string to_svg(const Picture& picture, const SvgOptions& options) {
  return Sheet(picture, options).draw();
}

}  // namespace trc::plot
