#include "tests/session/random_program.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/plane.h"
#include "core/nc/text/number_format.h"
#include "tests/support/random.h"

namespace trc::support {
namespace {

constexpr int program_decimals = 3;
constexpr std::string_view axis_letters = "XYZ";
constexpr std::string_view center_letters = "IJK";

// Keeps the position in units of the last decimal, so that increments add up.
class Generator {
 public:
  Generator(std::uint64_t seed, bool compensated) : random_(seed), compensated_(compensated) {}

  std::string program() {
    if (random_.chance(0.5)) text_ += "%random program\n";
    plane_ = static_cast<Plane>(random_.below(3));
    word(std::array{"G17", "G18", "G19"}[static_cast<std::size_t>(plane_)]);
    if (random_.chance(0.3)) word("G161"), absolute_center_ = true;
    if (random_.chance(0.3)) word("G70"), inch_ = true;
    end_line();
    line("G0", 0, 0);
    const std::size_t parts = 2 + random_.below(3);
    for (std::size_t part = 0; part < parts; ++part) {
      modes();
      if (compensated_ && random_.chance(0.8)) {
        selection();
      } else {
        contour(3 + random_.below(8));
      }
    }
    text_ += random_.chance(0.5) ? "N9999 M30\n" : "M30";
    return text_;
  }

 private:
  void modes() {
    if (random_.chance(0.4)) {
      incremental_ = !incremental_;
      word(incremental_ ? "G91" : "G90");
      end_line();
    }
    if (random_.chance(0.3)) {
      absolute_center_ = !absolute_center_;
      word(absolute_center_ ? "G161" : "G162");
      end_line();
    }
  }

  void selection() {
    static constexpr std::array modes{"G138", "G139", "G236", "G237", "G239"};
    word(modes[random_.below(modes.size())]);
    word(random_.chance(0.5) ? "G25" : "G26");
    word(random_.chance(0.3) ? "G11" : "G10");
    end_line();
    word("V.G.WZ_AKT.R=");
    text_ += number(std::llround(random_.between(100, inch_ ? 400 : 3000)));
    end_line();
    const bool alone = random_.chance(0.5);
    word(random_.chance(0.5) ? "G41" : "G42");
    if (alone) end_line();
    line("G1", direction_, length());
    contour(2 + random_.below(8));
    word("G40");
    if (random_.chance(0.5)) end_line();
    line("G1", direction_, length());
  }

  void contour(std::size_t blocks) {
    for (std::size_t block = 0; block < blocks; ++block) {
      passive_blocks();
      direction_ += random_.between(-1.8, 1.8);
      const double kind = random_.between(0, 1);
      if (kind < 0.55) {
        line(random_.chance(0.15) ? "G0" : "G1", direction_, length());
      } else if (kind < 0.95) {
        arc(random_.between(0.2, 4.5), random_.chance(0.5));
      } else {
        arc(2 * std::numbers::pi, random_.chance(0.5));
      }
    }
  }

  double length() { return inch_ ? random_.between(500, 4000) : random_.between(8000, 90000); }

  void line(const char* function, double direction, double distance) {
    std::array<std::int64_t, 3> to = at_;
    const PlaneAxes axes = axes_of(plane_);
    to[axes.first] += std::llround(distance * std::cos(direction));
    to[axes.second] += std::llround(distance * std::sin(direction));
    if (random_.chance(0.2)) to[axes.third] += std::llround(random_.between(-5000, 5000));
    motion(function);
    ends(to, false);
    extras();
    end_line();
  }

