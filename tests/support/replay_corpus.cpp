// Plays the files of a corpus through a fuzz target, once each, in the order of their names.
// Stands in for libFuzzer's main function where the compiler has none.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) files.push_back(entry);
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    std::fprintf(stderr, "%s\n", file.c_str());
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
    // An empty vector may have no address, and a fuzz target never gets a null pointer.
    const std::uint8_t nothing = 0;
    LLVMFuzzerTestOneInput(
        bytes.empty() ? &nothing : reinterpret_cast<const std::uint8_t*>(bytes.data()),
        bytes.size());
  }
  // A wrong folder must not pass for a clean corpus.
  return files.empty() ? 1 : 0;
}
