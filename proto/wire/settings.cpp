#include "proto/wire/settings.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "core/base/ascii.h"
#include "core/base/likely_meant.h"
#include "core/base/number_text.h"

namespace trc::wire {
namespace {

using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// The enum value in a setup for a G function.
struct FunctionWord {
  std::string_view function;
  std::string_view value;  // full name, so that it fits one enum only
};
constexpr std::array<FunctionWord, 21> function_words{{
    {"G17", "PLANE_XY"},
    {"G18", "PLANE_ZX"},
    {"G19", "PLANE_YZ"},
    {"G138", "SELECTION_MODE_DIRECT"},
    {"G139", "SELECTION_MODE_INDIRECT"},
    {"G236", "SELECTION_MODE_ON_PATH"},
    {"G237", "SELECTION_MODE_PERPENDICULAR"},
    {"G238", "SELECTION_MODE_INSIDE_CORNER"},
    {"G239", "SELECTION_MODE_WITHOUT_BLOCK"},
    {"G25", "TRANSITION_LINEAR"},
    {"G26", "TRANSITION_CIRCULAR"},
    {"G140", "CONTOUR_MASKING_OFF"},
    {"G141", "CONTOUR_MASKING_ON"},
    {"G10", "FEED_ADAPTATION_OFF"},
    {"G11", "FEED_ADAPTATION_ON"},
    {"G161", "CENTER_REFERENCE_ABSOLUTE"},
    {"G162", "CENTER_REFERENCE_START"},
    {"G164", "CENTER_CORRECTION_OFF"},
    {"G165", "CENTER_CORRECTION_ON"},
    {"0", "KERF_METHOD_LINEAR"},
    {"1", "KERF_METHOD_CIRCULAR"},
}};

// `stretch_factor` for `Stretch-Factor`.
std::string in_snake_case(std::string_view text) {
  std::string result = in_lower_case(text);
  std::ranges::replace(result, '-', '_');
  return result;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// The place of a value: the fields from PathSetup down.
using Route = std::vector<const FieldDescriptor*>;

bool is_settable(const FieldDescriptor& field) {
  return field.type() != FieldDescriptor::TYPE_BYTES;
}

// A position can be set as a whole or by coordinate, and so can leads. Other fields of message type
// are only set by their parts.
bool is_leads(const FieldDescriptor& field) {
  return field.message_type() == v1::Leads::descriptor();
}
bool is_set_as_a_whole(const FieldDescriptor& field) {
  return field.message_type() == v1::Position::descriptor() || is_leads(field);
}

void collect(const google::protobuf::Descriptor& type, Route& above, std::vector<Route>& routes) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (!is_settable(field)) continue;
    above.push_back(&field);
    if (!field.message_type() || is_set_as_a_whole(field)) routes.push_back(above);
    if (field.message_type()) collect(*field.message_type(), above, routes);
    above.pop_back();
  }
}

const std::vector<Route>& all_routes() {
  static const std::vector<Route> routes = [] {
    std::vector<Route> found;
    Route above;
    collect(*v1::PathSetup::descriptor(), above, found);
    return found;
  }();
  return routes;
}

bool is_set_in(const Message& owner, const FieldDescriptor& field) {
  const auto& reflection = *owner.GetReflection();
  return field.is_repeated() ? reflection.FieldSize(owner, &field) > 0
                             : reflection.HasField(owner, &field);
}

// Fields of NC programs, besides those of their paths.
const std::vector<const FieldDescriptor*>& program_fields() {
  static const std::vector<const FieldDescriptor*> fields{
      v1::ProgramSetup::descriptor()->FindFieldByName("block_skip"),
      v1::ProgramSetup::descriptor()->FindFieldByName("pass_words"),
      v1::ProgramSetup::descriptor()->FindFieldByName("encoding"),
      v1::ProgramSetup::descriptor()->FindFieldByName("renumber"),
      v1::ProgramSetup::descriptor()->FindFieldByName("max_executed_lines")};
  return fields;
}

std::string key_of(const Route& route) {
  std::string key;
  for (const FieldDescriptor* field : route) key += (key.empty() ? "" : ".") + field->name();
  return key;
}

std::string prefix_of(const EnumDescriptor& type) {
  constexpr std::string_view unspecified = "UNSPECIFIED";
  const std::string& first = type.value(0)->name();
  return first.size() > unspecified.size() ? first.substr(0, first.size() - unspecified.size())
                                           : std::string();
}

std::string words_of(const EnumDescriptor& type) {
  const std::string prefix = prefix_of(type);
  std::string words;
  for (int i = 1; i < type.value_count(); ++i) {
    const std::string& name = type.value(i)->name();
    if (!words.empty()) words += ", ";
    words += in_snake_case(std::string_view(name).substr(prefix.size()));
    for (const FunctionWord& word : function_words)
      if (word.value == name) words += " (" + std::string(word.function) + ")";
  }
  return words;
}

std::string values_of(const FieldDescriptor& field) {
  if (is_leads(field)) return "auto, none or blocks:IN,OUT";
  if (field.message_type()) return "x,y,z in mm";
  if (field.is_repeated()) return "names with commas between";
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "a number";
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      return "a whole number";
    case FieldDescriptor::CPPTYPE_ENUM:
      return words_of(*field.enum_type());
    default:
      return "text";
  }
}

