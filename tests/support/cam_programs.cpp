#include "tests/support/cam_programs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "core/geometry/along.h"

namespace trc::support {
namespace {

constexpr double pi = std::numbers::pi;

Point turned_about(const Point& point, const Point& center, double angle) {
  const Vector from = point - center;
  return center + Vector(std::cos(angle) * from.x() - std::sin(angle) * from.y(),
                         std::sin(angle) * from.x() + std::cos(angle) * from.y());
}

// From one point to the next one.
class Pen {
 public:
  explicit Pen(const Point& at) : at_(at) {}

  Pen& line(const Point& end) {
    if ((end - at_).norm() > 1e-9) blocks_.emplace_back(Line{at_, end});
    at_ = end;
    return *this;
  }
  Pen& line(double x, double y) { return line(Point(x, y)); }
  Pen& arc(const Point& center, double sweep) {
    const Point end = turned_about(at_, center, sweep);
    blocks_.emplace_back(Arc{at_, end, center, sweep});
    at_ = end;
    return *this;
  }
  Pen& arc(double x, double y, double sweep) { return arc(Point(x, y), sweep); }
  [[nodiscard]] std::vector<Segment> blocks() const { return blocks_; }

 private:
  Point at_;
  std::vector<Segment> blocks_;
};

// A wavy ring of many chords, clockwise.
std::vector<Segment> wave() {
  constexpr int chords = 400;
  const auto point = [](int chord) {
    const double angle = -2 * pi * chord / chords;
    const double radius = 60 + 4 * std::cos(5 * angle);
    return Point(radius * std::cos(angle), radius * std::sin(angle));
  };
  Pen pen(point(0));
  for (int chord = 1; chord <= chords; ++chord) pen.line(point(chord % chords));
  return pen.blocks();
}

// Five blocks, turned by an angle that no decimals hold.
std::vector<Segment> slanted_plate() {
  const auto at = [](double x, double y) { return turned_about({x, y}, {0, 0}, 0.4567); };
  return Pen(at(0, 20))
      .line(at(30, 20))
      .line(at(30, -20))
      .line(at(-30, -20))
      .line(at(-30, 20))
      .line(at(0, 20))
      .blocks();
}

Vector direction_at_start(const std::vector<Segment>& ring) {
  return tangent_at_start(ring.front());
}

// The leads in, up to the point, along the tangent, and out from it; `size` mm.
std::vector<Segment> lead_in(Lead lead, const Point& to, const Vector& tangent, double size) {
  const Vector left = left_of(tangent);
  switch (lead) {
    case Lead::none:
      return {};
    case Lead::line:
      return Pen(to + size * (left - tangent)).line(to).blocks();
    case Lead::arc:
      return Pen(to + size * (left - tangent)).arc(to + size * left, pi / 2).blocks();
    case Lead::line_and_arc:
      return Pen(to + size * (left - tangent) + 0.8 * size * left)
          .line(to + size * (left - tangent))
          .arc(to + size * left, pi / 2)
          .blocks();
    case Lead::half_circle:
      return Pen(to + 2 * size * left).arc(to + size * left, pi).blocks();
    case Lead::square:
      return Pen(to + size * left).line(to).blocks();
    case Lead::one_point:
      return Pen(to + 2.5 * size * left).line(to + size * (0.8 * left - tangent)).line(to).blocks();
    case Lead::crossing:
      return Pen(to + size * (2.5 * left + tangent))
          .line(to + size * (0.8 * left - tangent))
          .line(to)
          .blocks();
  }
  return {};
}

std::vector<Segment> lead_out(Lead lead, const Point& from, const Vector& tangent, double size) {
  // That in, mirrored and backwards, which leaves an arc its sense.
  const Vector left = left_of(tangent);
  std::vector<Segment> out;
  for (const Segment& block : lead_in(lead, {0, 0}, Vector::UnitX(), size)) {
    const auto place = [&](const Point& point) {
      return Point(from - point.x() * tangent + point.y() * left);
    };
    if (const auto* arc = std::get_if<Arc>(&block))
      out.emplace_back(Arc{place(arc->end), place(arc->start), place(arc->center), arc->sweep});
    else
      out.emplace_back(Line{place(end_of(block)), place(start_of(block))});
  }
  std::reverse(out.begin(), out.end());
  return out;
}

// The first `length` mm of a contour.
std::vector<Segment> beginning_of(const std::vector<Segment>& ring, double length) {
  std::vector<Segment> blocks;
  for (const Segment& block : ring) {
    const double own = length_of(block);
    if (length <= 0) break;
    blocks.push_back(
        length >= own ? block
                      : stretch_of(block, 0, length, start_of(block), point_along(block, length)));
    length -= own;
  }
  return blocks;
}

bool is_straight_at_start(const CamContour& contour) {
  const Segment& first = contour.ring.front();
  const Segment& last = contour.ring.back();
  return !is_arc(first) && !is_arc(last) &&
         std::abs(cross(tangent_at_end(last), tangent_at_start(first))) < 1e-9;
}

// The same contour with its outside corners rounded: what a finishing lap takes off.
std::vector<Segment> rounded(const std::vector<Segment>& ring, double radius) {
  std::vector<Segment> blocks;
  Point begin = start_of(ring.front());
  for (std::size_t index = 0; index < ring.size(); ++index) {
    const Segment& block = ring[index];
    if (is_arc(block)) {
      blocks.push_back(block);
      begin = end_of(block);
      continue;
    }
    const bool is_last = index + 1 == ring.size();
    const Vector before = tangent_at_end(block);
    const Vector after = is_last ? before : tangent_at_start(ring[index + 1]);
    const double turn = turn_between(before, after);
    // The tool is on the left: outside corners turn right.
    const bool rounds = !is_last && turn < -0.1 && !is_arc(ring[index + 1]);
    if (!rounds) {
      blocks.emplace_back(Line{begin, end_of(block)});
      begin = end_of(block);
      continue;
    }
    const double cut = radius * std::tan(-turn / 2);
    const Point end = end_of(block) - cut * before;
    blocks.emplace_back(Line{begin, end});
    const Point center = end - radius * left_of(before);
    const Point behind = end_of(block) + cut * after;
    blocks.emplace_back(Arc{end, behind, center, turn});
    begin = behind;
  }
  return blocks;
}

double size_of_leads(const CamContour& contour) { return 2.2 * contour.tool_radius; }

double overrun_of(const CamProgram& program) {
  switch (program.overrun) {
    case Overrun::none:
      return 0;
    case Overrun::one_millimetre:
    case Overrun::in_the_last_block:
      return 1;
    case Overrun::over_a_corner:
      return length_of(program.contour.ring.front()) + 1;
  }
  return 0;
}

// Writes words with so many decimals, as CAM does.
class Writer {
 public:
  explicit Writer(const CamProgram& program) : program_(program) { text_ << std::fixed; }

