#include "client/cli/file_name.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc::cli {

std::string text_of_name(std::string_view name) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  while (!name.empty()) {
    const std::size_t length = utf8_character(name);
    if (length > 0) {
      text += name.substr(0, length);
    } else {
      const auto byte = static_cast<unsigned char>(name.front());
      text += "\\x";
      text += digits[byte >> 4U];
      text += digits[byte & 0xFU];
    }
    name.remove_prefix(std::max<std::size_t>(1, length));
  }
  return text;
}

std::string name_of_text(const std::string& text) {
  std::error_code none;
  if (std::filesystem::exists(text, none)) return text;
  std::string name;
  for (std::size_t i = 0; i < text.size();) {
    unsigned byte = 0;
    const char* const begin = text.data() + std::min(i + 2, text.size());
    const char* const end = text.data() + std::min(i + 4, text.size());
    if (text.compare(i, 2, "\\x") == 0 && end - begin == 2 &&
        std::from_chars(begin, end, byte, 16).ptr == end) {
      name += static_cast<char>(byte);
      i += 4;
    } else {
      name += text[i++];
    }
  }
  return std::filesystem::exists(name, none) ? name : text;
}

}  // namespace trc::cli