template <class Number>
std::optional<Number> number_from(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return number;
}

std::optional<double> finite_from(std::string_view text) {
  const auto number = number_from<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<bool> switch_from(std::string_view text) {
  const std::string word = in_snake_case(text);
  if (word == "1" || word == "true" || word == "on") return true;
  if (word == "0" || word == "false" || word == "off") return false;
  return {};
}

std::optional<int> enum_from(const EnumDescriptor& type, std::string_view text) {
  const std::string word = in_snake_case(text);
  // This setting also accepts the words of a switch.
  if (&type == v1::Verification_descriptor())
    if (const auto on = switch_from(text))
      return *on ? v1::VERIFICATION_ENFORCE : v1::VERIFICATION_OFF;
  const std::string prefix = prefix_of(type);
  for (int i = 1; i < type.value_count(); ++i) {
    const std::string& name = type.value(i)->name();
    if (word == in_snake_case(name) ||
        word == in_snake_case(std::string_view(name).substr(prefix.size())))
      return type.value(i)->number();
    for (const FunctionWord& function : function_words)
      if (function.value == name && word == in_snake_case(function.function))
        return type.value(i)->number();
  }
  return {};
}

bool set_position(Message& position, std::string_view text) {
  const auto coordinates = split(text, ',');
  const auto* type = position.GetDescriptor();
  if (coordinates.size() > static_cast<std::size_t>(type->field_count())) return false;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const auto number = finite_from(coordinates[i]);
    if (!number) return false;
    position.GetReflection()->SetDouble(&position, type->field(static_cast<int>(i)), *number);
  }
  return true;
}

// "auto", "none", or the number of blocks at the start and at the end: "blocks:2,1".
bool set_leads(v1::Leads& leads, std::string_view text) {
  const auto parts = split(text, ':');
  const auto find = enum_from(*v1::Leads::Find_descriptor(), parts.front());
  const bool counts = find == v1::Leads::FIND_BLOCKS;
  if (!find || parts.size() != (counts ? 2U : 1U)) return false;
  leads.Clear();
  leads.set_find(static_cast<v1::Leads::Find>(*find));
  if (!counts) return true;
  const auto blocks = split(parts[1], ',');
  const auto blocks_in = number_from<std::uint32_t>(blocks.front());
  const auto blocks_out = number_from<std::uint32_t>(blocks.back());
  if (blocks.size() != 2 || !blocks_in || !blocks_out) return false;
  leads.set_blocks_in(*blocks_in);
  leads.set_blocks_out(*blocks_out);
  return true;
}

bool set_list(Message& owner, const FieldDescriptor& field, std::string_view text) {
  owner.GetReflection()->ClearField(&owner, &field);
  for (const std::string_view name : split(text, ','))
    owner.GetReflection()->AddString(&owner, &field, std::string(name));
  return true;
}

