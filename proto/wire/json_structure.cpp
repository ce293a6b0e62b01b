#include "proto/wire/json_structure.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace trc::wire {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

// Protobuf refuses deeper nesting; the paths of a million brackets would fill the memory.
constexpr std::size_t deepest = 100;

// An object or a list that has begun but not ended.
struct Open {
  std::string path;
  const Descriptor* type = nullptr;  // null: a map, or unknown
  // That of the elements of a list, and of the values of a map; null for other objects.
  const FieldDescriptor* field = nullptr;
  bool is_list = false;
  std::size_t index = 0;             // of a list
  std::vector<std::string> names{};  // of an object
};

// A name with its ASCII escapes resolved; other escapes stay.
std::string plain(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      name += text[i];
      continue;
    }
    unsigned code = 0;
    const char* const digits = text.data() + std::min(i + 2, text.size());
    const char* const end = text.data() + std::min(i + 6, text.size());
    const auto read = std::from_chars(digits, end, code, 16);
    constexpr unsigned ascii = 0x80;
    if (text[i + 1] != 'u') {
      name += text.substr(i, 2);
      ++i;
    } else if (read.ec == std::errc() && read.ptr == digits + 4 && code < ascii) {
      name += static_cast<char>(code);
      i += 5;
    } else {
      name += text[i];
    }
  }
  return name;
}

const FieldDescriptor* field_of(const Descriptor* type, const std::string& name) {
  if (type == nullptr) return nullptr;
  const FieldDescriptor* const field = type->FindFieldByName(name);
  if (field != nullptr) return field;
  for (int i = 0; i < type->field_count(); ++i)
    if (type->field(i)->json_name() == name) return type->field(i);
  return nullptr;
}

// Protobuf accepts such a name without quotes. For any other character it reports the fault and its
// place itself.
bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

bool holds_a_double(const FieldDescriptor* field) {
  return field != nullptr && (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ||
                              field->cpp_type() == FieldDescriptor::CPPTYPE_FLOAT);
}

// A number in quotes as the JSON mapping has it.
bool is_number(std::string_view text) {
  if (text == "NaN" || text == "Infinity" || text == "-Infinity") return true;
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  // Too large, or too small: Protobuf tells.
  const bool is_read = read.ec == std::errc() || read.ec == std::errc::result_out_of_range;
  return is_read && read.ptr == end && text.find_first_of("iInN") == text.npos;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Reader {
 public:
  // A Struct is JSON as such and may hold anything.
  Reader(std::string_view json, const Descriptor& type)
      : json_(json),
        checks_lists_(type.well_known_type() == Descriptor::WELLKNOWNTYPE_UNSPECIFIED),
        type_(&type) {}

  std::string fault() {
    for (at_ = 0; at_ < json_.size(); ++at_) {
      const char c = json_[at_];
      const bool in_list = checks_lists_ && !open_.empty() && open_.back().is_list;
      if (c == '"') {
        const std::size_t first = at_ + 1;
        // Elsewhere something is missing before the text.
        const bool is_value = before_ == ':' || (in_list && (before_ == '[' || before_ == ','));
        if (!read_text()) return {};
        const std::string_view text = json_.substr(first, at_ - first);
        if (is_value && holds_a_double(field_of_value()) && !is_number(text))
          return (in_list ? element() : path_) + ": \"" + std::string(text) +
                 "\" is not possible; it takes a number";
      } else if (c == '\'') {
        return "' stands where JSON has \"";
      } else if (in_list && c == 'n' && json_.substr(at_, 4) == "null") {
        return element() + ": is null, where a list has values";
      } else if (checks_lists_ && c == 'n' && !is_name_ && json_.substr(at_, 4) == "null") {
        return path_ + ": is null; give it a value or leave it out";
      } else if (in_list && c == '[') {
        return element() + ": is a list within a list";
      } else if (c == '{' || c == '[') {
        if (open_.size() == deepest) return {};
        begin(c == '[');
      } else if (c == '}' || c == ']') {
        if (open_.empty()) return {};
        if (before_ == ',') return place() + "a comma stands before " + c;
        if (const std::string twice = end(); !twice.empty())
          return twice + ": is given more than once";
      } else if (c == ',' && !open_.empty()) {
        ++open_.back().index;
        is_name_ = !open_.back().is_list;
      } else if (c == ':') {
        is_name_ = false;
      } else if (is_name_ && begins_name(c)) {
        return place() + "a name has no quotes";
      }
      if (!is_space(json_[at_])) before_ = json_[at_];
    }
    return {};
  }

 private:
  // The next element of the list, as "batch.blocks[3]".
  [[nodiscard]] std::string element() const {
    return open_.back().path + "[" + std::to_string(open_.back().index) + "]";
  }

  // The field whose value comes next; null: unknown, or not one of a message or a map.
  [[nodiscard]] const FieldDescriptor* field_of_value() const {
    if (!checks_lists_ || open_.empty()) return nullptr;
    return open_.back().is_list ? open_.back().field : field_;
  }

  // The present object or list, as "batch: "; empty for the whole text.
  [[nodiscard]] std::string place() const {
    return open_.empty() || open_.back().path.empty() ? "" : open_.back().path + ": ";
  }

  bool read_text() {
    const std::size_t first = ++at_;
    while (at_ < json_.size() && json_[at_] != '"') at_ += json_[at_] == '\\' ? 2 : 1;
    if (at_ >= json_.size()) return false;
    if (!is_name_ || open_.empty()) return true;
    Open& object = open_.back();
    std::string name = plain(json_.substr(first, at_ - first));
    const FieldDescriptor* const field = field_of(object.type, name);
    if (field != nullptr) name = field->name();
    type_ = field == nullptr || field->is_map() ? nullptr : field->message_type();
    field_ = field == nullptr ? object.field : field;
    path_ = object.path + (object.path.empty() ? "" : ".") + name;
    object.names.push_back(std::move(name));
    is_name_ = false;
    return true;
  }

  void begin(bool is_list) {
    Open value{.path = path_, .type = type_, .is_list = is_list};
    if (is_list)
      value.field = field_;
    else if (field_ != nullptr && field_->is_map())
      value.field = field_->message_type()->map_value();
    if (!open_.empty() && open_.back().is_list) {
      value.path = element();
      value.type = open_.back().type;
    }
    open_.push_back(std::move(value));
    is_name_ = !is_list;
  }

  std::string end() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    is_name_ = false;
    std::ranges::sort(closed.names);
    const auto twice = std::ranges::adjacent_find(closed.names);
    if (twice == closed.names.end()) return {};
    return closed.path + (closed.path.empty() ? "" : ".") + *twice;
  }

  std::string_view json_;
  bool checks_lists_;
  std::size_t at_ = 0;
  char before_ = '\0';  // the last character that is not a blank
  std::vector<Open> open_;
  bool is_name_ = false;
  // The type of the next value, and its field.
  const Descriptor* type_;
  const FieldDescriptor* field_ = nullptr;
  std::string path_;
};

}  // namespace

std::string fault_of_structure(std::string_view json, const Descriptor& type) {
  return Reader(json, type).fault();
}

}  // namespace trc::wire
