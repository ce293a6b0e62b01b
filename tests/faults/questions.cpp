#include "tests/faults/questions.h"

#include <grpcpp/grpcpp.h>

#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {

std::shared_ptr<grpc::Channel> channel_to(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

bool serves(const std::string& address) {
  return server::run_program(channel_to(address), {}, server::g239_program).status.ok();
}

double metric(const std::string& admin, const std::string& name) {
  const std::string page = testing_support::http_get(admin, "/metrics");
  const std::size_t at = page.find("\n" + name + " ");
  return at == std::string::npos ? -1 : std::stod(page.substr(at + name.size() + 2));
}

}  // namespace trc::faults
