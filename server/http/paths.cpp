#include <memory>
#include <utility>

#include "proto/wire/json.h"
#include "server/http/api.h"
#include "server/http/formats.h"
#include "server/http/handlers.h"
#include "server/http/problem.h"
#include "server/rpc/get_server_info.h"

namespace trc::server::http {
namespace {

constexpr const char* preview_path_rpc = "/trc.v1.TrcService/PreviewPath";

// Has the path read by a worker and compensated.
void start(Api& api, const ExchangePointer& exchange, bool verify, std::shared_ptr<Format> format) {
  if (exchange->request().content_type() != "application/json")
    return answer_problem(*exchange, problem(415, "CONTENT_TYPE", "The body must be JSON",
                                             "send a PreviewPathRequest as application/json"));
  api.compute([&api, exchange, verify, format = std::move(format)] {
    v1::PreviewPathRequest path;
    const std::string fault = wire::Json().read(exchange->request().body, path);
    path.mutable_setup()->set_response_layout(v1::RESPONSE_LAYOUT_BLOCKS);
    if (verify) path.mutable_setup()->set_verify(v1::VERIFICATION_ENFORCE);
    exchange->post([&api, exchange, fault, question = RpcCall::bytes_of(path), format] {
      exchange->request().body = {};
      if (!fault.empty())
        return answer_problem(
            *exchange, problem(400, "JSON_INVALID", "The body is no PreviewPathRequest", fault));
      Run::start(api, exchange, preview_path_rpc, std::make_unique<OneQuestion>(question), format);
    });
  });
}

}  // namespace

using PathFormat = PathAnswerFormat<v1::PreviewPathResponse>;

void compensate_path(Api& api, const ExchangePointer& exchange) {
  if (exchange->request().accepts("application/x-ndjson"))
    return start(api, exchange, false,
                 std::make_shared<JsonLinesFormat<v1::PreviewPathResponse>>());
  constexpr std::size_t messages = 4;
  start(
      api, exchange, false,
      std::make_shared<PathFormat>(PathFormat::Blocks::given, messages * api.most_message_bytes()));
}

void verify_path(Api& api, const ExchangePointer& exchange) {
  start(api, exchange, true,
        std::make_shared<PathFormat>(PathFormat::Blocks::left_out, api.most_message_bytes()));
}

void server_info(Api& api, const ExchangePointer& exchange) {
  v1::GetServerInfoResponse info;
  describe(api.backend().config, info);
  exchange->answer({.content_type = "application/json"}, wire::json_of(info) + "\n");
}

}  // namespace trc::server::http