// False if the text is no value of the field.
bool set_field(Message& owner, const FieldDescriptor& field, std::string_view text) {
  const auto& reflection = *owner.GetReflection();
  if (is_leads(field))
    return set_leads(dynamic_cast<v1::Leads&>(*reflection.MutableMessage(&owner, &field)), text);
  if (field.message_type()) return set_position(*reflection.MutableMessage(&owner, &field), text);
  if (field.is_repeated()) return set_list(owner, field, text);
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      if (const auto value = switch_from(text))
        return reflection.SetBool(&owner, &field, *value), true;
      return false;
    case FieldDescriptor::CPPTYPE_DOUBLE:
      if (const auto value = finite_from(text))
        return reflection.SetDouble(&owner, &field, *value), true;
      return false;
    case FieldDescriptor::CPPTYPE_UINT32:
      if (const auto value = number_from<std::uint32_t>(text))
        return reflection.SetUInt32(&owner, &field, *value), true;
      return false;
    case FieldDescriptor::CPPTYPE_UINT64:
      if (const auto value = number_from<std::uint64_t>(text))
        return reflection.SetUInt64(&owner, &field, *value), true;
      return false;
    case FieldDescriptor::CPPTYPE_ENUM:
      if (const auto value = enum_from(*field.enum_type(), text))
        return reflection.SetEnumValue(&owner, &field, *value), true;
      return false;
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.SetString(&owner, &field, std::string(text)), true;
    default:
      return false;
  }
}

