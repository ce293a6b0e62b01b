#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/http/view/view.h"

namespace trc::cli {

// The most blocks of contour and path together: a larger page is slow to open.
inline constexpr std::size_t most_page_blocks = 250'000;

// The page that `trc view` serves as one file with its program inside: nothing else is loaded, and
// nothing but its own script is run. `view` holds at most `most_page_blocks`, and its compensated
// text where it is not refused. `language` is that of its messages, as in "de"; empty: not said.
[[nodiscard]] std::string standalone_page(const server::http::View& view,
                                          std::string_view language);

}  // namespace trc::cli
