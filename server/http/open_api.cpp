#include <google/protobuf/descriptor.h>
#include <google/protobuf/struct.pb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ascii.h"
#include "core/base/version.h"
#include "proto/wire/json.h"
#include "proto/wire/setting_meanings.h"
#include "proto/wire/settings.h"
#include "server/http/api.h"
#include "server/http/handlers.h"
#include "server/http/settings.h"
#include "trc/v1/http.pb.h"
#include "trc/v1/job_record.pb.h"
#include "trc/v1/path_item.pb.h"
#include "trc/v1/trc_service.pb.h"

// The OpenAPI document is generated from the routes, the settings and the messages.
namespace trc::server::http {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Struct;

Struct& object(Struct& owner, const std::string& name) {
  return *(*owner.mutable_fields())[name].mutable_struct_value();
}
void text(Struct& owner, const std::string& name, std::string_view value) {
  (*owner.mutable_fields())[name].set_string_value(std::string(value));
}
Struct& item(Struct& owner, const std::string& name) {
  return *(*owner.mutable_fields())[name]
              .mutable_list_value()
              ->add_values()
              ->mutable_struct_value();
}

constexpr std::string_view schemas = "#/components/schemas/";

class Schemas {
 public:
  explicit Schemas(Struct& components) : all_(object(components, "schemas")) {}

  // Refers to a message; each message is described once.
  void refer(const Descriptor& type, Struct& schema) {
    text(schema, "$ref", std::string(schemas) + type.name());
    if (!known_.insert(&type).second) return;
    Struct& described = object(all_, type.name());
    text(described, "type", "object");
    Struct& properties = object(described, "properties");
    for (int i = 0; i < type.field_count(); ++i)
      add(*type.field(i), object(properties, type.field(i)->json_name()));
  }

 private:
  void add(const FieldDescriptor& field, Struct& schema) {
    if (field.is_map()) {
      text(schema, "type", "object");
      return value(*field.message_type()->map_value(), object(schema, "additionalProperties"));
    }
    if (!field.is_repeated()) return value(field, schema);
    text(schema, "type", "array");
    value(field, object(schema, "items"));
  }

  void value(const FieldDescriptor& field, Struct& schema) {
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return refer(*field.message_type(), schema);
      case FieldDescriptor::CPPTYPE_ENUM:
        text(schema, "type", "string");
        for (int i = 0; i < field.enum_type()->value_count(); ++i)
          (*schema.mutable_fields())["enum"].mutable_list_value()->add_values()->set_string_value(
              field.enum_type()->value(i)->name());
        return;
      case FieldDescriptor::CPPTYPE_BOOL:
        return text(schema, "type", "boolean");
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return text(schema, "type", "number");
      case FieldDescriptor::CPPTYPE_INT32:
      case FieldDescriptor::CPPTYPE_UINT32:
        return text(schema, "type", "integer");
      case FieldDescriptor::CPPTYPE_INT64:
      case FieldDescriptor::CPPTYPE_UINT64:
        // JSON has no 64-bit integers.
        text(schema, "type", "string");
        return text(schema, "format", "int64");
      default:
        text(schema, "type", "string");
        if (field.type() == FieldDescriptor::TYPE_BYTES) text(schema, "format", "byte");
    }
  }

  Struct& all_;
  std::set<const Descriptor*> known_;
};

void add_parameter(Struct& operation, std::string_view name, std::string_view place,
                   std::string_view meaning) {
  Struct& parameter = item(operation, "parameters");
  text(parameter, "name", name);
  text(parameter, "in", place);
  text(parameter, "description", meaning);
  if (place == "path") (*parameter.mutable_fields())["required"].set_bool_value(true);
  text(object(parameter, "schema"), "type", "string");
}

void add_parameters_in_path(std::string_view path, Struct& operation) {
  for (;;) {
    const std::size_t begin = path.find('{');
    if (begin == std::string_view::npos) return;
    const std::size_t end = path.find('}', begin);
    add_parameter(operation, path.substr(begin + 1, end - begin - 1), "path", "");
    path.remove_prefix(end + 1);
  }
}