// In the form that set_field reads.
std::string value_of(const Message& owner, const FieldDescriptor& field) {
  const auto& reflection = *owner.GetReflection();
  std::string text;
  if (is_leads(field)) {
    const auto& leads = dynamic_cast<const v1::Leads&>(reflection.GetMessage(owner, &field));
    const auto& word = *v1::Leads::Find_descriptor()->FindValueByNumber(leads.find());
    text = in_snake_case(std::string_view(word.name()).substr(prefix_of(*word.type()).size()));
    if (leads.find() == v1::Leads::FIND_BLOCKS)
      text += ":" + std::to_string(leads.blocks_in()) + "," + std::to_string(leads.blocks_out());
    return text;
  }
  if (field.message_type()) {
    const Message& position = reflection.GetMessage(owner, &field);
    const auto* type = position.GetDescriptor();
    for (int i = 0; i < type->field_count(); ++i)
      text += (i > 0 ? "," : "") +
              shortest(position.GetReflection()->GetDouble(position, type->field(i)));
    return text;
  }
  if (field.is_repeated()) {
    for (int i = 0; i < reflection.FieldSize(owner, &field); ++i)
      text += (i > 0 ? "," : "") + reflection.GetRepeatedString(owner, &field, i);
    return text;
  }
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(owner, &field) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return shortest(reflection.GetDouble(owner, &field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(reflection.GetUInt32(owner, &field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(reflection.GetUInt64(owner, &field));
    case FieldDescriptor::CPPTYPE_ENUM: {
      const std::string& name = reflection.GetEnum(owner, &field)->name();
      return in_snake_case(std::string_view(name).substr(prefix_of(*field.enum_type()).size()));
    }
    default:
      return reflection.GetString(owner, &field);
  }
}

// Works as `split`, but does not split within quotes.
std::vector<std::string_view> split_outside_quotes(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    if (at < text.size() && text[at] == '"') quoted = !quoted;
    if (at < text.size() && (quoted || text[at] != separator)) continue;
    parts.push_back(text.substr(begin, at - begin));
    begin = at + 1;
  }
  return parts;
}

// Takes "A ""B""" from the front of a text; false: the name does not end, or is empty.
bool take_name(std::string_view& text, std::string& name) {
  if (!text.starts_with('"')) return true;
  for (std::size_t at = 1; at < text.size(); ++at) {
    const bool is_quote = text[at] == '"';
    if (is_quote && (at + 1 == text.size() || text[at + 1] != '"')) {
      text.remove_prefix(at + 1);
      return !name.empty();
    }
    name += text[at];
    if (is_quote) ++at;
  }
  return false;
}

// Reads the number of a tool, its name in quotes or both, and the edge of its radius: 7, "ROUGH
// 10", 7"ROUGH 10"/2.
bool set_call(std::string_view text, v1::Tool& tool) {
  const std::size_t number_end = std::min(text.find_first_of("\"/"), text.size());
  const std::string_view digits = text.substr(0, number_end);
  text.remove_prefix(number_end);
  if (!take_name(text, *tool.mutable_name())) return false;
  const auto number = number_from<std::uint32_t>(digits);
  const bool is_named_alone = digits.empty() && !tool.name().empty();
  if (!number && !is_named_alone) return false;
  tool.set_number(number.value_or(0));
  if (text.empty()) return true;
  const auto edge =
      text.starts_with('/') ? number_from<std::uint32_t>(text.substr(1)) : std::nullopt;
  if (edge) tool.set_edge(*edge);
  return edge.has_value();
}

std::string call_of(const v1::Tool& tool) {
  std::string call;
  if (tool.number() > 0 || tool.name().empty()) call += std::to_string(tool.number());
  if (!tool.name().empty()) {
    call += '"';
    for (const char c : tool.name()) call.append(c == '"' ? 2 : 1, c);
    call += '"';
  }
  if (tool.edge() > 0) call += "/" + std::to_string(tool.edge());
  return call;
}

std::string set_tools(std::string_view text, v1::ProgramSetup& setup) {
  for (const std::string_view entry : split_outside_quotes(text, ',')) {
    const auto parts = split_outside_quotes(entry, ':');
    v1::Tool tool;
    const bool complete = (parts.size() == 2 || parts.size() == 3) && set_call(parts[0], tool);
    const auto radius = complete ? finite_from(parts[1]) : std::nullopt;
    const auto wear = parts.size() == 3 ? finite_from(parts[2]) : std::optional<double>(0);
    if (!complete || !radius || !wear)
      return "tools: \"" + std::string(entry) +
             "\" is no D or T word with its radius in mm, as in 1:5, or with its wear too, as in "
             "1:5:-0.02" +
             (entry.find(':') == entry.npos ? "; commas separate tools, decimals have a point"
                                            : "");
    tool.set_radius(*radius);
    tool.set_wear(*wear);
    *setup.add_tools() = std::move(tool);
  }
  return {};
}

std::string set_variables(std::string_view text, v1::ProgramSetup& setup) {
  for (const std::string_view assignment : split(text, ','))
    if (std::string fault = apply_variable(assignment, setup); !fault.empty())
      return "variables: " + fault;
  return {};
}

// The setting with this key; otherwise all settings whose last part is this key.
std::vector<const Route*> routes_named(const std::string& key) {
  std::vector<const Route*> found;
  for (const Route& route : all_routes()) {
    if (key_of(route) == key) return {&route};
    if (route.back()->name() == key) found.push_back(&route);
  }
  return found;
}

std::string unknown_key(const std::string& given) {
  // Cut to the length of a key, because the cost of a comparison grows with the length.
  constexpr std::size_t longest = 64;
  const std::string_view key = std::string_view(given).substr(0, longest);
  std::vector<std::pair<std::size_t, std::string>> near;
  const auto consider = [&](const std::string& full) {
    const std::string last = full.substr(full.rfind('.') + 1);
    std::size_t distance = std::min(edit_distance(key, full), edit_distance(key, last));
    // "radus" is a misspelt part of tool_radius.
    for (std::size_t at = 0; at < last.size();) {
      const std::size_t end = std::min(last.find('_', at), last.size());
      distance = std::min(distance, edit_distance(key, last.substr(at, end - at)) + 1);
      at = end + 1;
    }
    near.emplace_back(distance, full);
  };
  for (const Route& route : all_routes()) consider(key_of(route));
  for (const FieldDescriptor* field : program_fields()) consider(field->name());
  consider("tools");
  consider("variables");
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text = "unknown setting \"" + given + "\"; nearest:";
  for (std::size_t i = 0; i < 3; ++i) text += (i == 0 ? " " : ", ") + near[i].second;
  return text;
}

}  // namespace

std::string whole_key(std::string_view key) {
  const std::string name = in_snake_case(trimmed(key));
  const std::vector<const Route*> found = routes_named(name);
  return found.size() == 1 ? key_of(*found.front()) : name;
}

std::string GivenSettings::take(std::string_view key) {
  std::string whole = whole_key(key);
  const auto is_part = [](std::string_view part, std::string_view of) {
    return part == of || (part.starts_with(of) && part.substr(of.size()).starts_with('.'));
  };
  const bool is_repeated = std::ranges::any_of(keys_, [&](const std::string& other) {
    return is_part(whole, other) || is_part(other, whole);
  });
  keys_.push_back(whole);
  return is_repeated ? whole + ": is given more than once" : std::string();
}

std::string apply_setting(std::string_view assignment, v1::ProgramSetup& setup) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos)
    return "\"" + std::string(assignment) + "\" is no setting; write key=value";
  const std::string key = in_snake_case(trimmed(assignment.substr(0, equals)));
  const std::string_view value = trimmed(assignment.substr(equals + 1));
  if (key == "tools") return set_tools(value, setup);
  if (key == "variables") return set_variables(value, setup);
  const auto impossible = [&](const std::string& whole, const FieldDescriptor& field) {
    std::string text = whole + ": \"" + std::string(value) + "\" is not possible; it takes ";
    text += values_of(field);
    std::string number(value);
    std::ranges::replace(number, ',', '.');
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && number != value &&
        finite_from(number))
      text += "; write " + number + ", with a decimal point";
    return text;
  };
  for (const FieldDescriptor* field : program_fields())
    if (field->name() == key)
      return set_field(setup, *field, value) ? std::string() : impossible(key, *field);

  const std::vector<const Route*> found = routes_named(key);
  if (found.empty()) return unknown_key(key);
  if (found.size() > 1)
    return "\"" + key + "\" may be " + key_of(*found[0]) + " or " + key_of(*found[1]) +
           "; write the whole key";
  const Route& route = *found.front();

  Message* owner = setup.mutable_path();
  for (std::size_t i = 0; i + 1 < route.size(); ++i)
    owner = owner->GetReflection()->MutableMessage(owner, route[i]);
  const FieldDescriptor& field = *route.back();
  if (set_field(*owner, field, value)) return {};
  return impossible(key_of(route), field);
}

