#pragma once

#include <cstdint>

namespace trc {

// The pages (core/base/pages.h) that this thread has taken and not given back, in bytes; negative
// when it has given back what others have taken.
[[nodiscard]] std::int64_t page_bytes_of_thread();

// Sets the function that decides whether this thread may take another piece of pages; if it returns
// false, std::bad_alloc is thrown. It holds as long as the process lives.
void let_pages_ask(bool (*may_take)());

}  // namespace trc
