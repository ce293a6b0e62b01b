#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace trc {

// Where a word of NC text stands.
struct WordPlace {
  Source source{};
  std::uint32_t column = 0;  // 0: somewhere in the line

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, column);
  }
};

// What is to be reported about a word, before its place is known.
struct Refusal {
  Code code = Code::field_invalid;
  std::string detail{};
  std::vector<DiagnosticValue> values{};
  std::optional<DiagnosticPoint> point{};
  std::optional<WordPlace> place{};  // where it stands, if not where it takes effect
};

}  // namespace trc
