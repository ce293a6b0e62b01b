#include "server/http/settings.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/base/language.h"
#include "core/base/utf8.h"
#include "core/nc/dialect/dialect.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"
#include "server/http/problem.h"
#include "server/text.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server::http {
namespace {

std::string read_one(const std::string& name, const std::string& value, v1::ProgramSetup& setup) {
  if (name == "name") {
    setup.set_file_name(presentable(value));
    return {};
  }
  if (!is_utf8(value)) return name + ": is no UTF-8";
  if (name == "dialect") {
    const auto dialect = dialect_spelled(value);
    if (!dialect) return "dialect: \"" + value + "\" is not possible; it takes " + dialects();
    setup.set_dialect(wire::to_proto(*dialect));
    return {};
  }
  if (name == "unit") {
    if (value != "mm" && value != "inch") return "unit: it takes mm, inch";
    setup.set_unit(value == "inch" ? v1::LENGTH_UNIT_INCH : v1::LENGTH_UNIT_MM);
    return {};
  }
  if (name == "unknown_words") {
    if (value != "refuse" && value != "copy") return "unknown_words: it takes refuse, copy";
    setup.set_unknown_words(value == "copy" ? v1::UNKNOWN_WORDS_COPY
                                            : v1::UNKNOWN_WORDS_UNSPECIFIED);
    return {};
  }
  if (name == "whole_numbers") {
    if (value != "units" && value != "increments")
      return "whole_numbers: it takes units, increments";
    setup.set_whole_numbers(value == "units" ? v1::WHOLE_NUMBERS_UNITS
                                             : v1::WHOLE_NUMBERS_INCREMENTS);
    return {};
  }
  if (name != "decimals") return wire::apply_setting(name + "=" + value, setup);
  std::uint32_t decimals = 0;
  const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), decimals);
  if (fault != std::errc() || end != value.data() + value.size())
    return "decimals: \"" + value + "\" is not possible; it takes a whole number";
  setup.set_decimals(decimals);
  return {};
}

// Null: the message has no place for one, or is a survey with a program, which is refused
// elsewhere.
v1::PathSetup* path_setup_of(google::protobuf::Message& message) {
  if (auto* path = dynamic_cast<v1::PreviewPathRequest*>(&message)) return path->mutable_setup();
  if (auto* program = dynamic_cast<v1::CompensateProgramOnceRequest*>(&message))
    return program->mutable_setup()->mutable_path();
  auto* survey = dynamic_cast<v1::SurveyPathRequest*>(&message);
  if (survey == nullptr || survey->setup().has_program()) return nullptr;
  return survey->mutable_setup()->mutable_path();
}

}  // namespace

std::string dialects() {
  std::string words;
  for (const Dialect& dialect : all_dialects()) {
    if (!words.empty()) words += ", ";
    words += dialect.spelling;
  }
  return words;
}

std::optional<v1::Problem> read_settings(const Pairs& query, std::string_view accept_language,
                                         v1::ProgramSetup& setup) {
  v1::Problem refused =
      problem(400, "SETTING_INVALID", "A query parameter is no setting that can be taken", {});
  wire::GivenSettings given;
  for (const auto& [name, value] : query) {
    if (refused.fields_size() == most_fields) break;
    std::string fault = given.take(name);
    if (fault.empty()) fault = read_one(name, value, setup);
    if (fault.empty()) continue;
    v1::FieldProblem& field = *refused.add_fields();
    field.set_field(presentable(name));
    field.set_description(presentable(fault));
  }
  if (refused.fields().empty()) {
    if (setup.path().language().empty() && accepted_language(accept_language) == Language::german)
      setup.mutable_path()->set_language("de");
    return std::nullopt;
  }
  refused.set_detail(refused.fields(0).description());
  return refused;
}

void prefer_language(std::string_view accept_language, google::protobuf::Message& message) {
  if (accepted_language(accept_language) != Language::german) return;
  v1::PathSetup* setup = path_setup_of(message);
  if (setup != nullptr && setup->language().empty()) setup->set_language("de");
}

}  // namespace trc::server::http
