#pragma once

#include <cstdint>

namespace trc {

// The place in the program that something came from. Inserted blocks carry the source of the block
// they follow (an approach insertion that of the approach block).
struct Source {
  // 0-based position among the input blocks of the session. In NC text every
  // line with at least one word counts; the program name, blank lines and
  // lines that hold a comment only do not.
  std::uint64_t index = 0;
  // N word of the block, or `no_number`.
  std::int64_t number = no_number;
  // 1-based line of the NC text; 0 when the block did not come from text.
  std::uint32_t line = 0;
  // 0-based number among the motions that one block has become: a chamfer after its line, the arc
  // of a lead after the way to it. Clients do not see it.
  std::uint8_t part = 0;

  static constexpr std::int64_t no_number = -1;

  bool operator==(const Source&) const = default;
};

}  // namespace trc
