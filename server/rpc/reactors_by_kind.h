#pragma once

#include <grpcpp/grpcpp.h>

#include <utility>

#include "server/rpc/stream_reactor.h"

namespace trc::server {

// A stream in both directions.
template <class Request, class Response>
class BidiReactor final
    : public StreamReactor<grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>, Request,
                           Response> {
  using Base =
      StreamReactor<grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>, Request, Response>;

 public:
  using Base::Base;

 private:
  void read() override {
    this->await_request();
    this->StartRead(&this->request_.bytes());
  }
  void OnReadDone(bool ok) override {
    this->arrived(ok ? Base::Input::request : Base::Input::ended);
  }
};

// One request, a stream of answers.
template <class Request, class Response>
class AnswerReactor final
    : public StreamReactor<grpc::ServerWriteReactor<grpc::ByteBuffer>, Request, Response> {
 public:
  using Base = StreamReactor<grpc::ServerWriteReactor<grpc::ByteBuffer>, Request, Response>;

  AnswerReactor(Backend& backend, grpc::CallbackServerContext& context, Method method,
                const grpc::ByteBuffer& request)
      : Base(backend, context, method) {
    this->request_.bytes() = request;
  }

 private:
  void read() override {
    this->arrived(std::exchange(asked_, true) ? Base::Input::ended : Base::Input::request);
  }

  bool asked_ = false;
};

// Makes a call with one answer look like a stream of answers: the output is put where gRPC expects
// the answer, to be sent with the status.
class OneAnswer : public grpc::ServerUnaryReactor {
 public:
  virtual void OnWriteDone(bool ok) = 0;

 protected:
  void StartWrite(const grpc::ByteBuffer* answer) {
    *answer_ = *answer;
    OnWriteDone(true);
  }
  void answer_goes_to(grpc::ByteBuffer& answer) { answer_ = &answer; }

 private:
  grpc::ByteBuffer* answer_ = nullptr;
};

// One request, one answer that takes computing.
template <class Request, class Response>
class UnaryReactor final : public StreamReactor<OneAnswer, Request, Response> {
 public:
  using Base = StreamReactor<OneAnswer, Request, Response>;

  UnaryReactor(Backend& backend, grpc::CallbackServerContext& context, Method method,
               const grpc::ByteBuffer& request, grpc::ByteBuffer& response)
      : Base(backend, context, method) {
    this->request_.bytes() = request;
    this->answer_goes_to(response);
  }

 private:
  void read() override { this->arrived(Base::Input::request); }
};

}  // namespace trc::server
