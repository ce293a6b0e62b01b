#include "proto/wire/json_fault.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/likely_meant.h"

namespace trc::wire {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using Pair = std::pair<std::string_view, std::string_view>;

// Faults of text that is not JSON.
constexpr auto of_syntax = std::to_array<Pair>({
    {"Unexpected end of string", "the text ends too early"},
    {"Closing quote expected", "the closing quote is missing"},
    {"Expected an object key", "the name of a field in quotes, or } is expected"},
    {"Expected : between", "a colon is expected after the name"},
    {"Expected , or ]", "a comma or ] is expected"},
    {"Expected , or }", "a comma or } is expected"},
    {"Expected a value", "a value is expected"},
    {"Unexpected token", "this is no value"},
    {"Unable to parse number", "this is no number"},
    {"Octal/hex numbers", "this is no number"},
    {"Number exceeds", "this number is too large"},
    {"Parsing terminated", "something stands after the end"},
    {"Encountered non UTF-8", "this is no UTF-8"},
    {"Invalid escape", "this is no escape sequence"},
    {"Illegal hex", "this is no escape sequence"},
    {"Message too deep", "it is nested too deeply"},
});

constexpr auto of_types = std::to_array<Pair>({
    {"TYPE_DOUBLE", "a number"},
    {"TYPE_FLOAT", "a number"},
    {"TYPE_INT32", "a whole number"},
    {"TYPE_INT64", "a whole number"},
    {"TYPE_UINT32", "a whole number"},
    {"TYPE_UINT64", "a whole number"},
    {"TYPE_BOOL", "true or false"},
    {"TYPE_STRING", "text"},
    {"TYPE_BYTES", "text in Base64"},
});

std::optional<std::string_view> begun_by(std::span<const Pair> rows, std::string_view text) {
  const auto row =
      std::ranges::find_if(rows, [&](const Pair& one) { return text.starts_with(one.first); });
  if (row == rows.end()) return std::nullopt;
  return row->second;
}

// The values that a field of this type takes; protobuf names the type.
std::string taken_by(std::string_view type) {
  if (const auto words = begun_by(of_types, type)) return std::string(*words);
  const std::string name(type.substr(type.rfind('/') + 1));
  const auto* const pool = google::protobuf::DescriptorPool::generated_pool();
  const auto* const of_words = pool->FindEnumTypeByName(name);
  if (of_words == nullptr) return "an object in { }";
  std::string words;
  for (int i = 0; i < of_words->value_count(); ++i)
    words += (i > 0 ? ", " : "") + of_words->value(i)->name();
  return words;
}

// "line 3, column 12: " if the excerpt occurs once in the text; otherwise the text at the mark.
std::string place_of(std::string_view excerpt, std::size_t mark, std::string_view text) {
  const std::size_t at = text.find(excerpt);
  if (at == text.npos || text.find(excerpt, at + 1) != text.npos)
    return "at " + std::string(excerpt.substr(std::min(mark, excerpt.size()))) + ": ";
  const std::string_view before = text.substr(0, at + mark);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": ";
}

// "(setup.options) revers: …" or "(setup.tool_radius): …": the field, and the text about it.
std::pair<std::string, std::string_view> field_and_rest(std::string_view said) {
  std::string field;
  if (said.starts_with('(')) {
    const std::size_t close = said.find(')');
    field = said.substr(1, close - 1);
    said.remove_prefix(std::min(close + 1, said.size()));
  }
  if (said.starts_with(' ')) said.remove_prefix(1);
  const std::size_t colon = said.find(": ");
  if (colon == said.npos) return {field, said};
  if (colon > 0) field.append(field.empty() ? "" : ".").append(said.substr(0, colon));
  return {field, said.substr(colon + 2)};
}

// "; did you mean lookAheadBlocks?" for "setup.lookAheadBlok", in the user's style of spelling;
// empty if no field of the message is similar.
std::string meant_by(std::string_view field, const Descriptor& root) {
  const Descriptor* type = &root;
  while (const std::size_t dot = field.find('.') + 1) {
    const std::string name(field.substr(0, std::min(field.find('['), dot - 1)));
    const FieldDescriptor* const within = type->FindFieldByName(name);
    if (within == nullptr || within->message_type() == nullptr) return {};
    type = within->message_type();
    field.remove_prefix(dot);
  }
  std::vector<std::string> names;
  for (int i = 0; i < type->field_count(); ++i) {
    names.push_back(type->field(i)->json_name());
    names.push_back(type->field(i)->name());
  }
  const auto meant = likely_meant(field, names);
  return meant ? "; did you mean " + *meant + "?" : std::string();
}

// "it takes one of batch, columns, not two", for "oneof field 'path' is already set. …".
std::string two_kinds(std::string_view said, const Descriptor& type) {
  said.remove_prefix(std::min(said.find('\'') + 1, said.size()));
  const auto* const kinds = type.FindOneofByName(std::string(said.substr(0, said.find('\''))));
  if (kinds == nullptr) return "it takes one of its kinds, not two";
  std::string names;
  for (int i = 0; i < kinds->field_count(); ++i)
    names += (i > 0 ? ", " : "") + kinds->field(i)->name();
  return "it takes one of " + names + ", not two";
}

std::optional<std::string> fault_of_field(std::string_view said, const Descriptor& type_of_all) {
  constexpr std::string_view invalid = "invalid value ";
  constexpr std::string_view for_type = " for type ";
  constexpr std::string_view object = "Starting an object";
  constexpr std::string_view one_of = "oneof field";
  const auto [field, rest] = field_and_rest(said);
  if (rest.starts_with("Root element")) return "it must be an object in { }";
  if (rest.starts_with("Cannot find field"))
    return field + ": there is no such field" + meant_by(field, type_of_all);
  if (rest.starts_with("Proto field is not repeating"))
    return field + ": it takes one value, no list";
  const std::size_t type_at = rest.rfind(for_type);
  if (!rest.starts_with(invalid) || type_at == rest.npos) return std::nullopt;
  const std::string_view type = rest.substr(type_at + for_type.size());
  const std::string_view value = rest.substr(invalid.size(), type_at - invalid.size());
  if (value.starts_with(one_of))
    return field.empty() ? two_kinds(value, type_of_all)
                         : field + ": it takes one of its kinds, not two";
  if (value.starts_with(object))
    return field + (field.empty() ? "" : ".") + std::string(type) +
           ": it takes one value, no object";
  return field + ": " + std::string(value) + " is not possible; it takes " + taken_by(type);
}

}  // namespace

std::string json_fault(std::string_view said, std::string_view text, const Descriptor& type) {
  const std::size_t first = said.find('\n');
  const std::string_view what = said.substr(0, first);
  if (const auto words = begun_by(of_syntax, what)) {
    // The next line is the excerpt around the place; the line below it has an arrow.
    const std::size_t last = said.rfind('\n');
    if (first == said.npos || last == first) return std::string(*words);
    const std::string_view excerpt = said.substr(first + 1, last - first - 1);
    if (excerpt.empty()) return std::string(*words);
    return place_of(excerpt, said.size() - last - 2, text) + std::string(*words);
  }
  if (auto fault = fault_of_field(what, type)) return *std::move(fault);
  return what.empty() ? "it is no JSON" : std::string(what);
}

}  // namespace trc::wire
