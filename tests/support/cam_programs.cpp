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

// The contour with its outside corners rounded: what a finishing lap takes off.
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

double size_of_leads(const CamProgram& program) {
  return program.size_of_leads * program.contour.tool_radius;
}

double overrun_of(const CamProgram& program, const std::vector<Segment>& ring) {
  switch (program.overrun) {
    case Overrun::none:
      return 0;
    case Overrun::along:
    case Overrun::in_the_last_block:
      return program.overrun_length;
    case Overrun::over_a_corner:
      return length_of(ring.front()) + program.overrun_length;
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

CamContour turned(CamContour contour, double angle) {
  const auto place = [&](const Point& point) { return turned_about(point, {0, 0}, angle); };
  for (Segment& block : contour.ring) {
    if (const auto* arc = std::get_if<Arc>(&block))
      block = Arc{place(arc->start), place(arc->end), place(arc->center), arc->sweep};
    else
      block = Line{place(start_of(block)), place(end_of(block))};
  }
  return contour;
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
  if (program.overrun == Overrun::along && program.overrun_length != 1)
    name += "_of_" + std::to_string(std::lround(program.overrun_length));
  return name + (program.inch ? "_inch" : program.decimals == 4 ? "_4" : "");
}

std::vector<Segment> finished_ring(const CamProgram& program) {
  return program.laps == Laps::rough_and_finish
             ? rounded(program.contour.ring, program.rounded_corners)
             : program.contour.ring;
}

bool is_possible(const CamProgram& program) {
  return program.overrun != Overrun::in_the_last_block || is_straight_at_start(program.contour);
}

namespace {

// Whether inside corners leave something of each block, from the second to the last but one.
bool leave_room(const std::vector<Segment>& blocks, double tool_radius) {
  const auto cut = [&](std::size_t before) {
    const double turn =
        turn_between(tangent_at_end(blocks[before]), tangent_at_start(blocks[before + 1]));
    return turn > 0 ? tool_radius * std::tan(std::min(turn, 0.99 * pi) / 2) : 0;
  };
  for (std::size_t index = 1; index + 1 < blocks.size(); ++index) {
    double length = length_of(blocks[index]);
    if (const auto* arc = std::get_if<Arc>(&blocks[index]); arc != nullptr && arc->sweep > 0)
      length *= 1 - tool_radius / (arc->start - arc->center).norm();
    if (cut(index - 1) + cut(index) >= length) return false;
  }
  return true;
}

// From one depth to the next.
std::vector<Segment> leads_between(const CamProgram& program) {
  if (program.laps != Laps::depths_and_leads) return {};
  const std::vector<Segment>& ring = program.contour.ring;
  const double size = size_of_leads(program);
  const Point start = start_of(ring.front());
  std::vector<Segment> between = lead_out(program.out, start, tangent_at_end(ring.back()), size);
  const std::vector<Segment> in = lead_in(program.in, start, direction_at_start(ring), size);
  if (between.empty()) return in;
  between.emplace_back(Line{end_of(between.back()), in.empty() ? start : start_of(in.front())});
  between.insert(between.end(), in.begin(), in.end());
  return between;
}

}  // namespace

bool leaves_room(const CamProgram& program) {
  // The overrun would end in the slot.
  if (program.contour.loops > 0 && program.overrun == Overrun::over_a_corner) return false;
  const std::vector<Segment>& ring = program.contour.ring;
  const double size = size_of_leads(program);
  const Point start = start_of(ring.front());
  const auto last_of = [&](std::size_t back) -> const Segment& {
    return ring[(2 * ring.size() - back) % ring.size()];
  };
  const auto out = [&](const Segment& last) {
    return lead_out(program.out, end_of(last), tangent_at_end(last), size);
  };
  // Each corner with leads on one side or on both, and the blocks up to the next ones.
  std::vector<Segment> begin = lead_in(program.in, start, direction_at_start(ring), size);
  begin.push_back(ring.front());
  begin.push_back(ring[1 % ring.size()]);
  std::vector<Segment> end = beginning_of(ring, overrun_of(program, ring));
  end.insert(end.begin(), last_of(1));
  if (end.size() == 1) end.insert(end.begin(), last_of(2));
  const std::vector<Segment> leaving = out(end.back());
  end.insert(end.end(), leaving.begin(), leaving.end());
  const double radius = program.contour.tool_radius;
  if (!leave_room(begin, radius) || !leave_room(end, radius)) return false;
  if (!leads_between_are_short(program)) return false;
  std::vector<Segment> between = leads_between(program);
  if (between.empty()) return true;
  between.insert(between.begin(), ring.back());
  between.push_back(ring.front());
  return leave_room(between, radius);
}

bool leads_between_are_short(const CamProgram& program) {
  const auto length_of_all = [](const std::vector<Segment>& blocks) {
    double length = 0;
    for (const Segment& block : blocks) length += length_of(block);
    return length;
  };
  return length_of_all(leads_between(program)) < 0.25 * length_of_all(program.contour.ring);
}

std::string text_of(const CamProgram& program, const std::string& modes) {
  const CamContour& contour = program.contour;
  const std::vector<Segment>& ring = contour.ring;
  const Point start = start_of(ring.front());
  const double size = size_of_leads(program);
  const Vector tangent = direction_at_start(ring);
  const std::vector<Segment> in = lead_in(program.in, start, tangent, size);
  const std::vector<Segment> finished = finished_ring(program);
  std::vector<Segment> overrun = beginning_of(finished, overrun_of(program, finished));
  const Vector leaves = tangent_at_end(overrun.empty() ? ring.back() : overrun.back());
  const Point end = overrun.empty() ? start : end_of(overrun.back());
  const std::vector<Segment> out = lead_out(program.out, end, leaves, size);

  Writer writer(program);
  writer.line(program.inch ? "G17 G90 G70" : "G17 G90 G71");
  writer.line("V.G.WZ_AKT.R=" + writer.number(contour.tool_radius));
  std::istringstream lines(modes);
  for (std::string line; std::getline(lines, line);) writer.line(line);
  const Point entry = in.empty() ? start : start_of(in.front());
  const Vector entered = in.empty() ? tangent : tangent_at_start(in.front());
  const Point before = entry + 2 * contour.tool_radius * (left_of(entered) - entered);
  writer.straight("G0", before);
  writer.line("F" + writer.number(800));
  writer.straight("G41 G1", entry);
  writer.blocks(in);
  const bool merges = program.overrun == Overrun::in_the_last_block;
  const auto lap = [&](const std::vector<Segment>& blocks, bool last) {
    for (std::size_t index = 0; index + 1 < blocks.size(); ++index) writer.block(blocks[index]);
    if (last && merges)
      writer.straight("G1", end);
    else
      writer.block(blocks.back());
  };
  switch (program.laps) {
    case Laps::one:
      lap(ring, true);
      break;
    case Laps::two:
    case Laps::three:
      for (int count = program.laps == Laps::two ? 2 : 3; count-- > 0;) lap(ring, count == 0);
      break;
    case Laps::rough_and_finish:
      lap(ring, false);
      lap(finished, true);
      break;
    case Laps::depths:
    case Laps::depths_and_leads:
      for (int count = 3; count-- > 0;) {
        lap(ring, count == 0);
        if (count == 0) break;
        if (program.laps == Laps::depths_and_leads) {
          const auto off = lead_out(program.out, start, tangent_at_end(ring.back()), size);
          writer.blocks(off);
          if (!off.empty() && (end_of(off.back()) - entry).norm() > 1e-6)
            writer.straight("G1", entry);
        }
        writer.depth(-1.0 * (3 - count));
        if (program.laps == Laps::depths_and_leads) writer.blocks(in);
      }
      break;
  }
  if (!merges) writer.blocks(overrun);
  writer.blocks(out);
  const Point left = out.empty() ? end : end_of(out.back());
  const Vector away = out.empty() ? leaves : tangent_at_end(out.back());
  writer.straight("G40 G1", left + 2 * contour.tool_radius * (left_of(away) + away));
  writer.line("M30");
  return writer.text();
}

}  // namespace trc::support
