#include "server/http/json_size.h"

#include <cstddef>
#include <string>

namespace trc::server::http {
namespace {

// Upper bounds: no block has more.
constexpr std::size_t most_objects_of_block = 8;
constexpr std::size_t most_values_of_block = 64;
// Whoever reads the text refuses it where it is nested more deeply.
constexpr std::size_t deepest = 100;

struct Size {
  std::size_t objects = 0;
  std::size_t values = 0;
};

// Up to where it is nested too deeply. Does not check whether the text is valid JSON.
Size size_of(std::string_view json) {
  Size size;
  bool is_text = false;
  std::size_t depth = 0;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') is_text = !is_text;
    if (is_text) {
      i += c == '\\' ? 1 : 0;
      continue;
    }
    const bool begins = c == '{' || c == '[';
    if (begins && depth++ == deepest) return size;
    if ((c == '}' || c == ']') && depth > 0) --depth;
    size.objects += begins ? 1 : 0;
    size.values += c == ',' ? 1 : 0;
  }
  return size;
}

}  // namespace

std::optional<Ending> refuse_size(std::string_view json, const Config& config) {
  const std::uint32_t most = config.max_blocks_per_batch;
  const Size size = size_of(json);
  if (size.objects <= most_objects_of_block * most && size.values <= most_values_of_block * most)
    return std::nullopt;
  return refuse_batch_of("> " + std::to_string(most), most);
}

}  // namespace trc::server::http
