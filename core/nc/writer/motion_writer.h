#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/length_unit.h"
#include "core/nc/state/program_line.h"
#include "core/nc/text/line_limits.h"
#include "core/nc/text/number_format.h"
#include "core/nc/text/text_buffer.h"
#include "core/trc/result/compensated_block.h"

namespace trc {

// What a control that reads the output knows after the text written so far. The
// position is the one it reads, not the exact one: numbers are rounded as they
// are written.
struct WrittenState {
  MotionKind motion = MotionKind::rapid;
  bool incremental = false;
  LengthUnit unit = LengthUnit::mm;
  LengthUnit feed_unit = LengthUnit::mm;
  bool absolute_center = false;
  Plane plane = Plane::xy;
  double feed = 0;  // mm/min; 0: none written yet
  Position position{};
  std::vector<double> tracking{};  // by index into the tracking axes of the session
  // Of Klartext.
  Point pole = Point::Zero();  // CC, mm, in the plane
  bool has_pole = false;
  bool pole_written = false;   // it differs from the pole in force in the program
  bool other_tangent = false;  // the last motion ends in another direction than in the program
  bool other_radius = false;   // the last PR of the program is not in the output

  template <class Archive>
  void serialize(Archive& archive) {
    archive(motion, incremental, unit, feed_unit, absolute_center, plane, feed, position, tracking,
            pole, has_pole, pole_written, other_tangent, other_radius);
  }
};

// A set of axes: bits 0 … 2 are X Y Z, the tracking axes follow.
using AxisSet = std::uint64_t;
[[nodiscard]] constexpr AxisSet axis_bit(std::size_t axis) { return AxisSet{1} << axis; }

// The two halves of an arc, each with half the sweep; they share their joint.
[[nodiscard]] std::array<Arc, 2> halves_of(const Arc& arc);

// How numbers and motions are spelled.
struct Spelling {
  bool points = false;    // whole numbers end in a decimal point
  bool klartext = false;  // L X+10 FMAX; CC and C
};

// Turns motions into words (G01 X30 Y30 …) such that a reader of the text makes the same
// motion: ends to half a unit of the last decimal, points inside an arc to one and a half
// units, or five in an arc of more than 180 degrees. The state is updated to what such a reader
// knows.
class MotionWriter {
 public:
  // `tracking_letters`: one letter per tracking axis, `tracking_names` those of more than one
  // character. 0 <= decimals < most_decimals. Numbers of more than `most_digits` digits are told by
  // digits_written().
  MotionWriter(int decimals, std::string tracking_letters, Spelling spelling = {},
               std::vector<std::string> tracking_names = {},
               int most_digits = LineLimits::any_number);

  // From here on numbers have at least so many decimals, of mm.
  void write_at_least(int decimals);
  [[nodiscard]] int decimals_of(LengthUnit unit) const {
    return unit == LengthUnit::inch ? decimals_ + 1 : decimals_;
  }
  // From here on numbers may have so many digits.
  void allow_digits(int most);
  // The most digits that a number has had, where that is more than `most_digits`; else 0.
  [[nodiscard]] int digits_written() const { return digits_written_; }

  // The tracking axis with that name of more than one character; nothing: there is none.
  [[nodiscard]] std::optional<std::size_t> axis_named(std::string_view name) const;

  // How an arc can be written from the position the reader is at.
  enum class ArcForm : std::uint8_t {
    arc,     // as G02 or G03
    line,    // so short that a line is as exact, and rounding would change its sweep
    halves,  // rounding would move its centre or change its sweep: too near to a full circle
  };
  // A number as it is written, and what a reader makes of it in mm.
  struct Written {
    std::int64_t units = 0;
    double read = 0;
  };
  // The numbers of an arc, in the axes of the plane.
  struct ArcNumbers {
    ArcForm form = ArcForm::arc;
    std::array<Written, 2> end{};
    std::array<Written, 2> center{};
  };
  [[nodiscard]] ArcNumbers numbers_of(const Arc& arc, Plane plane, const WrittenState& state) const;
  // The form, judged by the arc that a reader makes of the numbers. numbers_of() takes a shorter
  // way where it can.
  [[nodiscard]] ArcForm form_of(const Arc& arc, const ArcNumbers& numbers, Plane plane,
                                const WrittenState& state) const;