std::string apply_variable(std::string_view assignment, v1::ProgramSetup& setup) {
  const auto equals = assignment.rfind('=');
  const std::string_view name =
      trimmed(assignment.substr(0, equals == std::string_view::npos ? 0 : equals));
  if (name.empty()) return "\"" + std::string(assignment) + "\" is no value; write NAME=VALUE";
  const std::string_view text = trimmed(assignment.substr(equals + 1));
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::string(name) + ": \"" + std::string(text) + "\" is not possible; it takes a number";
  const bool is_new = setup.mutable_variables()->insert({std::string(name), value}).second;
  return is_new ? std::string() : std::string(name) + ": is given more than once";
}

std::vector<std::string> assignments_of(const v1::ProgramSetup& setup) {
  std::vector<std::string> found;
  for (const Route& route : all_routes()) {
    const Message* owner = &setup.path();
    bool is_part = false;
    for (std::size_t i = 0; i + 1 < route.size(); ++i) {
      is_part = is_part || is_set_as_a_whole(*route[i]);
      owner = &owner->GetReflection()->GetMessage(*owner, route[i]);
    }
    const FieldDescriptor& field = *route.back();
    if (is_set_in(*owner, field) && !is_part)
      found.push_back(key_of(route) + "=" + value_of(*owner, field));
  }
  for (const FieldDescriptor* field : program_fields())
    if (is_set_in(setup, *field)) found.push_back(field->name() + "=" + value_of(setup, *field));
  std::string tools;
  for (const v1::Tool& tool : setup.tools()) {
    tools += (tools.empty() ? "" : ",") + call_of(tool) + ":" + shortest(tool.radius());
    if (tool.wear() != 0) tools += ":" + shortest(tool.wear());
  }
  if (!tools.empty()) found.push_back("tools=" + tools);
  std::string variables;
  for (const auto& [name, value] :
       std::map<std::string, double>(setup.variables().begin(), setup.variables().end()))
    variables += (variables.empty() ? "" : ",") + name + "=" + shortest(value);
  if (!variables.empty()) found.push_back("variables=" + variables);
  return found;
}

std::vector<SettingRow> settings() {
  std::vector<SettingRow> rows;
  for (const Route& route : all_routes()) rows.push_back({key_of(route), values_of(*route.back())});
  for (const FieldDescriptor* field : program_fields())
    rows.push_back({field->name(), values_of(*field)});
  rows.push_back(
      {"tools",
       "the tool table, number of the D or T word:radius in mm, as in 1:5,2:3.5, or with the wear "
       "too, as in 1:5:-0.02; a name stands in quotes, an edge after a slash, as in "
       "7\"ROUGH\"/2:5"});
  rows.push_back({"variables", "names with their values, as in #500=12.5,#501=3"});
  return rows;
}

}  // namespace trc::wire
