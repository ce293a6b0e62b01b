#include "tests/interop/linuxcnc/judged_contour.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "tests/support/places.h"

namespace trc::linuxcnc {
namespace {

constexpr double pi = std::numbers::pi;

Arc arc(const Point& start, const Point& end, const Point& center, bool counter_clockwise) {
  double sweep = turn_between(start - center, end - center);
  if (counter_clockwise && sweep <= 0) sweep += 2 * pi;
  if (!counter_clockwise && sweep >= 0) sweep -= 2 * pi;
  return {.start = start, .end = end, .center = center, .sweep = sweep};
}

class Reader {
 public:
  explicit Reader(const std::string& path) : file_(path) {
    if (!file_) throw std::runtime_error("cannot read " + path);
  }

  std::vector<JudgedContour> all() {
    std::vector<JudgedContour> contours;
    std::string line;
    while (std::getline(file_, line)) {
      ++line_;
      words_ = std::istringstream(line);
      if (std::string key; words_ >> key && key[0] != '#') take(key, contours);
    }
    if (!contours.empty() && open_) fail("the last contour has no end");
    return contours;
  }

 private:
  void take(const std::string& key, std::vector<JudgedContour>& contours) {
    if (key == "contour") {
      if (open_) fail("a contour inside a contour");
      open_ = true;
      blocks_ = nullptr;
      contours.push_back(head());
      return;
    }
    if (!open_) fail("no contour is open");
    JudgedContour& current = contours.back();
    if (key == "approach") {
      current.contour.approach.start = point();
    } else if (key == "start") {
      current.contour.approach.end = at_ = point();
      blocks_ = &current.contour.blocks;
    } else if (key == "retract") {
      current.contour.retract = {.start = at_, .end = point()};
    } else if (key == "path") {
      at_ = point();
      blocks_ = &current.path;
    } else if (key == "exit") {
      current.exit = point();
    } else if (key == "refused") {
      std::getline(words_ >> std::ws, current.refusal);
    } else if (key == "fault") {
      if (!(words_ >> current.fault >> current.fault_block)) fail("fault and block expected");
    } else if (key == "end") {
      open_ = false;
    } else {
      add_block(key);
    }
  }

  JudgedContour head() {
    JudgedContour contour;
    std::string plane;
    std::string side;
    words_ >> contour.name >> plane >> side >> contour.mode.tool_radius;
    const bool known = (plane == "G17" || plane == "G18") && (side == "left" || side == "right");
    if (!words_ || !known) fail("name, plane, side and radius expected");
    contour.mode.plane = plane == "G17" ? Plane::xy : Plane::zx;
    contour.mode.side = side == "left" ? Side::left : Side::right;
    contour.mode.selection = contour.mode.deselection = Selection::direct;
    contour.mode.transition = Transition::circular;
    return contour;
  }

  void add_block(const std::string& kind) {
    if (blocks_ == nullptr) fail("a block before start");
    const Point start = at_;
    at_ = point();
    if (kind == "line") {
      blocks_->emplace_back(Line{.start = start, .end = at_});
    } else if (kind == "cw" || kind == "ccw") {
      blocks_->emplace_back(arc(start, at_, point(), kind == "ccw"));
    } else {
      fail("unknown word " + kind);
    }
  }

  Point point() {
    Point result = Point::Zero();
    if (!(words_ >> result.x() >> result.y())) fail("two coordinates expected");
    return result;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
  }

  std::ifstream file_;
  std::istringstream words_{};
  std::size_t line_ = 0;
  bool open_ = false;
  Point at_ = Point::Zero();
  std::vector<Segment>* blocks_ = nullptr;
};

}  // namespace

std::vector<JudgedContour> read_judged_contours(const std::string& file_name) {
  return Reader(testing_support::source_dir() + "/tests/interop/linuxcnc/" + file_name).all();
}

}  // namespace trc::linuxcnc
