#include "server/rpc/unknown_rpc.h"

#include <google/protobuf/descriptor.h>

#include "server/rpc/caller.h"
#include "server/rpc/status.h"
#include "server/text.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server {
namespace {

// Refuses one call and deletes itself.
class Refusing final : public grpc::ServerGenericBidiReactor {
 public:
  explicit Refusing(const grpc::Status& status) { Finish(status); }
  void OnDone() override { delete this; }
};

// Short enough to fit into a status with the names of all RPCs.
constexpr std::size_t longest_name = 60;

}  // namespace

std::string known_rpcs() {
  const auto& service = *v1::GetServerInfoRequest::descriptor()->file()->service(0);
  std::string text = service.full_name();
  for (int i = 0; i < service.method_count(); ++i)
    text.append(i == 0 ? " has " : ", ").append(service.method(i)->name());
  return text;
}

grpc::ServerGenericBidiReactor* UnknownRpc::CreateReactor(
    grpc::GenericCallbackServerContext* context) {
  if (const auto refused = refuse_caller(*context, backend_.config.tls_allowed_clients))
    return new Refusing(refused->status);
  static const std::string known = known_rpcs();
  const std::string asked = presentable(context->method(), longest_name);
  return new Refusing(refuse(Refusal::rpc_unknown, asked + "; " + known, {{"rpc", asked}}).status);
}

}  // namespace trc::server
