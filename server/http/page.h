#pragma once

#include <span>
#include <string_view>

namespace trc::server::http {

// The files of client/page, as they are in the source tree.
struct PageFile {
  std::string_view name;
  std::string_view content;
};
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace trc::server::http
