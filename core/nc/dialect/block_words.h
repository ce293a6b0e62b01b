#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/nc/dialect/g_function.h"
#include "core/nc/dialect/line_words.h"
#include "core/nc/state/program_state.h"
#include "core/nc/text/words.h"

namespace trc {

[[nodiscard]] inline std::optional<std::int64_t> whole_number(double value) {
  return is_whole(value) ? std::optional(static_cast<std::int64_t>(value)) : std::nullopt;
}
// The tool, edge or register that a word names; `no_tool_number` where its value names none.
[[nodiscard]] inline std::int64_t register_number(double value) {
  return whole_number(value).value_or(no_tool_number);
}
// Of a D or T word.
[[nodiscard]] inline bool is_number_of_tool(double value) {
  return is_whole(value) && value < first_named_tool;
}

// Where G41 or G42 stands in a line that is not read, outside of comments; npos: nowhere.
[[nodiscard]] std::size_t place_of_side(std::string_view text);

// The bits of BlockWords::whole; I J K and tracking axes have one for each word.
struct WholeWord {
  static constexpr unsigned axis = 0;
  static constexpr unsigned center = 3;
  static constexpr unsigned radius = 6;
  static constexpr unsigned corner = 7;
  static constexpr unsigned feed = 8;
  static constexpr unsigned tracking = 9;
};

// What the words of one block say, before any of it takes effect: the order of
// the words within a block does not matter.
struct BlockWords {
  struct Function {
    const GFunction* function = nullptr;
    std::uint32_t begin = 0;

    // Whatever its decimals are.
    [[nodiscard]] bool is(int number) const {
      return function != nullptr && function->number == number;
    }
    // G51.1 is (51, 1).
    [[nodiscard]] bool is(int number, int tenth) const {
      return function != nullptr && function->tenths() == tenths_of(number, tenth);
    }
    [[nodiscard]] bool is(const GFunction& other) const { return is(other.number, other.tenth); }
  };
  struct Value {
    double value = 0;
    std::uint32_t begin = 0;
  };

  [[nodiscard]] const Function& of(GGroup group) const {
    return functions[static_cast<std::size_t>(group)];
  }
  [[nodiscard]] bool has(GGroup group) const { return of(group).function != nullptr; }
  void set(const GFunction& function, std::uint32_t begin) {
    if (function.group == GGroup::unfollowed_end || function.group == GGroup::frame)
      coordinates.ends.push_back(static_cast<std::int16_t>(function.tenths()));
    functions[static_cast<std::size_t>(function.group)] = {.function = &function, .begin = begin};
  }
  void clear(GGroup group) { functions[static_cast<std::size_t>(group)] = {}; }
  // The main axes X Y Z that the line names.
  [[nodiscard]] AxisBits named_axes() const {
    AxisBits named = 0;
    for (std::size_t main = 0; main < move.end.size(); ++main)
      if (move.end[main]) named |= main_axis_bit(main);
    return named;
  }
  // G41, G42
  [[nodiscard]] bool selects() const { return has(GGroup::side) && !deselects(); }
  // G40
  [[nodiscard]] bool deselects() const { return of(GGroup::side).is(40); }

  // The tool that the line names, and its words about the radius.
  struct Tools {
    // $TC_DP6[t,d]= and $TC_DP15[t,d]= of Sinumerik, V.G.WZ[t].R of ISG: its row_of_edge() and
    // its radius or wear, mm.
    enum class EdgeLength : std::uint8_t { radius, wear };
    struct EdgeData {
      std::int64_t row = 0;
      EdgeLength kind = EdgeLength::radius;
      double length = 0;
      std::uint32_t begin = 0;
    };