  // An arc with its numbers, as numbers_of() returns them for this arc and the present state.
  struct NumberedArc {
    const Arc& arc;
    const ArcNumbers& numbers;
    Plane plane = Plane::xy;
  };
  // The ends of the axes of a motion, and which axes are written.
  struct Axes {
    const Position& end;
    const TrackingTravel& tracking;
    AxisSet always = 0;  // in addition to those that move
    AxisSet never = 0;   // although they move
  };

  // Whether a reader would move if it were told to go there.
  [[nodiscard]] bool moves(const Position& end, const TrackingTravel& tracking,
                           const WrittenState& state) const;
  // Whether `position` is `target` to half a unit of the last decimal.
  [[nodiscard]] bool reaches(double target, double position, LengthUnit unit) const {
    return std::abs(target - position) <= last_decimal(unit) / 2;
  }
  [[nodiscard]] bool reaches_tracking(std::size_t axis, double target, double position,
                                      LengthUnit unit) const;

  // Append the motion function, the axes and, for an arc, both plane axes and the centre. Each word
  // has a blank before it.
  void append_line(TextBuffer& out, MotionKind kind, const Axes& axes, WrittenState& state);
  void append_arc(TextBuffer& out, const NumberedArc& arc, const Axes& axes, WrittenState& state);

  // In Klartext the centre is a block of its own, before the arc: CC.
  void append_pole(TextBuffer& out, const Point& pole, Plane plane, WrittenState& state);

  // Whether two feeds are written alike, mm/min.
  [[nodiscard]] bool same_feed(double a, double b, LengthUnit unit) const;
  void append_feed(TextBuffer& out, double feed, WrittenState& state);

  // Decimals and digits are all that changes.
  template <class Archive>
  void serialize(Archive& archive) {
    int decimals = decimals_;
    archive(decimals, largest_units_);
    write_at_least(decimals);
  }

 private:
  [[nodiscard]] Written written(double value, LengthUnit unit) const {
    const bool inch = unit == LengthUnit::inch;
    const std::int64_t units = to_units(inch ? value / mm_per_inch : value, decimals_of(unit));
    const double number = from_units(units, decimals_of(unit));
    return {.units = units, .read = inch ? number * mm_per_inch : number};
  }
  [[nodiscard]] Written written_end(double target, double position, LengthUnit unit,
                                    bool incremental) const {
    if (!incremental) return written(target, unit);
    const Written step = written(target - position, unit);
    return {.units = step.units, .read = position + step.read};
  }
  [[nodiscard]] Written written_center(double center, double start,
                                       const WrittenState& state) const;
  struct WrittenFeed {
    std::int64_t units = 0;
    int decimals = 0;
    double read = 0;  // mm/min
  };
  [[nodiscard]] WrittenFeed written_feed(double feed, LengthUnit unit) const;
  // One unit of the last decimal, mm.
  [[nodiscard]] double last_decimal(LengthUnit unit) const {
    return unit == LengthUnit::inch ? last_decimal_of_inch_ : last_decimal_of_mm_;
  }

  [[nodiscard]] char* write_word(char* at, char letter, std::int64_t units, int decimals);
  void count_digits(std::int64_t units, int decimals);
  // Klartext counts feeds in tenths of an inch.
  [[nodiscard]] double feed_unit(LengthUnit unit) const {
    return unit == LengthUnit::inch ? mm_per_inch / (spelling_.klartext ? 10 : 1) : 1;
  }
  void append_klartext_arc(TextBuffer& out, const NumberedArc& arc, const Axes& axes,
                           WrittenState& state);

  [[nodiscard]] char* room_of_motion(TextBuffer& out, const TrackingTravel& tracking) const;
  // The unit of a tracking axis.
  [[nodiscard]] LengthUnit unit_of_axis(std::size_t axis, LengthUnit of_lengths) const;
  // `known`: the numbers of main axes that are known already.
  using KnownNumbers = std::array<const Written*, 3>;
  [[nodiscard]] char* write_axes(char* at, const Axes& axes, const KnownNumbers& known,
                                 WrittenState& state);

  int decimals_ = 0;
  std::int64_t largest_units_ = 0;  // of as many digits as a number may have
  int digits_written_ = 0;
  double last_decimal_of_mm_ = 0;    // mm
  double last_decimal_of_inch_ = 0;  // mm
  std::string tracking_letters_;
  std::vector<std::string> tracking_names_;
  std::size_t longest_name_ = 0;
  Spelling spelling_;
};

}  // namespace trc
