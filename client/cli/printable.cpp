#include "client/cli/printable.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/utf8.h"

namespace trc::cli {
namespace {

// Control characters of ASCII and of U+0080 to U+009F, and those that change the direction of
// writing, which would make a line read differently.
bool is_control(std::string_view character) {
  constexpr auto turning =
      std::to_array<std::string_view>({"\u200E", "\u200F", "\u202A", "\u202B", "\u202C", "\u202D",
                                       "\u202E", "\u2066", "\u2067", "\u2068", "\u2069"});
  const auto first = static_cast<unsigned char>(character.front());
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  if (character.size() == 2)
    return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  return std::find(turning.begin(), turning.end(), character) != turning.end();
}

}  // namespace

std::string printable_character(std::string_view character) {
  const std::string shown = as_utf8(character);
  return character == "\t" ? " " : is_control(shown) ? "?" : shown;
}

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  while (!text.empty()) {
    const std::string_view one = text.substr(0, std::max<std::size_t>(1, utf8_character(text)));
    const std::string character = printable_character(one);
    if (shown.size() + character.size() > most) return shown + "...";
    shown += character;
    text.remove_prefix(one.size());
  }
  return shown;
}

void make_printable(google::protobuf::Message& message) {
  constexpr std::size_t longest = 2000;
  using Field = google::protobuf::FieldDescriptor;
  const google::protobuf::Reflection& fields = *message.GetReflection();
  std::vector<const Field*> present;
  fields.ListFields(message, &present);
  for (const Field* field : present) {
    const int count = field->is_repeated() ? fields.FieldSize(message, field) : 0;
    if (field->cpp_type() == Field::CPPTYPE_MESSAGE) {
      if (!field->is_repeated()) make_printable(*fields.MutableMessage(&message, field));
      for (int i = 0; i < count; ++i)
        make_printable(*fields.MutableRepeatedMessage(&message, field, i));
    }
    if (field->cpp_type() != Field::CPPTYPE_STRING) continue;
    if (!field->is_repeated())
      fields.SetString(&message, field, printable(fields.GetString(message, field), longest));
    for (int i = 0; i < count; ++i)
      fields.SetRepeatedString(&message, field, i,
                               printable(fields.GetRepeatedString(message, field, i), longest));
  }
}

}  // namespace trc::cli
