#include "server/rpc/capabilities.h"

#include <array>

#include "core/nc/trc_mode.h"

namespace trc::server {
namespace {

constexpr TrcOptions initial{};
constexpr double longest = 1e6;  // mm
constexpr double fastest = 1e9;  // mm/min

constexpr std::array keywords{
    Keyword{.name = "CONV_CIR_TO_LIN"},
    Keyword{.name = "KERF_MASKING", .available = false},
    Keyword{.name = "REVERSE"},
    Keyword{.name = "IGNORE_CONT_DAMAGE"},
    Keyword{.name = "REMOVE_MASKED_BLOCKS", .available = true},
    Keyword{.name = "EXT_ANGLE_BLOCK_INTERSECTION"},
    Keyword{.name = "G236_LIN"},
    Keyword{.name = "STRETCH_FACTOR", .min = 1, .max = 9, .initial = initial.stretch_factor},
    Keyword{.name = "TANGENTIAL_LIMIT",
            .min = 0.1,
            .max = 3,
            .initial = initial.tangential_limit,
            .unit = "degrees"},
    Keyword{.name = "PERPENDICULAR_RADIUS_CHANGE"},
    Keyword{.name = "GEN_CIR_BLOCK_IN_CORNER"},
    Keyword{.name = "SUPPRESS_TRC"},
    Keyword{.name = "SPLIT"},
    Keyword{.name = "SPLIT_PATH"},
    Keyword{.name = "SPLIT_OFF"},
    Keyword{.name = "DIST_SEG1", .min = 0, .max = longest, .unit = "mm"},
    Keyword{.name = "FEED_SEG1", .min = 0, .max = fastest, .unit = "mm/min"},
    Keyword{.name = "DIST_SEG2", .min = 0, .max = longest, .unit = "mm"},
    Keyword{.name = "FEED_SEG2", .min = 0, .max = fastest, .unit = "mm/min"},
    Keyword{.name = "INVERSE", .available = false},
    Keyword{.name = "ONLINE", .max = 3, .available = false},
    Keyword{.name = "ONLINE_BY_VECTOR", .available = false},
};

constexpr std::array functions{
    GFunction{"G00", "motion", true, "line at rapid rate"},
    GFunction{"G01", "motion", false, "line at feed"},
    GFunction{"G02", "motion", false, "circle or helix, clockwise"},
    GFunction{"G03", "motion", false, "circle or helix, counter-clockwise"},
    GFunction{"G04", "none", false, "dwell; passed through"},
    GFunction{"G05", "none", false, "tangential selection or deselection on a circle"},
    GFunction{"G10", "feed adaptation", true, "the feed applies at the tool centre"},
    GFunction{"G11", "feed adaptation", false, "the feed applies at the contact point"},
    GFunction{"G17", "plane", true, "compensation in the plane XY"},
    GFunction{"G18", "plane", false, "compensation in the plane ZX"},
    GFunction{"G19", "plane", false, "compensation in the plane YZ"},
    GFunction{"G25", "transition", true, "lines at outside corners"},
    GFunction{"G26", "transition", false, "circles at outside corners"},
    GFunction{"G40", "compensation", true, "tool radius compensation off"},
    GFunction{"G41", "compensation", false, "tool to the left of the contour"},
    GFunction{"G42", "compensation", false, "tool to the right of the contour"},
    GFunction{"G70", "unit", false, "coordinates in inch"},
    GFunction{"G71", "unit", true, "coordinates in mm"},
    GFunction{"G90", "coordinates", true, "absolute coordinates"},
    GFunction{"G91", "coordinates", false, "incremental coordinates"},
    GFunction{"G138", "selection mode", false, "direct selection and deselection"},
    GFunction{"G139", "selection mode", true, "indirect selection and deselection"},
    GFunction{"G140", "contour masking", true, "a contour violation stops the program"},
    GFunction{"G141", "contour masking", false, "elements that cannot be cut are masked"},
    GFunction{"G161", "circle centre", false, "I, J and K are absolute"},
    GFunction{"G162", "circle centre", true, "I, J and K are from the start point"},
    GFunction{"G164", "centre correction", false, "an inaccurate centre is not shifted"},
    GFunction{"G165", "centre correction", true,
              "an inaccurate centre is shifted onto a valid circle"},
    GFunction{"G236", "selection mode", false, "direct selection on the path"},
    GFunction{"G237", "selection mode", false, "selection perpendicular to the path"},
    GFunction{"G238", "selection mode", false, "selection in an inside corner"},
    GFunction{"G239", "selection mode", false, "direct selection without a deselection block"},
};

}  // namespace

std::span<const Keyword> trc_keywords() { return keywords; }
std::span<const GFunction> g_functions() { return functions; }

}  // namespace trc::server
