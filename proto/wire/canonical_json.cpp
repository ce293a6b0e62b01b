#include "proto/wire/canonical_json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/base/check.h"

namespace trc::wire {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;

// Ranks UTF-8 bytes in the order of UTF-16. Characters of two UTF-16 units have lead bytes from F0
// on and come before U+E000, whose lead byte is EE.
int utf16_rank(char byte) {
  const int value = static_cast<unsigned char>(byte);
  if (value < 0xEE) return value;
  return value < 0xF0 ? value + 0x10 : value - 2;
}

bool in_order_of_utf16(std::string_view a, std::string_view b) {
  return std::ranges::lexicographical_compare(a, b, {}, utf16_rank, utf16_rank);
}

void append(std::string_view text, std::string& out) {
  constexpr std::string_view with_letter = "\b\t\n\f\r\"\\";
  constexpr std::string_view letters = "btnfr\"\\";
  constexpr std::string_view hexadecimal = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    if (const std::size_t at = with_letter.find(c); at != std::string_view::npos) {
      out += '\\';
      out += letters[at];
    } else if (const auto code = static_cast<unsigned char>(c); code < 0x20) {
      out += "\\u00";
      out += hexadecimal[code / 16U];
      out += hexadecimal[code % 16U];
    } else {
      out += c;
    }
  }
  out += '"';
}

// The fewest digits that read back as this number, formatted as Number::toString of ECMAScript
// does.
void append(double number, std::string& out) {
  check(std::isfinite(number), "JSON has finite numbers alone");
  if (number == 0) {
    out += '0';
    return;
  }
  std::array<char, 32> printed{};
  const auto end = std::to_chars(printed.data(), printed.data() + printed.size(), std::abs(number),
                                 std::chars_format::scientific)
                       .ptr;
  const std::string_view text(printed.data(), static_cast<std::size_t>(end - printed.data()));
  const std::size_t exponent_at = text.find('e');
  std::string digits(text.substr(0, exponent_at));
  std::erase(digits, '.');
  int exponent = 0;
  const char* first = text.data() + exponent_at + 1;
  if (*first == '+') ++first;
  std::from_chars(first, end, exponent);
  // Digits before the decimal point.
  const int before = exponent + 1;
  const int count = static_cast<int>(digits.size());
  constexpr int most_before = 21;
  constexpr int most_zeros = 6;
  if (number < 0) out += '-';
  if (before > most_before || before <= -most_zeros) {
    if (count > 1) digits.insert(1, 1, '.');
    out += digits + (exponent < 0 ? "e" : "e+") + std::to_string(exponent);
  } else if (before <= 0) {
    out += "0." + std::string(static_cast<std::size_t>(-before), '0') + digits;
  } else if (before < count) {
    digits.insert(static_cast<std::size_t>(before), 1, '.');
    out += digits;
  } else {
    out += digits + std::string(static_cast<std::size_t>(before - count), '0');
  }
}

void append(const Struct& object, std::string& out);

void append(const Value& value, std::string& out) {
  switch (value.kind_case()) {
    case Value::kNumberValue:
      return append(value.number_value(), out);
    case Value::kStringValue:
      return append(std::string_view(value.string_value()), out);
    case Value::kBoolValue:
      out += value.bool_value() ? "true" : "false";
      return;
    case Value::kStructValue:
      return append(value.struct_value(), out);
    case Value::kListValue: {
      out += '[';
      for (int i = 0; i < value.list_value().values_size(); ++i) {
        if (i > 0) out += ',';
        append(value.list_value().values(i), out);
      }
      out += ']';
      return;
    }
    default:
      out += "null";
  }
}

void append(const Struct& object, std::string& out) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : object.fields()) names.emplace_back(name);
  std::ranges::sort(names, in_order_of_utf16);
  out += '{';
  for (const std::string_view name : names) {
    if (name != names.front()) out += ',';
    append(name, out);
    out += ':';
    append(object.fields().at(std::string(name)), out);
  }
  out += '}';
}

}  // namespace

std::string canonical_json(const Struct& object) {
  std::string text;
  append(object, text);
  return text;
}

}  // namespace trc::wire