void number(Struct& owner, const std::string& name, double value) {
  if (std::isfinite(value)) (*owner.mutable_fields())[name].set_number_value(value);
}

// "direct (G138), indirect (G139)": the words alone. Empty: the setting is no choice of words.
std::vector<std::string> words_in(std::string_view values) {
  std::vector<std::string> words;
  while (!values.empty()) {
    const std::string_view one = values.substr(0, values.find(", "));
    values.remove_prefix(std::min(values.size(), one.size() + 2));
    const std::string_view word = one.substr(0, one.find(" ("));
    if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789") != std::string_view::npos)
      return {};
    words.emplace_back(word);
  }
  return words.size() > 1 ? words : std::vector<std::string>();
}

void add_kind(const wire::SettingMeaning& meaning, std::string_view values, Struct& schema) {
  const std::string initial(meaning.initial);
  google::protobuf::Value fallback;
  if (values == "true or false") {
    text(schema, "type", "boolean");
    fallback.set_bool_value(initial == "true");
  } else if (values == "a number" || values == "a whole number") {
    text(schema, "type", values == "a number" ? "number" : "integer");
    number(schema, "minimum", meaning.least);
    number(schema, "maximum", meaning.most);
    if (!initial.empty()) fallback.set_number_value(std::stod(initial));
  } else {
    text(schema, "type", "string");
    for (const std::string& word : words_in(values))
      (*schema.mutable_fields())["enum"].mutable_list_value()->add_values()->set_string_value(word);
    if (!initial.empty()) fallback.set_string_value(initial);
  }
  if (!initial.empty()) (*schema.mutable_fields())["default"] = fallback;
}

// The page builds its form from these values: `x-values` in words, `x-meaning`, `x-unit`.
void add_setting(Struct& operation, const wire::SettingMeaning& meaning, std::string_view values) {
  Struct& parameter = item(operation, "parameters");
  text(parameter, "name", meaning.key);
  text(parameter, "in", "query");
  text(parameter, "description",
       std::string(meaning.meaning) + (meaning.meaning.empty() ? "" : ": ") + std::string(values));
  text(parameter, "x-meaning", meaning.meaning);
  text(parameter, "x-values", values);
  if (!meaning.unit.empty()) text(parameter, "x-unit", meaning.unit);
  add_kind(meaning, values, object(parameter, "schema"));
}

// How the path is measured if `verify` is not given.
std::string_view measured_by(const Route& route) {
  if (route.handle == make_view || route.handle == record_program) return "report";
  return route.handle == verify_program ? "enforce" : "off";
}

void add_settings(const Route& route, Struct& operation) {
  for (const wire::SettingRow& row : wire::settings()) {
    wire::SettingMeaning meaning = wire::meaning_of(row.key);
    meaning.key = row.key;
    const bool is_verify = row.key == "verify";
    if (is_verify) meaning.initial = measured_by(route);
    const bool must_measure = is_verify && route.handle == verify_program;
    add_setting(operation, meaning,
                must_measure ? "enforce, report" : std::string_view(row.values));
  }
  add_setting(operation,
              {.key = "dialect", .meaning = "the control the program is for", .initial = "isg"},
              dialects());
  add_setting(operation,
              {.key = "unit",
               .meaning = "what the program counts in where it does not say so itself",
               .initial = "mm"},
              "mm, inch");
  add_setting(operation,
              {.key = "unknown_words",
               .meaning = "words nobody knows: refuse stops there, copy leaves them in the program",
               .initial = "refuse"},
              "refuse, copy");
  add_setting(operation,
              {.key = "whole_numbers",
               .meaning = "coordinates of fanuc without a decimal point: X10 is 10 mm in units, "
                          "0.010 mm in increments"},
              "units, increments");
  add_setting(
      operation,
      {.key = "decimals",
       .meaning = "decimal places of coordinates; not given: 4, or those of the program where it "
                  "has more",
       .least = 1,
       .most = 8},
      "a whole number");
  add_setting(operation, {.key = "name", .meaning = "name of the program in diagnostics"}, "text");
}

