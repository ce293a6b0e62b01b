#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trc::testing_support {

// All bytes of a file; empty where there is none.
[[nodiscard]] std::string content_of(const std::filesystem::path& path);

// The NC programs of tests/programs/`folder`, sorted by their names. Throws where there is none.
[[nodiscard]] std::vector<std::filesystem::path> nc_programs_in(const std::string& folder);

}  // namespace trc::testing_support
