#include "tests/support/places.h"

namespace trc::testing_support {

std::string source_dir() { return TRC_SOURCE_DIR; }

}  // namespace trc::testing_support
