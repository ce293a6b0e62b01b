#pragma once

#include <cstdint>

namespace trc {

// The pages (core/base/pages.h) that this thread has taken and not given back, in bytes; negative
// when it has given back what others have taken.
[[nodiscard]] std::int64_t page_bytes_of_thread();

}  // namespace trc
