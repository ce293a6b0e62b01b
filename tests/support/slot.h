#pragma once

#include <string_view>

namespace trc::support {

// A slot of 8 mm between two long walls, open at the left.
inline constexpr std::string_view slot =
    "N10 G90 G17 G00 X-20 Y4\n"
    "N20 G138 G41 G01 X-10 Y0 F500\n"
    "N30 X30\n"
    "N40 Y8\n"
    "N50 X-10\n"
    "N60 G40 X-20 Y4\n"
    "N70 M30\n";

}  // namespace trc::support
