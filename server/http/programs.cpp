#include <algorithm>
#include <memory>
#include <utility>

#include "server/http/api.h"
#include "server/http/formats.h"
#include "server/http/handlers.h"
#include "server/http/program_questions.h"
#include "server/http/settings.h"

namespace trc::server::http {
namespace {

constexpr const char* compensate_program_rpc = "/trc.v1.TrcService/CompensateProgram";

// NC text, whatever it is called; but not what a form sends.
bool is_text(std::string_view type) {
  return type.empty() || type.starts_with("text/") || type == "application/octet-stream";
}

// The setup of a request; what is wrong with the request is answered.
bool read_setup(Exchange& exchange, v1::ProgramSetup& setup) {
  if (!is_text(exchange.request().content_type())) {
    answer_problem(exchange, problem(415, "CONTENT_TYPE", "The body must be NC text",
                                     "send it as text/plain; charset=utf-8"));
    return false;
  }
  const auto refused = read_settings(exchange.request().query, setup);
  if (refused) answer_problem(exchange, *refused);
  return !refused;
}

void start(Api& api, const ExchangePointer& exchange, const v1::ProgramSetup& setup,
           std::shared_ptr<Format> format) {
  Run::start(api, exchange, compensate_program_rpc,
             std::make_unique<ProgramQuestions>(setup, std::move(exchange->request().body),
                                                api.most_message_bytes()),
             std::move(format));
}

}  // namespace

void compensate_program(Api& api, const ExchangePointer& exchange) {
  v1::ProgramSetup setup;
  if (!read_setup(*exchange, setup)) return;
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
  if (!read_setup(*exchange, setup)) return;
  setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
  setup.mutable_path()->set_response_layout(v1::RESPONSE_LAYOUT_COLUMNS);
  setup.mutable_path()->set_verify(v1::VERIFICATION_ENFORCE);
  start(api, exchange, setup,
        std::make_shared<Measured>(Measured::Blocks::left_out, api.most_message_bytes()));
}

}  // namespace trc::server::http
