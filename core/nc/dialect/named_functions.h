#pragma once

#include <array>

#include "core/nc/dialect/g_function.h"

// Names and calls of Sinumerik, and unknown functions, are treated as G functions. Each has a
// number here that no control uses for a G function.

namespace trc::by_name {

// A motion that only the machine knows, whichever axes the line names.
inline constexpr std::int16_t only_machine_knows = 1007;

// ATRANS and the like. TRANS, ROT, MIRROR and SCALE also end the frame programmed
// before.
inline constexpr GFunction frame{.number = 1000, .group = GGroup::frame, .meaning = "a frame"};
inline constexpr GFunction absolute_frame{
    .number = 1009, .group = GGroup::frame, .meaning = "a frame"};
inline constexpr GFunction scale{.number = 1006, .group = GGroup::unfollowed, .meaning = "scaling"};
// $P_PFRAME=CSCALE(…) and the like, which nothing is known to end.
inline constexpr GFunction scaling_frame{
    .number = 1013, .group = GGroup::unfollowed, .meaning = "a frame that scales"};

// TRAORI and the like, TRAFOOF.
inline constexpr GFunction transformation{
    .number = 1001, .group = GGroup::unfollowed, .meaning = "a transformation"};
inline constexpr GFunction transformation_end{.number = 1002, .group = GGroup::unfollowed_end};

// BSPLINE, POLY and the like, in force up to the next motion function (D-73).
inline constexpr GFunction spline{
    .number = 1011, .group = GGroup::unfollowed, .meaning = "a spline or a polynomial"};
// CUT3DC and the like, CUT2D (D-73).
inline constexpr GFunction compensation_in_space{
    .number = 1012, .group = GGroup::unfollowed, .meaning = "TRC in space (CUT3D…)"};
inline constexpr GFunction compensation_in_space_end{.number = 1014,
                                                     .group = GGroup::unfollowed_end};

// #CONTOUR BEGIN of ISG, up to #CONTOUR END.
inline constexpr GFunction cycle_contour{
    .number = 1021, .group = GGroup::unfollowed, .meaning = "the contour of a cycle"};

// TRAILON and the like of X, Y or Z, TRAILOF: in the order of the axes.
inline constexpr std::array coupled_axis{
    GFunction{.number = 1015, .group = GGroup::unfollowed, .meaning = "a coupled axis X"},
    GFunction{.number = 1016, .group = GGroup::unfollowed, .meaning = "a coupled axis Y"},
    GFunction{.number = 1017, .group = GGroup::unfollowed, .meaning = "a coupled axis Z"}};
inline constexpr std::array coupled_axis_end{
    GFunction{.number = 1018, .group = GGroup::unfollowed_end},
    GFunction{.number = 1019, .group = GGroup::unfollowed_end},
    GFunction{.number = 1020, .group = GGroup::unfollowed_end}};

inline constexpr GFunction cycle{
    .number = 1003, .group = GGroup::single_move, .meaning = "a cycle or motion of its own"};
inline constexpr GFunction modal_cycle{
    .number = 1004, .group = GGroup::cycle, .meaning = "a modal cycle"};
inline constexpr GFunction modal_cycle_end{.number = 1005, .group = GGroup::cycle_end};

inline constexpr GFunction call{
    .number = only_machine_knows, .group = GGroup::single_move, .meaning = "a call"};
inline constexpr GFunction unknown_name{
    .number = only_machine_knows, .group = GGroup::single_move, .meaning = "an unknown name"};
inline constexpr GFunction unknown_function{
    .number = only_machine_knows, .group = GGroup::single_move, .meaning = "an unknown function"};
// Of ProgramSetup::pass_words: it moves nothing.
inline constexpr GFunction passing_function{.number = only_machine_knows,
                                            .group = GGroup::axis_technology,
                                            .meaning = "an unknown function"};

// CFIN, beside G10 and G11.
inline constexpr GFunction feed_at_inside{.number = 1008, .group = GGroup::feed_adaptation};

}  // namespace trc::by_name