void add_body(const Route& route, Struct& operation, Schemas& known) {
  if (route.body == Body::none) return;
  Struct& content = object(object(operation, "requestBody"), "content");
  if (route.body == Body::program)
    return text(object(object(content, "text/plain"), "schema"), "type", "string");
  const bool is_survey = route.handle == survey_path;
  known.refer(
      is_survey ? *v1::SurveyPathRequest::descriptor() : *v1::PreviewPathRequest::descriptor(),
      object(object(content, "application/json"), "schema"));
}

// The name of a route in generated clients, and the message it answers with.
struct Operation {
  void (*handle)(Api& api, const ExchangePointer& exchange);
  std::string_view id;
  const Descriptor* (*answer)() = nullptr;  // as application/json
  std::string_view status = "200";
};

constexpr auto operations = std::to_array<Operation>({
    {compensate_program, "compensateProgram"},
    {verify_program, "verifyProgram", v1::PathAnswer::descriptor},
    {record_program, "recordProgram", v1::JobRecord::descriptor},
    {survey_program, "surveyRadiiOfProgram", v1::SurveyAnswer::descriptor},
    {compensate_path, "compensatePath", v1::PathAnswer::descriptor},
    {verify_path, "verifyPath", v1::PathAnswer::descriptor},
    {survey_path, "surveyRadiiOfPath", v1::SurveyAnswer::descriptor},
    {make_view, "makeView", v1::View::descriptor, "201"},
    {view_said, "getView", v1::View::descriptor},
    {remove_view, "removeView", nullptr, "204"},
    {view_tile, "getTile"},
    {view_lines, "getLines", v1::ViewLines::descriptor},
    {view_output, "getOutput", v1::ViewLines::descriptor},
    {view_blocks, "getBlocks", v1::ViewBlocks::descriptor},
    {view_place, "getPlace", v1::ViewPlace::descriptor},
    {offered_program, "getOfferedProgram"},
    {page_start, "getPage"},
    {page_file, "getPageFile"},
    {server_info, "getInfo", v1::GetServerInfoResponse::descriptor},
    {open_api, "getOpenApi"},
});

const Operation& operation_of(const Route& route) {
  return *std::ranges::find(operations, route.handle, &Operation::handle);
}

void add_header(Struct& answer, const std::string& name, std::string_view meaning) {
  Struct& header = object(object(answer, "headers"), name);
  text(header, "description", meaning);
  text(object(header, "schema"), "type", "string");
}

// For answers that may begin before their end is known.
void add_stream(Struct& answer) {
  text(answer, "description",
       "The answer; above 1 MiB it begins before its end is known, and is whole only where the "
       "body ends with its last chunk and Trc-Status is OK");
  add_header(answer, "Trc-Status",
             "OK: the answer is whole. A header up to 1 MiB, a trailer above it");
  add_header(
      answer, "Trc-Warnings",
      "Of NC text: how many warnings there are; they are in the JSON lines. Where Trc-Status "
      "is");
  add_header(answer, "Trc-First-Warning",
             "Of NC text: the code of the first warning and its line, as in 900216; line=7");
}

void add_answers(const Route& route, Struct& operation, Schemas& known) {
  const Operation& said = operation_of(route);
  Struct& answers = object(operation, "responses");
  Struct& good = object(answers, std::string(said.status));
  text(good, "description", "Done: the answer is whole");
  if (route.handle == compensate_program || route.handle == compensate_path) add_stream(good);
  std::string_view types = route.answers;
  while (!types.empty()) {
    const std::string_view type = types.substr(0, types.find(','));
    types.remove_prefix(std::min(types.size(), type.size() + 1));
    Struct& content = object(object(good, "content"), std::string(type));
    if (type == "application/json" && said.answer != nullptr)
      known.refer(*said.answer(), object(content, "schema"));
    if (type == "application/x-ndjson")
      known.refer(*v1::PathItem::descriptor(), object(content, "schema"));
  }
  Struct& bad = object(answers, "default");
  text(bad, "description", "Why there is no answer (RFC 9457)");
  add_header(bad, "Retry-After", "Of 503: in so many seconds it may be tried again");
  known.refer(*v1::Problem::descriptor(),
              object(object(object(bad, "content"), "application/problem+json"), "schema"));
}

