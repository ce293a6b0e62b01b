#include "client/load/json_object.h"

#include "core/base/number_text.h"

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