  // Leaves in the direction the program has; only the centre is rounded.
  void arc(double sweep, bool clockwise) {
    const PlaneAxes axes = axes_of(plane_);
    const double radius = length() / 2 + (inch_ ? 500 : 8000);
    const double side = clockwise ? -1 : 1;
    const std::int64_t first = -std::llround(side * radius * std::sin(direction_));
    const std::int64_t second = std::llround(side * radius * std::cos(direction_));
    const double turn = side * sweep;
    std::array<std::int64_t, 3> to = at_;
    const auto x = static_cast<double>(-first);
    const auto y = static_cast<double>(-second);
    to[axes.first] += first + std::llround(x * std::cos(turn) - y * std::sin(turn));
    to[axes.second] += second + std::llround(x * std::sin(turn) + y * std::cos(turn));
    if (random_.chance(0.2)) to[axes.third] += std::llround(random_.between(-5000, 5000));
    motion(clockwise ? "G2" : "G3");
    const std::int64_t base_first = absolute_center_ ? at_[axes.first] : 0;
    const std::int64_t base_second = absolute_center_ ? at_[axes.second] : 0;
    ends(to, sweep > 6);
    coordinate(center_letters[axes.first], base_first + first);
    coordinate(center_letters[axes.second], base_second + second);
    extras();
    end_line();
    direction_ += turn;
  }

  void motion(const char* function) {
    if (function == last_motion_ && random_.chance(0.5)) return;
    word(function);
    last_motion_ = function;
  }

  void ends(const std::array<std::int64_t, 3>& to, bool both) {
    const PlaneAxes axes = axes_of(plane_);
    const bool moves = to[axes.first] != at_[axes.first] || to[axes.second] != at_[axes.second];
    for (std::size_t axis = 0; axis < to.size(); ++axis) {
      const bool needed = to[axis] != at_[axis] || ((both || !moves) && axis == axes.first);
      if (!needed && random_.chance(0.7)) continue;
      coordinate(axis_letters[axis], incremental_ ? to[axis] - at_[axis] : to[axis]);
    }
    at_ = to;
    if (random_.chance(0.1)) {
      const std::int64_t angle = std::llround(random_.between(-90000, 90000));
      coordinate('A', angle);
    }
  }

  void extras() {
    if (random_.chance(0.15))
      word("F"), text_ += number(std::llround(random_.between(1, 9)) * 100000);
    if (random_.chance(0.1)) word("M8");
    if (random_.chance(0.1)) word("(note)");
  }

  void passive_blocks() {
    if (random_.chance(0.1)) word("M9"), end_line();
    if (random_.chance(0.1)) text_ += "(remark)\n";
    if (random_.chance(0.05)) text_ += "\n";
    if (random_.chance(0.05)) text_ += "; remark\r\n";
    if (random_.chance(0.05)) word("G04 X1.5"), end_line();
    if (random_.chance(0.1)) {
      std::array<std::int64_t, 3> to = at_;
      to[axes_of(plane_).third] += std::llround(random_.between(-5000, 5000));
      motion("G1");
      const std::size_t axis = axes_of(plane_).third;
      coordinate(axis_letters[axis], incremental_ ? to[axis] - at_[axis] : to[axis]);
      at_ = to;
      end_line();
    }
  }

  void coordinate(char letter, std::int64_t units) { word(std::string(1, letter) + number(units)); }

  static std::string number(std::int64_t units) {
    std::string text;
    append_units(text, units, program_decimals);
    return text;
  }

  void word(std::string_view word) {
    if (!in_line_) {
      in_line_ = true;
      if (random_.chance(0.5)) (text_ += 'N') += std::to_string(++number_ * 10) + " ";
    } else {
      text_ += random_.chance(0.9) ? " " : "  ";
    }
    text_ += word;
  }

  void end_line() {
    if (in_line_) text_ += random_.chance(0.9) ? "\n" : "\r\n";
    in_line_ = false;
  }

  support::Random random_;
  bool compensated_;
  std::string text_;
  Plane plane_ = Plane::xy;
  bool absolute_center_ = false;
  bool inch_ = false;
  bool incremental_ = false;
  bool in_line_ = false;
  int number_ = 0;
  std::string last_motion_{};
  double direction_ = 0;
  std::array<std::int64_t, 3> at_{};
};

}  // namespace

std::string random_program(std::uint64_t seed, bool compensated) {
  return Generator(seed, compensated).program();
}

}  // namespace trc::support
