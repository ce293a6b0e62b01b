#include "server/text.h"

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc::server {

bool acts_on_display(std::uint32_t code_point) {
  const auto lies = [&](std::uint32_t first, std::uint32_t last) {
    return code_point >= first && code_point <= last;
  };
  return lies(0, 0x1F) || lies(0x7F, 0x9F) || lies(0x200E, 0x200F) || lies(0x2028, 0x202E) ||
         lies(0x2066, 0x2069);
}

std::string presentable(std::string_view text, std::size_t most) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_character(text);
    std::string_view character = length == 0 ? replacement_character : text.substr(0, length);
    if (acts_on_display(code_point(character))) character = " ";
    if (result.size() + character.size() > most) return result + "...";
    result += character;
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

}  // namespace trc::server