  void line(const std::string& words) { text_ << 'N' << next() << ' ' << words << '\n'; }
  void straight(const char* words, const Point& end) {
    text_ << 'N' << next() << ' ' << words << " X" << number(end.x()) << " Y" << number(end.y())
          << '\n';
    at_ = {read(end.x()), read(end.y())};
  }
  void block(const Segment& segment) {
    const auto* arc = std::get_if<Arc>(&segment);
    if (arc == nullptr) return straight("G1", end_of(segment));
    text_ << 'N' << next() << (arc->sweep > 0 ? " G3" : " G2") << " X" << number(arc->end.x())
          << " Y" << number(arc->end.y()) << " I" << number(arc->center.x() - at_.x()) << " J"
          << number(arc->center.y() - at_.y()) << '\n';
    at_ = {read(arc->end.x()), read(arc->end.y())};
  }
  void blocks(const std::vector<Segment>& segments) {
    for (const Segment& segment : segments) block(segment);
  }
  void depth(double z) { line("G1 Z" + number(z)); }
  [[nodiscard]] std::string number(double value) const {
    std::ostringstream stream;
    stream << std::fixed << std::setprecision(program_.decimals)
           << (program_.inch ? value / 25.4 : value);
    return stream.str();
  }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  int next() { return number_ += 10; }
  // As it will be read, mm.
  [[nodiscard]] double read(double value) const {
    return std::stod(number(value)) * (program_.inch ? 25.4 : 1);
  }

