#include "server/http/rpc_exchange.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace trc::server::http {
namespace {

// The most bytes held back before the answer is sent while it is still computed.
constexpr std::size_t most_held_bytes = 1U << 20U;

}  // namespace

void RpcExchange::start(Api& api, ExchangePointer exchange, RpcCall::Options call,
                        std::unique_ptr<Questions> questions, std::shared_ptr<Format> format) {
  const std::shared_ptr<RpcExchange> self(
      new RpcExchange(api, std::move(exchange), std::move(questions), std::move(format)));
  self->call_ =
      api.call(std::move(call), self->exchange_->request(), [self](const grpc::Status& status) {
        self->exchange_->post([self, status] { self->on_done(status); });
      });
  self->exchange_->when_gone([self] { self->give_up(); });
  // Reading starts first: within one process the only answer of a unary RPC is lost if its status
  // arrives before a read has started.
  self->read();
  self->ask();
}

RpcExchange::RpcExchange(Api& api, ExchangePointer exchange, std::unique_ptr<Questions> questions,
                         std::shared_ptr<Format> format)
    : api_(api),
      exchange_(std::move(exchange)),
      questions_(std::move(questions)),
      format_(std::move(format)) {}

void RpcExchange::ask() {
  bool last = false;
  const grpc::ByteBuffer message = questions_->next(last);
  const auto sequel = last ? RpcCall::Sequel::none : RpcCall::Sequel::more;
  call_->write(message, sequel, [self = shared_from_this(), last](bool ok) {
    if (ok && !last) self->exchange_->post([self] { self->ask(); });
  });
}

void RpcExchange::read() {
  call_->read([self = shared_from_this()](bool ok, const grpc::ByteBuffer& answer) {
    self->on_answer(ok, answer);
  });
}

void RpcExchange::on_answer(bool ok, const grpc::ByteBuffer& answer) {
  // The RPC has ended; its status follows.
  if (!ok) return;
  const auto work = [self = shared_from_this(), answer] { self->format(answer); };
  if (format_->computes())
    api_.compute(work);
  else
    work();
}

void RpcExchange::format(const grpc::ByteBuffer& answer) {
  piece_.clear();
  too_much_ = too_much_ || !format_->take(answer, piece_);
  exchange_->post([self = shared_from_this()] { self->pass_on(); });
}

void RpcExchange::pass_on() {
  if (too_much_) call_->cancel();
  if (gone_ || too_much_) return read();
  const bool may_wait = !format_->streams() || held_.size() + piece_.size() <= most_held_bytes;
  const bool has_memory = exchange_->hold(begun_ ? 0 : piece_.size());
  held_ += piece_;
  if (!begun_ && may_wait && has_memory) return read();
  if (!format_->streams()) {
    too_much_ = true;
    call_->cancel();
    return read();
  }
  if (!std::exchange(begun_, true)) {
    Head head = format_->head();
    head.headers.emplace_back("Trailer", "Trc-Status" + format_->names_at_end());
    exchange_->begin(std::move(head));
  }
  exchange_->write(std::exchange(held_, {}), [self = shared_from_this()](bool /*taken*/) {
    // It reads on even if the client has gone: only reading ends the call.
    self->read();
  });
}

void RpcExchange::on_done(const grpc::Status& status) {
  if (gone_) return exchange_->break_off();
  if (too_much_)
    return format_->refuse(exchange_, {grpc::StatusCode::RESOURCE_EXHAUSTED,
                                       "the answer is too large to be held as a whole; ask for "
                                       "application/x-ndjson"});
  if (!status.ok()) return stop(status);
  const auto close = [self = shared_from_this()] {
    self->format_->close(self->held_);
    self->exchange_->post([self] { self->finish(); });
  };
  if (format_->computes())
    api_.compute(close);
  else
    close();
}

void RpcExchange::finish() {
  if (!begun_) {
    Head head = format_->head();
    std::ranges::move(headers_at_end(), std::back_inserter(head.headers));
    return exchange_->answer(std::move(head), std::move(held_));
  }
  exchange_->write(std::exchange(held_, {}),
                   [exchange = exchange_, trailers = headers_at_end()](bool taken) {
                     if (taken) exchange->end(trailers);
                   });
}

Pairs RpcExchange::headers_at_end() const {
  Pairs headers = format_->headers_at_end();
  headers.emplace_back("Trc-Status", "OK");
  return headers;
}

void RpcExchange::stop(const grpc::Status& status) {
  if (!begun_) return format_->refuse(exchange_, status);
  const bool is_said = format_->stop(status, held_);
  exchange_->write(std::exchange(held_, {}), [exchange = exchange_, is_said](bool taken) {
    if (!taken) return;
    if (is_said)
      exchange->end({});
    else
      exchange->break_off();
  });
}

void RpcExchange::give_up() {
  gone_ = true;
  call_->cancel();
}

}  // namespace trc::server::http
