#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/length_unit.h"
#include "core/base/source.h"
#include "core/geometry/segment.h"
#include "core/nc/state/program_state.h"

namespace trc {

// DISCL=, mm.
struct SoftClearance {
  double distance = 0;
  bool absolute = false;  // a coordinate of the third axis

  template <class Archive>
  void serialize(Archive& archive) {
    archive(distance, absolute);
  }
};

// G147 and the like, until the block that ends where the contour begins.
struct SoftApproach {
  Lead lead{};
  std::optional<double> height{};  // of the contour, mm: the third axis
  std::optional<SoftClearance> clearance{};
  bool along_the_lead = true;  // G340
  double feed = 0;             // FAD, mm/min; 0: none
  bool rapid = false;          // how the tool came before
  double feed_before = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lead, height, clearance, along_the_lead, feed, rapid, feed_before);
  }
};

// What M70 of LinuxCNC keeps for M72.
struct KeptModes {
  LengthUnit unit = LengthUnit::mm;
  bool incremental = false;
  bool absolute_center = false;
  std::int16_t feed_mode = 94;
  double feed = 0;  // mm/min
  Plane plane = Plane::xy;
  std::int64_t work_offset = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(unit, incremental, absolute_center, feed_mode, feed, plane, work_offset);
  }
};

// A function under which coordinates mean something else. Several may be in force, each up to an
// end of its own.
struct UnfollowedMode {
  std::int32_t function = 0;  // in tenths
  std::uint32_t line = 0;
  std::string meaning{};
  std::string frame{};     // of Sinumerik: the one that scales, $P_UIFR[1]
  bool is_motion = false;  // G33 and the like: in force up to the next motion function

  template <class Archive>
  void serialize(Archive& archive) {
    archive(function, line, meaning, frame, is_motion);
  }
};

// Further modes of the dialects of plain letters and numbers. Each member belongs to one part of
// the reader.
struct GcodeModes {
  // The tool that the program has named.
  struct Tools {
    std::int64_t next = 0;  // T
    std::int64_t in_spindle = 0;
    bool named = false;             // by a T word
    bool spindle_is_empty = false;  // T0 M06
    bool changed_by_m6 = false;     // T only prepares a tool
    WordPlace next_place{};
    WordPlace spindle_place{};
    WordPlace edge_place{};                 // of the last D word; with a new tool none
    double edge = 1;                        // of the tool, Sinumerik: D; 0: none
    bool edge_is_of_next = false;           // D stands beside the last T word
    std::int64_t changed_row = 0;           // the row whose data changed since its call; 0: none
    std::optional<std::int64_t> missing{};  // of the last D word: not in the table
    std::string name{};                     // of T="…"
    std::string only_name{};
    // Without a tool table: the one register that stands for the radius of the setup.
    std::optional<std::int64_t> only_register{};
    std::optional<std::int64_t> only_in_spindle{};  // of FANUC without D words

    template <class Archive>
    void serialize(Archive& archive) {
      archive(next, in_spindle, named, spindle_is_empty, changed_by_m6, next_place, spindle_place,
              edge_place, edge, edge_is_of_next, changed_row, missing, name, only_name,
              only_register, only_in_spindle);
    }
  };
  // Of FANUC: the last D word, and whether it stands in the output.
  struct LastRegister {
    std::optional<double> number{};
    bool comes_out = true;
    WordPlace place{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(number, comes_out, place);
    }
  };
  // Lines with `/`, which may be skipped, that give a tool, tool data, or how the contour is
  // reached and its corners are rounded; 0: none.
  struct Skipped {
    std::uint32_t tool = 0;
    std::uint32_t tool_data = 0;
    std::uint32_t approach = 0;
    std::uint32_t next_tool = 0;  // T before M06
    std::uint32_t feed = 0;       // F
    bool dimension = false;       // the last G90 or G91
    bool motion = false;          // the last of G00 … G03

    template <class Archive>
    void serialize(Archive& archive) {
      archive(tool, tool_data, approach, next_tool, feed, dimension, motion);
    }
  };
  // The meaning of coordinates.
  struct Coordinates {
    std::vector<UnfollowedMode> unfollowed{};
    std::uint8_t turned = 0;  // bits of unfollowed.cpp: they are rotated or mirrored
    // The work offset that the program has selected, as take_work_offset() counts them; 0: not
    // known.
    std::int64_t work_offset = 0;
    bool dynamic_offset = false;  // G254: the zero point goes with the turning axes
    AxisBits offset_axes = 0;     // of the plane, by G43.1 of LinuxCNC