  const CamProgram& program_;
  std::ostringstream text_;
  int number_ = 0;
  Point at_ = Point::Zero();
};

// Puts one program together: leads, laps, overrun.
class Composer {
 public:
  explicit Composer(const CamProgram& program)
      : program_(program),
        ring_(program.contour.ring),
        start_(start_of(ring_.front())),
        size_(size_of_leads(program.contour)),
        overrun_(beginning_of(ring_, overrun_of(program))),
        in_(lead_in(program.in, start_, direction_at_start(ring_), size_)),
        writer_(program) {
    end_ = overrun_.empty() ? start_ : end_of(overrun_.back());
    leaves_ = tangent_at_end(overrun_.empty() ? ring_.back() : overrun_.back());
    entry_ = in_.empty() ? start_ : start_of(in_.front());
  }

  std::string compose(const std::string& modes) {
    begin(modes);
    write_laps();
    if (!merges()) writer_.blocks(overrun_);
    const std::vector<Segment> out = lead_out(program_.out, end_, leaves_, size_);
    writer_.blocks(out);
    const Point left = out.empty() ? end_ : end_of(out.back());
    const Vector away = out.empty() ? leaves_ : tangent_at_end(out.back());
    writer_.straight("G40 G1", left + run_ * (left_of(away) + away));
    writer_.line("M30");
    return writer_.text();
  }

 private:
  [[nodiscard]] bool merges() const { return program_.overrun == Overrun::in_the_last_block; }

  void begin(const std::string& modes) {
    writer_.line(program_.inch ? "G17 G90 G70" : "G17 G90 G71");
    writer_.line("V.G.WZ_AKT.R=" + writer_.number(program_.contour.tool_radius));
    std::istringstream lines(modes);
    for (std::string line; std::getline(lines, line);) writer_.line(line);
    const Vector entered = in_.empty() ? direction_at_start(ring_) : tangent_at_start(in_.front());
    writer_.straight("G0", entry_ + run_ * (left_of(entered) - entered));
    writer_.line("F" + writer_.number(800));
    writer_.straight("G41 G1", entry_);
    writer_.blocks(in_);
  }
  void write_laps() {
    switch (program_.laps) {
      case Laps::one:
        return lap(ring_, true);
      case Laps::two:
      case Laps::three:
        for (int count = program_.laps == Laps::two ? 2 : 3; count-- > 0;) lap(ring_, count == 0);
        return;
      case Laps::rough_and_finish:
        lap(ring_, false);
        return lap(rounded(ring_, 3), true);
      case Laps::depths:
      case Laps::depths_and_leads:
        lap(ring_, false);
        step_down(-1);
        lap(ring_, false);
        step_down(-2);
        return lap(ring_, true);
    }
  }
  void lap(const std::vector<Segment>& blocks, bool last) {
    for (std::size_t index = 0; index + 1 < blocks.size(); ++index) writer_.block(blocks[index]);
    if (last && merges())
      writer_.straight("G1", end_);
    else
      writer_.block(blocks.back());
  }
  void step_down(double z) {
    if (program_.laps == Laps::depths) return writer_.depth(z);
    const auto off = lead_out(program_.out, start_, tangent_at_end(ring_.back()), size_);
    writer_.blocks(off);
    const bool returns = !off.empty() && (end_of(off.back()) - entry_).norm() > 1e-6;
    if (returns) writer_.straight("G1", entry_);
    writer_.depth(z);
    writer_.blocks(in_);
  }

