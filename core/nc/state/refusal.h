#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace trc {

// What is reported of something that a program says, before it is known where it stands.
struct Refusal {
  Code code = Code::field_invalid;
  std::string detail{};
  std::vector<DiagnosticValue> values{};
  std::optional<DiagnosticPoint> point{};
};

}  // namespace trc