    [[nodiscard]] bool is_unfollowed(std::int32_t function) const {
      return std::ranges::find(unfollowed, function, &UnfollowedMode::function) != unfollowed.end();
    }
    // Whether it was in force.
    bool end_unfollowed(std::int32_t function) {
      return std::erase_if(unfollowed, [function](const UnfollowedMode& mode) {
               return mode.function == function;
             }) > 0;
    }
    template <class Archive>
    void serialize(Archive& archive) {
      archive(unfollowed, turned, work_offset, dynamic_offset, offset_axes);
    }
  };
  // Roundings and chamfers.
  struct Corners {
    WordPlace open{};            // whose next motion is still to come
    double modal_rounding = 0;   // RNDM=, mm
    double feed = 0;             // FRCM=, mm/min
    bool last_is_round = false;  // RNDM= applies to the last motion of the contour

    template <class Archive>
    void serialize(Archive& archive) {
      archive(open, modal_rounding, feed, last_is_round);
    }
  };
  // CT, CIP: arcs by name, up to another motion function.
  struct NamedArcs {
    bool in_force = false;
    bool are_written = false;  // their word is in the output no longer

    template <class Archive>
    void serialize(Archive& archive) {
      archive(in_force, are_written);
    }
  };
  // Of polar coordinates, in the plane, in the unit of the program; without: not followed.
  struct Polar {
    std::optional<Point> pole{Point::Zero()};
    std::optional<double> angle{};  // degrees
    std::optional<double> radius{};
    bool rewritten = false;  // one of them stands in a line that is written anew

    template <class Archive>
    void serialize(Archive& archive) {
      archive(pole, angle, radius, rewritten);
    }
  };
  // Of G147 and the like.
  struct SoftLeads {
    int direction = 140;
    bool in_space = true;                    // G340
    std::optional<SoftApproach> approach{};  // its contour begins with the next motion

    template <class Archive>
    void serialize(Archive& archive) {
      archive(direction, in_space, approach);
    }
  };
  // Calls of texts that only the machine has, which may have changed the tool.
  struct Calls {
    std::string last{};
    WordPlace place{};
    bool contour_seen = false;  // one has been selected
    // Since then:
    bool tool_said = false;       // by T, D or a radius
    bool behind_contour = false;  // `last`
    // Of ISG: V.G.WZ_AKT.R stands after the last T or D; a call has come after that.
    bool only_radius_said = false;
    bool radius_doubtful = false;
    bool awaited_by_tool = false;
    std::optional<std::string> unknown{};  // the first one; empty: it has been told
    std::optional<Source> modal_cycle{};

    template <class Archive>
    void serialize(Archive& archive) {
      archive(last, place, contour_seen, tool_said, behind_contour, only_radius_said,
              radius_doubtful, awaited_by_tool, unknown, modal_cycle);
    }
  };
  // Words seen anywhere in the program so far.
  struct Seen {
    bool points = false;        // a coordinate with a decimal point
    bool lathe = false;         // a word that only lathes have
    bool y = false;             // a Y word
    bool program = false;       // an O word that names it
    bool c = false;             // of FANUC: an axis C before contours
    bool z_in_contour = false;  // of ISG: Z in this contour, in X Y and without any Y so far

    template <class Archive>
    void serialize(Archive& archive) {
      archive(points, lathe, y, program, c, z_in_contour);
    }
  };

  // What of lengths was taken over in a unit that nobody has said (D-167).
  struct AssumedUnit {
    bool holds = false;      // neither the setup nor the program has said it so far
    std::uint32_t line = 0;  // of the first such length that stays in force; 0: none
    std::string kept{};      // what it is

    template <class Archive>
    void serialize(Archive& archive) {
      archive(holds, line, kept);
    }
  };

  Tools tools{};
  LastRegister last_register{};
  Skipped skipped{};
  Coordinates coordinates{};
  Corners corners{};
  NamedArcs tangent_arcs{};     // CT
  NamedArcs through_arcs{};     // CIP
  bool leaves_contour = false;  // the last motion in the plane was one of a contour
  Polar polar{};
  SoftLeads soft{};
  Calls calls{};
  Seen seen{};
  AssumedUnit assumed_unit{};
  bool cycle = false;  // each position is one of a drilling cycle
  std::optional<KeptModes> kept{};
  std::uint32_t feed_mode_line = 0;  // of the last G93 … G95
  bool tooth_feed = false;           // FZ= of Sinumerik, until F
  bool enters_parameters = false;    // G10 L50 and L52, up to G11

  template <class Archive>
  void serialize(Archive& archive) {
    archive(tools, last_register, skipped, coordinates, corners, tangent_arcs, through_arcs,
            leaves_contour, polar, soft, calls, seen, assumed_unit, cycle, kept, feed_mode_line,
            tooth_feed, enters_parameters);
  }
};

}  // namespace trc
