#include "proto/wire/block_values.h"

#include <algorithm>
#include <limits>

namespace trc::wire {

bool check_text(const std::string& text, const FieldPath& path, FieldFaults& faults) {
  constexpr std::size_t longest = 65536;
  if (text.size() > longest) {
    add_fault(
        path,
        "has " + std::to_string(text.size()) + " bytes, allowed are " + std::to_string(longest),
        faults);
    return false;
  }
  // Also those of U+0080 to U+009F, which UTF-8 writes as C2 and one more byte.
  unsigned before = 0;
  const auto is_control = [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_c1 = before == 0xc2 && byte < 0xa0;
    before = byte;
    return (byte < 0x20 && c != '\t') || byte == 0x7f || is_c1;
  };
  if (std::ranges::none_of(text, is_control)) return true;
  add_fault(path, "holds a control character", faults);
  return false;
}

bool check_number(std::uint64_t number, const FieldPath& path, FieldFaults& faults) {
  constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (is_number(number)) return true;
  add_fault(path, "is " + std::to_string(number) + ", allowed is up to " + std::to_string(largest),
            faults);
  return false;
}

}  // namespace trc::wire
