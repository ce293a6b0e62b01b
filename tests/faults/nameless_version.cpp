// What a program says of itself that was built outside of a clone.

#include "core/base/version.h"

namespace trc {

std::string_view version() { return "0.0.1"; }

std::string_view commit() { return "unknown"; }

}  // namespace trc
