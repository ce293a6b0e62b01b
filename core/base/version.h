#pragma once

#include <string_view>

namespace trc {

// The release of this build, "major.minor.patch".
std::string_view version();

// The first twelve digits of the git commit built from, or "unknown" outside a clone.
std::string_view commit();

}  // namespace trc
