#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/http/api.h"
#include "server/http/exchange.h"
#include "server/http/rpc_call.h"

namespace trc::server::http {

// Turns the answers of an RPC into an answer over HTTP. `take` and `close` may be called in a
// worker thread; never two at a time.
class Format {
 public:
  virtual ~Format() = default;

  [[nodiscard]] virtual Head head() const = 0;
  // Appends the output for an answer of the RPC. False: it is no such answer, or too much.
  [[nodiscard]] virtual bool take(const grpc::ByteBuffer& answer, std::string& out) = 0;
  // Appends what closes an answer that is whole.
  virtual void close(std::string& out) = 0;
  // No part of the answer is out yet: sends the refusal in its place.
  virtual void refuse(const ExchangePointer& exchange, const grpc::Status& status) = 0;
  // Part of it is out: appends a mark of the failure. True when no reader can take the result for a
  // complete answer; else the connection ends without the end of the answer.
  [[nodiscard]] virtual bool stop(const grpc::Status& status, std::string& out) = 0;

  // Headers that only the whole answer has, and their names.
  [[nodiscard]] virtual Pairs headers_at_end() const { return {}; }
  [[nodiscard]] virtual std::string names_at_end() const { return {}; }

  // Whether making it takes long enough for the worker pool.
  [[nodiscard]] virtual bool computes() const { return true; }
  // Whether it may be sent before it is complete.
  [[nodiscard]] virtual bool streams() const { return true; }
};

// The requests to the RPC: messages in their order.
class Questions {
 public:
  virtual ~Questions() = default;
  // The next one; `last` says that none follows.
  [[nodiscard]] virtual grpc::ByteBuffer next(bool& last) = 0;
};

// Messages that are made already, one or more.
class PreparedQuestions final : public Questions {
 public:
  explicit PreparedQuestions(std::vector<grpc::ByteBuffer> messages)
      : messages_(std::move(messages)) {}
  grpc::ByteBuffer next(bool& last) override {
    last = next_ + 1 == messages_.size();
    return messages_[next_++];
  }

 private:
  std::vector<grpc::ByteBuffer> messages_;
  std::size_t next_ = 0;
};

// Answers a request with the answers of an RPC of this process. An answer that fits into the memory
// for held answers is sent once its end is known, so that its status is right; a larger one starts
// with its status, and is broken off if it fails.
class RpcExchange : public std::enable_shared_from_this<RpcExchange> {
 public:
  static void start(Api& api, ExchangePointer exchange, std::string method,
                    std::unique_ptr<Questions> questions, std::shared_ptr<Format> format) {
    start(api, std::move(exchange), RpcCall::Options{.method = std::move(method)},
          std::move(questions), std::move(format));
  }
  static void start(Api& api, ExchangePointer exchange, RpcCall::Options call,
                    std::unique_ptr<Questions> questions, std::shared_ptr<Format> format);

 private:
  RpcExchange(Api& api, ExchangePointer exchange, std::unique_ptr<Questions> questions,
              std::shared_ptr<Format> format);

  void ask();
  void read();
  void on_answer(bool ok, const grpc::ByteBuffer& answer);
  // In a worker thread or not, then in the executor of the connection.
  void format(const grpc::ByteBuffer& answer);
  void pass_on();
  void on_done(const grpc::Status& status);
  void finish();
  [[nodiscard]] Pairs headers_at_end() const;
  void stop(const grpc::Status& status);
  void give_up();

  Api& api_;
  const Api::Stay stay_{api_};
  ExchangePointer exchange_;
  std::unique_ptr<Questions> questions_;
  std::shared_ptr<Format> format_;
  std::shared_ptr<RpcCall> call_;
  std::string piece_;  // of the answer being formatted
  std::string held_;   // not sent yet
  bool begun_ = false;
  bool too_much_ = false;
  bool gone_ = false;
};

}  // namespace trc::server::http
