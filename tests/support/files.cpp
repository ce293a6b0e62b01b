#include "tests/support/files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tests/support/places.h"

namespace trc::testing_support {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> nc_programs_in(const std::string& folder) {
  std::vector<fs::path> programs;
  for (const auto& entry :
       fs::directory_iterator(fs::path(source_dir()) / "tests/programs" / folder))
    if (entry.path().extension() == ".nc") programs.push_back(entry.path());
  // A wrong folder must not pass for one whose programs are all right.
  if (programs.empty()) throw std::runtime_error("no NC programs in tests/programs/" + folder);
  std::sort(programs.begin(), programs.end());
  return programs;
}

}  // namespace trc::testing_support
