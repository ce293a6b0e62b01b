#pragma once

#include <cstddef>

#include "core/base/diagnostic.h"
#include "core/base/source.h"

namespace trc {

// 900212: a pass would have to hold back more than `limit` blocks of one selection.
[[nodiscard]] inline Diagnostic selection_too_long(const Source& source, std::size_t limit) {
  Diagnostic problem = diagnostic(Code::selection_too_long, source);
  problem.values = {{"limit", static_cast<double>(limit)}};
  return problem;
}

}  // namespace trc