  const CamProgram& program_;
  const std::vector<Segment>& ring_;
  Point start_;
  double size_;
  std::vector<Segment> overrun_;
  std::vector<Segment> in_;
  Writer writer_;
  double run_ = 2 * program_.contour.tool_radius;  // mm of approach and retract
  Point end_ = Point::Zero();
  Vector leaves_ = Vector::UnitX();
  Point entry_ = Point::Zero();
};

}  // namespace

std::vector<CamContour> cam_contours() {
  std::vector<CamContour> contours;
  // Outside, begun in the middle of a line: 60 by 40, clockwise.
  contours.push_back({.name = "plate",
                      .ring = Pen({0, 20})
                                  .line(30, 20)
                                  .line(30, -20)
                                  .line(-30, -20)
                                  .line(-30, 20)
                                  .line(0, 20)
                                  .blocks()});
  contours.push_back({.name = "slanted_plate", .ring = slanted_plate()});
  // Outside, begun in a corner.
  contours.push_back(
      {.name = "plate_from_a_corner",
       .ring = Pen({-30, 20}).line(30, 20).line(30, -20).line(-30, -20).line(-30, 20).blocks()});
  // Inside, counter-clockwise, with round corners larger than the tool.
  contours.push_back({.name = "pocket",
                      .ring = Pen({0, -20})
                                  .line(24, -20)
                                  .arc(24, -14, pi / 2)
                                  .line(30, 14)
                                  .arc(24, 14, pi / 2)
                                  .line(-24, 20)
                                  .arc(-24, 14, pi / 2)
                                  .line(-30, -14)
                                  .arc(-24, -14, pi / 2)
                                  .line(0, -20)
                                  .blocks()});
  // Inside, begun on an arc.
  contours.push_back({.name = "bore", .ring = Pen({25, 0}).arc(0, 0, pi).arc(0, 0, pi).blocks()});
  contours.push_back({.name = "boss", .ring = Pen({0, 25}).arc(0, 0, -2 * pi).blocks()});
  contours.push_back({.name = "wave", .ring = wave()});
  // Outside, with a slot the tool does not fit into: one loop.
  contours.push_back({.name = "slotted_plate",
                      .ring = Pen({-15, 20})
                                  .line(5, 20)
                                  .line(5, 10)
                                  .line(9, 10)
                                  .line(9, 20)
                                  .line(30, 20)
                                  .line(30, -20)
                                  .line(-30, -20)
                                  .line(-30, 20)
                                  .line(-15, 20)
                                  .blocks(),
                      .loops = 1});
  return contours;
}

std::string name_of(Lead lead) {
  static constexpr std::array<const char*, std::size(all_leads)> names{
      "none", "line", "arc", "line_and_arc", "half_circle", "square", "one_point", "crossing"};
  return names[static_cast<std::size_t>(lead)];
}

std::string name_of(Overrun overrun) {
  static constexpr std::array<const char*, std::size(all_overruns)> names{
      "", "overrun", "overrun_over_a_corner", "overrun_in_the_last_block"};
  return names[static_cast<std::size_t>(overrun)];
}

std::string name_of(Laps laps) {
  static constexpr std::array<const char*, 6> names{
      "", "two_laps", "three_laps", "rough_and_finish", "depths", "depths_and_leads"};
  return names[static_cast<std::size_t>(laps)];
}

std::string name_of(const CamProgram& program) {
  std::string name = program.contour.name + "_" + name_of(program.in);
  if (program.out != program.in) name += "_" + name_of(program.out);
  for (const std::string& part : {name_of(program.overrun), name_of(program.laps)})
    if (!part.empty()) name += "_" + part;
  return name + (program.inch ? "_inch" : program.decimals == 4 ? "_4" : "");
}

bool is_possible(const CamProgram& program) {
  return program.overrun != Overrun::in_the_last_block || is_straight_at_start(program.contour);
}

std::string text_of(const CamProgram& program, const std::string& modes) {
  return Composer(program).compose(modes);
}

}  // namespace trc::support