void add_routes(Struct& paths, Schemas& known) {
  for (const Route& route : routes()) {
    Struct& operation = object(object(paths, std::string(route.path)), in_lower_case(route.method));
    text(operation, "operationId", operation_of(route).id);
    text(operation, "summary", route.meaning);
    add_parameters_in_path(route.path, operation);
    if (route.takes_settings) add_settings(route, operation);
    for (const Question& question : route.questions)
      add_parameter(operation, question.name, "query", question.meaning);
    add_body(route, operation, known);
    add_answers(route, operation, known);
  }
}

// {"code":"invalid_argument","message":"…","details":[{"type":"…","value":"…"}]}
void add_connect_error(Struct& components) {
  Struct& error = object(object(components, "schemas"), "ConnectError");
  text(error, "type", "object");
  Struct& properties = object(error, "properties");
  for (const char* name : {"code", "message"}) text(object(properties, name), "type", "string");
  text(object(properties, "details"), "type", "array");
  Struct& detail = object(object(properties, "details"), "items");
  text(detail, "type", "object");
  for (const char* name : {"type", "value"})
    text(object(object(detail, "properties"), name), "type", "string");
  text(object(object(detail, "properties"), "value"), "description",
       "the message in base64 without padding; google.rpc.ErrorInfo has the reason");
}

// The RPCs over the Connect protocol.
void add_rpcs(Struct& paths, Schemas& known) {
  const auto* service = v1::GetServerInfoResponse::descriptor()->file()->pool()->FindServiceByName(
      "trc.v1.TrcService");
  for (int i = 0; service != nullptr && i < service->method_count(); ++i) {
    const auto& method = *service->method(i);
    if (method.client_streaming()) continue;
    const std::string type =
        method.server_streaming() ? "application/connect+json" : "application/json";
    Struct& operation =
        object(object(paths, "/" + service->full_name() + "/" + method.name()), "post");
    text(operation, "operationId", "rpc" + method.name());
    text(operation, "summary", "The RPC " + method.name() + " with the Connect protocol");
    known.refer(
        *method.input_type(),
        object(object(object(object(operation, "requestBody"), "content"), type), "schema"));
    Struct& good = object(object(operation, "responses"), "200");
    text(good, "description",
         method.server_streaming()
             ? "Envelopes of Connect; the last one says whether the stream is whole, or its error"
             : "The answer");
    known.refer(*method.output_type(), object(object(object(good, "content"), type), "schema"));
    if (method.server_streaming()) continue;
    Struct& bad = object(object(operation, "responses"), "default");
    text(bad, "description", "Why there is no answer, as Connect has it");
    text(object(object(object(bad, "content"), "application/json"), "schema"), "$ref",
         std::string(schemas) + "ConnectError");
  }
}

std::string document() {
  Struct root;
  text(root, "openapi", "3.0.3");
  Struct& info = object(root, "info");
  text(info, "title", "trc: CNC tool radius compensation");
  text(info, "version", version());
  Struct& components = object(root, "components");
  Schemas known(components);
  Struct& paths = object(root, "paths");
  add_connect_error(components);
  add_routes(paths, known);
  add_rpcs(paths, known);
  return wire::json_of(root) + "\n";
}

}  // namespace

void open_api(Api& /*api*/, const ExchangePointer& exchange) {
  static const std::string made = document();
  exchange->answer({.content_type = "application/json"}, made);
}

}  // namespace trc::server::http
