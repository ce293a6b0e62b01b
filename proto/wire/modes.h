#pragma once

#include "core/nc/state/block.h"
#include "core/nc/state/trc_mode.h"
#include "core/trc/lead_settings.h"
#include "proto/wire/enums.h"
#include "trc/v1/block.pb.h"
#include "trc/v1/setup.pb.h"

namespace trc::wire {

// The modal words that setups and commands share.

inline constexpr EnumTable<v1::CompensationSide, Side, 3> sides{{
    {v1::COMPENSATION_SIDE_OFF, Side::off},
    {v1::COMPENSATION_SIDE_LEFT, Side::left},
    {v1::COMPENSATION_SIDE_RIGHT, Side::right},
}};

inline constexpr EnumTable<v1::SelectionMode, Selection, 6> selections{{
    {v1::SELECTION_MODE_DIRECT, Selection::direct},
    {v1::SELECTION_MODE_INDIRECT, Selection::indirect},
    {v1::SELECTION_MODE_ON_PATH, Selection::on_path},
    {v1::SELECTION_MODE_PERPENDICULAR, Selection::perpendicular},
    {v1::SELECTION_MODE_INSIDE_CORNER, Selection::inside_corner},
    {v1::SELECTION_MODE_WITHOUT_BLOCK, Selection::without_block},
}};

inline constexpr EnumTable<v1::Transition, Transition, 2> transitions{{
    {v1::TRANSITION_LINEAR, Transition::linear},
    {v1::TRANSITION_CIRCULAR, Transition::circular},
}};

inline constexpr EnumTable<v1::ContourMasking, Masking, 2> maskings{{
    {v1::CONTOUR_MASKING_OFF, Masking::off},
    {v1::CONTOUR_MASKING_ON, Masking::on},
}};

inline constexpr EnumTable<v1::FeedAdaptation, FeedAdaptation, 2> feed_adaptations{{
    {v1::FEED_ADAPTATION_OFF, FeedAdaptation::off},
    {v1::FEED_ADAPTATION_ON, FeedAdaptation::on},
}};

inline constexpr EnumTable<v1::BlockRole, ContourRole, 2> block_roles{{
    {v1::BLOCK_ROLE_WALL, ContourRole::wall},
    {v1::BLOCK_ROLE_LEAD, ContourRole::lead},
}};

inline constexpr EnumTable<v1::Leads::Find, LeadSettings::Find, 3> lead_searches{{
    {v1::Leads::FIND_AUTO, LeadSettings::Find::automatic},
    {v1::Leads::FIND_NONE, LeadSettings::Find::none},
    {v1::Leads::FIND_BLOCKS, LeadSettings::Find::counted},
}};

// Whether centres are absolute.
inline constexpr EnumTable<v1::CenterReference, bool, 2> center_references{{
    {v1::CENTER_REFERENCE_ABSOLUTE, true},
    {v1::CENTER_REFERENCE_START, false},
}};

// Whether centres are corrected.
inline constexpr EnumTable<v1::CenterCorrection, bool, 2> center_corrections{{
    {v1::CENTER_CORRECTION_OFF, false},
    {v1::CENTER_CORRECTION_ON, true},
}};

// The reference control holds radii in 32 bits of 0.1 um (rule 1.6).
inline bool check_tool_radius(double radius, const FieldPath& path, FieldFaults& faults) {
  constexpr double largest = 214748.3647;
  return check_range(radius, {-largest, largest, "mm"}, path, faults);
}

}  // namespace trc::wire
