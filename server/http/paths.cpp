#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "proto/wire/json.h"
#include "server/http/api.h"
#include "server/http/formats.h"
#include "server/http/handlers.h"
#include "server/http/json_size.h"
#include "server/http/problem.h"
#include "server/http/settings.h"
#include "server/rpc/get_server_info.h"

namespace trc::server::http {
namespace {

constexpr const char* preview_path_rpc = "/trc.v1.TrcService/PreviewPath";
constexpr const char* survey_radii_rpc = "/trc.v1.TrcService/SurveyRadii";
// The largest answer, in messages.
constexpr std::size_t most_messages = 4;

// Commands count as blocks: a fault in a path of commands alone is reported like that of a program.
template <class Message>
bool has_blocks(const Message& path) {
  return path.has_columns() ? !path.columns().kinds().empty() : !path.batch().blocks().empty();
}

// The messages for the RPC, or the setting that is refused.
struct Asked {
  std::vector<grpc::ByteBuffer> messages{};
  std::string refused{};
};

// Has a worker read the body, turns it into messages with `ask`, and calls the RPC.
template <class Message, class Ask>
void start(Api& api, const ExchangePointer& exchange, const char* rpc, Ask ask,
           std::shared_ptr<Format> format) {
  const std::string name = Message::descriptor()->name();
  if (!is_json(exchange->request().content_type()))
    return answer_problem(*exchange, problem(415, "CONTENT_TYPE", "The body must be JSON",
                                             "send a " + name + " as application/json"));
  api.compute([&api, exchange, rpc, name, ask, format = std::move(format)] {
    if (const auto refused = refuse_size(exchange->request().body, api.backend().config))
      return exchange->post(
          [exchange, status = refused->status] { answer_problem(*exchange, problem_of(status)); });
    Message message;
    const std::string fault = wire::Json().read(exchange->request().body, message);
    prefer_language(exchange->request().header("accept-language"), message);
    const bool is_path = has_blocks(message);
    exchange->post([&api, exchange, rpc, name, fault, is_path, asked = ask(message), format] {
      exchange->request().body = {};
      if (!fault.empty())
        return answer_problem(*exchange,
                              problem(400, "JSON_INVALID", "The body is no " + name, fault));
      if (!is_path)
        return answer_problem(*exchange, problem(400, "PATH_EMPTY", "The path has no block",
                                                 "give its blocks in batch.blocks or in columns"));
      if (!asked.refused.empty())
        return answer_problem(
            *exchange, problem(400, "SETTING_INVALID",
                               "The setup holds a setting that cannot be taken", asked.refused));
      for (const grpc::ByteBuffer& bytes : asked.messages)
        if (bytes.Length() > api.most_message_bytes())
          return answer_problem(
              *exchange, problem(413, "MESSAGE_TOO_LARGE", "The path is too large",
                                 "it takes " + std::to_string(bytes.Length()) + " bytes, at most " +
                                     std::to_string(api.most_message_bytes()) +
                                     " are taken (max-message-bytes); divide the path, send it as "
                                     "an NC program, or stream it with gRPC"));
      RpcExchange::start(api, exchange, rpc, std::make_unique<PreparedQuestions>(asked.messages),
                         format);
    });
  });
}

void compensate(Api& api, const ExchangePointer& exchange, bool verify,
                std::shared_ptr<Format> format) {
  const auto ask = [verify](v1::PreviewPathRequest& path) -> Asked {
    v1::PathSetup& setup = *path.mutable_setup();
    if (verify && setup.verify() == v1::VERIFICATION_OFF)
      return {.refused = "setup.verify: it takes VERIFICATION_ENFORCE, VERIFICATION_REPORT"};
    setup.set_response_layout(v1::RESPONSE_LAYOUT_BLOCKS);
    if (verify && setup.verify() == v1::VERIFICATION_UNSPECIFIED)
      setup.set_verify(v1::VERIFICATION_ENFORCE);
    return {.messages = {RpcCall::bytes_of(path)}};
  };
  start<v1::PreviewPathRequest>(api, exchange, preview_path_rpc, ask, std::move(format));
}

// The setup, then the path as the last batch.
Asked survey_messages(v1::SurveyPathRequest& path) {
  v1::SurveyRadiiRequest setup;
  setup.mutable_setup()->Swap(path.mutable_setup());
  if (!setup.setup().has_program()) setup.mutable_setup()->mutable_path();
  v1::SurveyRadiiRequest blocks;
  if (path.has_columns()) {
    blocks.mutable_columns()->Swap(path.mutable_columns());
    blocks.mutable_columns()->set_final(true);
  } else {
    blocks.mutable_batch()->Swap(path.mutable_batch());
    blocks.mutable_batch()->set_final(true);
  }
  return {.messages = {RpcCall::bytes_of(setup), RpcCall::bytes_of(blocks)}};
}

}  // namespace

using PathFormat = PathAnswerFormat<v1::PreviewPathResponse>;

void compensate_path(Api& api, const ExchangePointer& exchange) {
  if (exchange->request().accepts("application/x-ndjson"))
    return compensate(api, exchange, false,
                      std::make_shared<JsonLinesFormat<v1::PreviewPathResponse>>());
  compensate(api, exchange, false,
             std::make_shared<PathFormat>(PathFormat::Blocks::given,
                                          most_messages * api.most_message_bytes()));
}

void verify_path(Api& api, const ExchangePointer& exchange) {
  compensate(api, exchange, true,
             std::make_shared<PathFormat>(PathFormat::Blocks::left_out, api.most_message_bytes()));
}

void survey_path(Api& api, const ExchangePointer& exchange) {
  start<v1::SurveyPathRequest>(
      api, exchange, survey_radii_rpc, survey_messages,
      std::make_shared<SurveyFormat>(most_messages * api.most_message_bytes()));
}

void server_info(Api& api, const ExchangePointer& exchange) {
  v1::GetServerInfoResponse info;
  describe(api.backend().config, info);
  exchange->answer({.content_type = "application/json"}, wire::json_of(info) + "\n");
}

}  // namespace trc::server::http
