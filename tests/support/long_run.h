#pragma once

#include <cstdlib>
#include <string_view>

namespace trc::support {

// Whether random tests run for long: TRC_TEST_LONG=1, which ./test --long sets.
[[nodiscard]] inline bool is_long_run() {
  const char* value = std::getenv("TRC_TEST_LONG");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace trc::support