    std::optional<Value> d_word{};
    std::optional<std::uint32_t> only{};  // the radius of the setup is its: D, G41
    std::optional<Value> t_word{};
    std::optional<std::int64_t> named{};    // of T="NAME"
    std::optional<Value> later_t_word{};    // of FANUC: fetched after the change by M06
    std::optional<std::uint32_t> change{};  // M06
    bool loads = false;                     // M06
    bool q_word_names_tool = false;         // M61 of LinuxCNC: the tool in the spindle
    std::optional<Value> radius{};          // V.G.WZ_AKT.R
    bool radius_is_change = false;          // it is what that one grows by
    std::optional<Value> allowance{};       // OFFN
    std::vector<EdgeData> edges{};
  };
  // Words that change what coordinates mean.
  struct Coordinates {
    // In tenths; of a line with several of them `functions` has one: G15 G50, G69 G50.1.
    std::vector<std::int16_t> ends{};
    bool adds_to_frame = false;   // ASCALE
    std::string frame{};          // of Sinumerik: which one the line sets as a whole, $P_UIFR[1]
    bool changes_length = false;  // G43, G44, G49
    bool sets_position = false;   // G92: the axis words say where the machine stands
  };
  // # commands and other words of ISG only.
  struct Isg {
    std::optional<TrcOptions> options{};  // #TRC
    std::optional<double> tangfeed{};     // #TANGFEED
    std::optional<std::uint32_t> number_alone{};
    std::optional<std::uint32_t> passed_function{};  // a G function of ProgramSetup::pass_words
    std::optional<std::uint32_t> weights{};     // G130 and the like: axis words are percentages
    std::optional<std::uint32_t> suppresses{};  // #SUPPRESS OFFSETS
    std::uint32_t command = 0;                  // where a # command stands
    std::string corner{};                       // G301, G302, #CHR=, #RND=: what it is
    std::uint32_t corner_begin = 0;
    bool corner_has_i_word = false;       // of G301, G302: I is its size
    std::optional<bool> cycle_contour{};  // #CONTOUR BEGIN, #CONTOUR END
    bool has_command = false;
    bool has_spindle = false;
    bool homes = false;  // G74
  };
  struct Spindle {
    std::optional<Value> speed{};         // S; of Fagor's G72 a factor
    bool is_oriented = false;             // M19: R is an angle
    bool constant_cutting_speed = false;  // G96: D of LinuxCNC is the fastest turn
  };
  // Roundings and chamfers.
  struct Corners {
    std::optional<std::uint32_t> begin{};   // ,R ,C RND= CHF= CHR=, G36 G39 with R
    std::optional<Value> modal_rounding{};  // RNDM=
    std::optional<Value> feed{};            // FRC=
    std::optional<Value> modal_feed{};      // FRCM=
  };
  // Of Sinumerik: 1 for AC(), -1 for IC(), 0 as G90 and G91 say.
  struct References {
    std::array<std::int8_t, 3> end{};
    std::array<std::int8_t, 3> center{};
    std::array<std::int8_t, 3> through{};  // I1= J1= K1=
  };
  // Of Sinumerik, beside centre and radius.
  struct Arcs {
    std::optional<double> sweep{};                  // AR=, degrees
    std::optional<Value> turns{};                   // TURN=, P - 1 of LinuxCNC: further ones
    std::array<std::optional<Value>, 3> through{};  // I1= J1= K1=
    bool is_through = false;                        // CIP
    bool begins_tangents = false;                   // CT
  };
  // Of Sinumerik.
  struct Polar {
    std::optional<Value> angle{};    // AP=, degrees
    std::optional<Value> radius{};   // RP=
    bool increments_angle = false;   // AP=IC()
    bool increments_radius = false;  // RP=IC()
  };
  // Beside G147 … G348.
  struct SoftLead {
    std::optional<Value> length{};     // DISR=, the radius of an arc
    std::optional<Value> clearance{};  // DISCL=
    bool clearance_is_absolute = false;
    std::optional<Value> feed{};              // FAD=
    std::optional<std::uint32_t> way_back{};  // DISRP=
    bool is_followed = false;
    MotionKind motion_before = MotionKind::rapid;
    double feed_before = 0;
  };

  // Axis words of Sinumerik whose variable nobody has given a value: Z=R1.
  struct WithoutValue {
    std::optional<std::uint32_t> begin{};  // of the first
    AxisBits axes = 0;
  };

  // Words that move something by what only the control knows.
  [[nodiscard]] bool moves_unfollowed() const {
    return unfollowed_word.has_value() || without_value.begin.has_value();
  }

  std::array<Function, g_group_count> functions{};
  MoveRequest move{};                     // in the unit of the program
  std::optional<std::uint32_t> axis{};    // where the first axis word stands
  std::optional<std::uint32_t> center{};  // the first I J K R
  std::uint64_t whole = 0;  // coordinates without a decimal point: a bit each, as WholeWord has it
  std::optional<Value> angle{};  // ANG= and ,A in a contour, degrees
  std::optional<Value> feed{};
  std::optional<std::uint32_t> own_feed{};    // FB=
  std::optional<std::uint32_t> tooth_feed{};  // FZ=
  std::optional<Value> l_word{};
  std::optional<Value> p_word{};
  std::optional<Value> q_word{};
  std::optional<Value> h_word{};
  Tools tools{};
  Coordinates coordinates{};
  Isg isg{};
  Spindle spindle{};
  Corners corners{};
  References references{};
  Arcs arc{};
  Polar polar{};
  SoftLead soft{};
  std::uint32_t words = 0;  // without N and comments
  bool to_skip = false;     // leading `/`
  // The line is copied as it stands; where it leads the axes of `forget` only the control knows.
  bool copied = false;
  AxisBits forget = 0;
  std::optional<std::uint32_t> unfollowed_word{};  // TURN=, AP=, RP=, ANG=, ,A
  WithoutValue without_value{};
  std::optional<std::uint32_t> way_round{};      // C=DC(…)
  std::optional<std::uint32_t> further_count{};  // C=IC(…), C=AC(…) under G91
  bool measures = false;                         // MEAS=, MEAW= of Sinumerik
  bool calls_the_machine = false;     // NAME(…) of Sinumerik, which the program does not have
  bool side_of_machine = false;       // G41 or G42 beside a cycle that compensates by itself
  std::optional<bool> masks{};        // CDON; CDOF and CDOF2
  std::optional<Value> kept_modes{};  // M70 … M72 of LinuxCNC
};

}  // namespace trc
