#pragma once

#include <string>

namespace trc::testing_support {

// The sources this test was built from, as an absolute path.
std::string source_dir();

}  // namespace trc::testing_support
