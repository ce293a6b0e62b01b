#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace trc {

// Why something that a program says is not done, or a warning of it.
struct Refusal {
  Code code = Code::field_invalid;
  std::string detail{};
  std::vector<DiagnosticValue> values{};
  std::optional<DiagnosticPoint> point{};
};

}  // namespace trc
