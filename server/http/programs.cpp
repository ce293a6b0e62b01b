#include <algorithm>
#include <memory>
#include <utility>

#include "proto/wire/survey.h"
#include "server/http/api.h"
#include "server/http/formats.h"
#include "server/http/handlers.h"
#include "server/http/program_questions.h"
#include "server/http/settings.h"
#include "server/text.h"

namespace trc::server::http {
namespace {

constexpr const char* compensate_program_rpc = "/trc.v1.TrcService/CompensateProgram";
constexpr const char* survey_radii_rpc = "/trc.v1.TrcService/SurveyRadii";

// Reads the setup of a request; false: it has a fault, which has been answered.
bool read_setup(Exchange& exchange, const Pairs& query, v1::ProgramSetup& setup) {
  const auto refused = read_settings(query, exchange.request().header("accept-language"), setup);
  if (refused) answer_problem(exchange, *refused);
  return !refused;
}

bool read_flag(const std::string& name, const std::string& value, bool& flag, std::string& fault) {
  flag = value == "1" || value == "true";
  if (!flag && value != "0" && value != "false") fault = name + ": it takes true, false";
  return fault.empty();
}

// Takes the parameters that only a survey has; returns the remaining settings.
Pairs take_questions(const Pairs& query, v1::SurveySetup& setup, std::string& fault) {
  Pairs left;
  for (const auto& [name, value] : query) {
    bool flag = false;
    if (name == "radii") {
      const std::string wrong = wire::read_radii(value, setup);
      if (!wrong.empty() && fault.empty()) fault = "radii: " + wrong;
    } else if (name == "uncut") {
      if (read_flag(name, value, flag, fault)) setup.set_want_uncut(flag);
    } else if (name == "largest") {
      if (read_flag(name, value, flag, fault)) setup.set_without_largest(!flag);
    } else {
      left.emplace_back(name, value);
    }
  }
  return left;
}

void start(Api& api, const ExchangePointer& exchange, const v1::ProgramSetup& setup,
           std::shared_ptr<Format> format) {
  RpcExchange::start(api, exchange, compensate_program_rpc,
                     std::make_unique<ProgramQuestions>(setup, exchange->request().take_body(),
                                                        api.most_message_bytes()),
                     std::move(format));
}

}  // namespace

void compensate_program(Api& api, const ExchangePointer& exchange) {
  v1::ProgramSetup setup;
  if (!read_setup(*exchange, exchange->request().query, setup)) return;
  if (exchange->request().accepts("application/x-ndjson")) {
    setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
    setup.mutable_path()->set_response_layout(v1::RESPONSE_LAYOUT_BLOCKS);
    return start(api, exchange, setup,
                 std::make_shared<JsonLinesFormat<v1::CompensateProgramResponse>>());
  }
  setup.set_output(v1::PROGRAM_OUTPUT_NC);
  start(api, exchange, setup, std::make_shared<NcTextFormat>());
}

void verify_program(Api& api, const ExchangePointer& exchange) {
  using Measured = PathAnswerFormat<v1::CompensateProgramResponse>;
  v1::ProgramSetup setup;
  setup.mutable_path()->set_verify(v1::VERIFICATION_ENFORCE);
  if (!read_setup(*exchange, exchange->request().query, setup)) return;
  if (setup.path().verify() == v1::VERIFICATION_OFF)
    return answer_problem(*exchange, problem(400, "SETTING_INVALID",
                                             "A query parameter is no setting that can be taken",
                                             "verify: it takes enforce, report"));
  setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
  setup.mutable_path()->set_response_layout(v1::RESPONSE_LAYOUT_COLUMNS);
  start(api, exchange, setup,
        std::make_shared<Measured>(Measured::Blocks::left_out, api.most_message_bytes()));
}

void record_program(Api& api, const ExchangePointer& exchange) {
  v1::ProgramSetup setup;
  setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT);
  if (!read_setup(*exchange, exchange->request().query, setup)) return;
  setup.set_output(v1::PROGRAM_OUTPUT_NC);
  setup.set_record(true);
  start(api, exchange, setup, std::make_shared<RecordFormat>());
}

void survey_program(Api& api, const ExchangePointer& exchange) {
  v1::SurveySetup setup;
  std::string fault;
  const Pairs settings = take_questions(exchange->request().query, setup, fault);
  if (!fault.empty())
    return answer_problem(*exchange, problem(400, "SETTING_INVALID",
                                             "A query parameter is no setting that can be taken",
                                             presentable(fault)));
  if (!read_setup(*exchange, settings, *setup.mutable_program())) return;
  constexpr std::size_t messages = 4;
  RpcExchange::start(api, exchange, survey_radii_rpc,
                     std::make_unique<SurveyQuestions>(setup, exchange->request().take_body(),
                                                       api.most_message_bytes()),
                     std::make_shared<SurveyFormat>(messages * api.most_message_bytes()));
}

}  // namespace trc::server::http
