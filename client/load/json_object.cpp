#include "client/load/json_object.h"

#include <array>
#include <charconv>

namespace trc::cli::load {
namespace {

std::string quoted(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20) {
      result += "\\u00";
      result += digits[byte >> 4U];
      result += digits[byte & 15U];
      continue;
    }
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

// As short as reads back to the same number; finite.
template <class Number>
std::string shortest(Number number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

}  // namespace

JsonObject& JsonObject::add_value(std::string_view name, std::string_view value) {
  if (!members_.empty()) members_ += ',';
  members_ += quoted(name) + ":";
  members_ += value;
  return *this;
}

JsonObject& JsonObject::add(std::string_view name, std::string_view text) {
  return add_value(name, quoted(text));
}
JsonObject& JsonObject::add(std::string_view name, double number) {
  return add_value(name, shortest(number));
}
JsonObject& JsonObject::add(std::string_view name, std::uint64_t number) {
  return add_value(name, shortest(number));
}

}  // namespace trc::cli::load
