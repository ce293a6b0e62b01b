#pragma once

#include <grpcpp/channel.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "server/backend.h"
#include "server/http/exchange.h"
#include "server/http/offer.h"
#include "server/http/rpc_call.h"
#include "server/http/service.h"
#include "server/http/view/store.h"
#include "server/work/worker_pool.h"

namespace trc::server::http {

class Api;

// The kinds of request bodies.
enum class Body {
  none,
  program,  // NC text
  message,  // JSON or Protobuf
};

// A query parameter that is no setting.
struct Question {
  enum class Kind : std::uint8_t { text, number, share };
  std::string_view name;
  Kind kind;
  std::string_view meaning;
};

// One kind of request.
struct Route {
  std::string_view method;
  std::string_view path;  // `{id}` stands for one segment
  Body body = Body::none;
  bool takes_settings = false;  // as query parameters
  std::string_view answers{};   // content types, with commas between
  std::string_view meaning;
  void (*handle)(Api& api, const ExchangePointer& exchange);
  std::span<const Question> questions{};  // may be asked too
};
[[nodiscard]] std::span<const Route> routes();

// The services of HTTP: routes under /v1, and the RPCs by the Connect protocol.
class Api final : public Service {
 public:
  struct Options {
    bool local = true;  // reached from this machine only
    bool tls = false;
    std::optional<Offer> offer{};
  };
  Api(Backend& backend, std::shared_ptr<grpc::Channel> channel, Memory& memory,
      const Options& options);
  ~Api() override;

  // As of Service.
  Admission admit(const Request& head) override;
  bool make_room() override { return views_.give_up_one(); }
  void handle(const ExchangePointer& exchange) override;
  void decorate(const Request& request, Head& head) override;
  void log(const Request& request, unsigned status, std::uint64_t bytes, double ms,
           End end) override;

  [[nodiscard]] Backend& backend() { return backend_; }
  [[nodiscard]] Memory& memory() { return memory_; }
  [[nodiscard]] const Offer* offer() const { return options_.offer ? &*options_.offer : nullptr; }
  [[nodiscard]] ViewStore& views() { return views_; }
  [[nodiscard]] std::size_t most_message_bytes() const;

  // Starts an RPC of this process for a request. `done` as of RpcCall.
  [[nodiscard]] std::shared_ptr<RpcCall> call(RpcCall::Options options, const Request& request,
                                              RpcCall::Done done);
  // Whether the server is stopping: long work ends then.
  [[nodiscard]] bool stopping();
  // Runs `work` in a worker.
  void compute(std::function<void()> work);
  // Runs work that nobody waits for, after all other work. It yields through `background`.
  void compute_in_background(std::function<void()> work);
  [[nodiscard]] WorkerPool& background() { return background_; }

  // While one lives, `stop` waits.
  class Stay {
   public:
    explicit Stay(Api& api) : api_(api) { api_.begin(); }
    ~Stay() { api_.end(); }
    Stay(const Stay&) = delete;
    Stay& operator=(const Stay&) = delete;

   private:
    Api& api_;
  };

  // Ends the work in progress and waits for its end; nothing may be started any more.
  void stop();

 private:
  class Task;

  [[nodiscard]] std::optional<v1::Problem> refuse_origin(const Request& request) const;
  [[nodiscard]] bool is_own_origin(const Request& request, std::string_view origin) const;
  void begin();
  void end();

  Backend& backend_;
  std::shared_ptr<grpc::Channel> channel_;
  Memory& memory_;
  ViewStore views_;
  const Options options_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t on_their_way_ = 0;  // calls, tasks and who stays
  std::list<std::weak_ptr<RpcCall>> calls_;
  bool stopping_ = false;

  // Ends before the members that its work needs.
  WorkerPool background_{1, WorkerPool::Priority::low};
};

}  // namespace trc::server::http
