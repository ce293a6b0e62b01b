#include "server/http/connection.h"

#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <cerrno>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "server/http/body_reader.h"
#include "server/http/head.h"
#include "server/http/problem.h"
#include "server/http/tls.h"
#include "server/http/unread_rest.h"

namespace trc::server::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace bhttp = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;

using PlainStream = beast::tcp_stream;
using TlsStream = beast::ssl_stream<beast::tcp_stream>;

constexpr std::chrono::seconds longest_farewell{2};

template <class Stream>
class Connection final : public Exchange,
                         public OpenConnection,
                         public std::enable_shared_from_this<Connection<Stream>> {
 public:
  Connection(Stream stream, NewConnection&& given, Service& service, Memory& memory,
             const ConnectionLimits& limits)
      : tls_(std::move(given.tls)),
        stream_(std::move(stream)),
        allowed_clients_(std::move(given.allowed_clients)),
        service_(service),
        limits_(limits),
        peer_memory_(std::move(given.of_peer)),
        share_(memory),
        share_of_peer_(*peer_memory_),
        body_(
            stream_, buffer_, limits.timeout,
            [this](std::size_t bytes) { return take_memory(bytes); },
            [this](const BodyEnding& ending) { on_body(ending); }) {
    request_.peer = std::move(given.peer);
  }

  void start() {
    asio::dispatch(stream_.get_executor(), [self = this->shared_from_this()] {
      if constexpr (is_tls)
        self->shake_hands();
      else
        self->await_request();
    });
  }

  void close() override {
    asio::post(stream_.get_executor(), [self = this->shared_from_this()] { self->close_socket(); });
  }

  // Overrides of Exchange.
  Request& request() override { return request_; }

  void answer(Head head, std::string body) override {
    std::string bytes = head_bytes(std::move(head), body.size());
    if (request_.method != "HEAD") bytes += body;
    send(std::move(bytes), [self = this->shared_from_this()](bool taken) {
      if (taken) self->finish();
    });
  }

  void begin(Head head) override { begun_ = head_bytes(std::move(head), std::nullopt); }

  void write(std::string piece, Written then) override {
    send(std::exchange(begun_, {}) + chunk_of(piece), std::move(then));
  }

  void end(const Pairs& trailers) override {
    send(std::exchange(begun_, {}) + last_chunk(trailers),
         [self = this->shared_from_this()](bool taken) {
           if (taken) self->finish();
         });
  }

  void break_off() override {
    record(Service::End::broken_off);
    gone_ = nullptr;
    close_socket();
  }

  void when_gone(std::function<void()> then) override {
    gone_ = std::move(then);
    watch();
  }

  void post(std::function<void()> then) override {
    asio::post(stream_.get_executor(),
               [self = this->shared_from_this(), then = std::move(then)] { then(); });
  }

  bool hold(std::size_t bytes) override { return share_of_peer_.take(bytes) && share_.take(bytes); }

 private:
  static constexpr bool is_tls = std::is_same_v<Stream, TlsStream>;
  static constexpr std::string_view scheme = is_tls ? "https" : "http";

  beast::tcp_stream& lowest() { return beast::get_lowest_layer(stream_); }

  template <class Method>
  auto then(Method method) {
    return [self = this->shared_from_this(), method](error_code fault, std::size_t bytes) {
      (self.get()->*method)(fault, bytes);
    };
  }

  void shake_hands() {
    if constexpr (is_tls) {
      lowest().expires_after(limits_.timeout);
      stream_.async_handshake(
          asio::ssl::stream_base::server, [self = this->shared_from_this()](error_code fault) {
            if (fault) return self->close_socket();
            self->allowed_ = is_allowed(self->stream_.native_handle(), self->allowed_clients_);
            self->await_request();
          });
    }
  }

  void give_memory_back() {
    share_.release();
    share_of_peer_.release();
  }

  void await_request() {
    give_memory_back();
    is_whole_ = false;
    parser_.emplace(limits_.most_header_bytes);
    parser_->header_limit(static_cast<std::uint32_t>(limits_.most_header_bytes));
    // The real limit is set once the head is known.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    waits();
    lowest().expires_after(limits_.timeout);
    bhttp::async_read_header(stream_, buffer_, *parser_, then(&Connection::on_head));
  }

  void on_head(error_code fault, std::size_t /*bytes*/) {
    works();
    started_ = Clock::now();
    sent_ = 0;
    recorded_ = false;
    if (fault == bhttp::error::header_limit)
      return refuse(431, "HEAD_TOO_LARGE", "The head of the request is too large");
    if (fault.category() == make_error_code(bhttp::error::bad_method).category() &&
        fault != bhttp::error::end_of_stream && fault != bhttp::error::partial_message)
      return refuse(400, "REQUEST_MALFORMED", "This is not HTTP");
    if (fault) return close_socket();
    request_ = request_of(parser_->get(), std::move(request_.peer));
    keep_alive_ = parser_->keep_alive();
    is_whole_ = parser_->is_done();
    const auto& head = parser_->get();
    // Without chunks the end of an answer would be the end of the connection.
    if (head.version() != 11) return refuse(505, "HTTP_VERSION", "The server speaks HTTP/1.1");
    if (const auto fault_of_head = fault_of(request_)) {
      // The end of the body is not certain.
      keep_alive_ = false;
      return refuse(*fault_of_head);
    }
    const auto fault_of_target =
        take_target({head.target().data(), head.target().size()}, scheme, request_);
    if (fault_of_target) return refuse(*fault_of_target);
    if (!allowed_)
      return refuse(403, "CLIENT_NOT_ALLOWED", "The name of the certificate is not allowed");
    admit();
  }

  void admit() {
    const Service::Admission admission = service_.admit(request_);
    if (admission.refused) return refuse(*admission.refused);
    const std::size_t most = admission.most_body_bytes;
    const auto length = parser_->content_length();
    if (length && *length > most) return refuse(body_too_large(most));
    const std::size_t announced = length ? static_cast<std::size_t>(*length) : 0;
    if (const Room room = take_memory(announced); room != Room::some)
      return refuse(no_memory_for_body(room));
    // For chunks: the parser refuses a body as soon as a chunk passes this limit.
    parser_->body_limit(most);
    const BodyBounds bounds{.most_bytes = most, .held_bytes = announced};
    if (expects_continue(parser_->get()) && !is_whole_)
      return send("HTTP/1.1 100 Continue\r\n\r\n",
                  [self = this->shared_from_this(), bounds](bool taken) {
                    if (taken) self->read_body(bounds);
                  });
    read_body(bounds);
  }

  void read_body(const BodyBounds& bounds) {
    if (is_whole_) return dispatch();
    body_.read(this->shared_from_this(), *parser_, request_.body, bounds);
  }

  void on_body(const BodyEnding& ending) {
    if (ending.broken) return close_socket();
    if (ending.refused) return refuse(*ending.refused);
    dispatch();
  }

  // Memory for a request comes before memory for views that have been looked at.
  Room take_memory(std::size_t bytes) {
    if (!share_of_peer_.take(bytes)) return Room::none_of_own;
    while (!share_.take(bytes))
      if (!service_.make_room()) return Room::none;
    return Room::some;
  }

  void dispatch() {
    lowest().expires_never();
    is_whole_ = true;
    service_.handle(this->shared_from_this());
  }

  // Notices when the client closes the connection while the answer is computed.
  void watch() {
    if (watching_) return;
    watching_ = true;
    lowest().socket().async_wait(
        tcp::socket::wait_read,
        [self = this->shared_from_this()](error_code fault) { self->on_watched(fault); });
  }

  void on_watched(error_code fault) {
    watching_ = false;
    if (!gone_) return;
    if (!fault) {
      char byte = 0;
      const auto got = ::recv(lowest().socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
      // These bytes are the next request, which can wait.
      if (got > 0) return;
      if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return watch();
    }
    lose();
  }

  void lose() {
    const auto gone = std::exchange(gone_, nullptr);
    if (gone) gone();
  }

  std::string head_bytes(Head head, std::optional<std::size_t> length) {
    status_ = head.status;
    service_.decorate(request_, head);
    return bytes_of(head, length, keep_alive_);
  }

  // An answer before the whole request is read ends the connection.
  void refuse(unsigned status, std::string_view reason, std::string_view title) {
    refuse(problem(status, reason, title, title));
  }
  void refuse(const v1::Problem& problem) {
    keep_alive_ = keep_alive_ && is_whole_;
    give_memory_back();
    request_.body = {};
    parser_->get().body().clear();
    parser_->get().body().shrink_to_fit();
    answer_problem(*this, problem);
  }

  void send(std::string bytes, Written then) {
    outgoing_ = std::move(bytes);
    written_ = std::move(then);
    sent_ += outgoing_.size();
    send_from(0);
  }

  void send_from(std::size_t begin) {
    if (begin == outgoing_.size())
      return asio::post(stream_.get_executor(),
                        [self = this->shared_from_this()] { self->told(true); });
    const std::size_t size = std::min(piece_bytes, outgoing_.size() - begin);
    lowest().expires_after(limits_.timeout);
    asio::async_write(stream_, asio::buffer(outgoing_.data() + begin, size),
                      [self = this->shared_from_this(), end = begin + size](error_code fault,
                                                                            std::size_t /*bytes*/) {
                        if (!fault) return self->send_from(end);
                        self->close_socket();
                        self->told(false);
                      });
  }

  void told(bool taken) {
    lowest().expires_never();
    const Written then = std::exchange(written_, nullptr);
    if (!taken) {
      record(Service::End::broken_off);
      lose();
    }
    if (then) then(taken);
  }

  void finish() {
    record(Service::End::whole);
    gone_ = nullptr;
    request_.body = {};
    if (keep_alive_) return await_request();
    say_farewell();
  }

  // Once for a request: what breaks off the answer may be told of its end once more.
  void record(Service::End end) {
    if (std::exchange(recorded_, true)) return;
    const std::chrono::duration<double, std::milli> took = Clock::now() - started_;
    service_.log(request_, status_, sent_, took.count(), end);
  }

  void say_farewell() {
    error_code ignored;
    give_memory_back();
    // The client has its answer; this connection may be closed to make room for others.
    waits();
    if constexpr (!is_tls) lowest().socket().shutdown(tcp::socket::shutdown_send, ignored);
    lowest().expires_after(longest_farewell);
    if constexpr (is_tls) {
      stream_.async_shutdown(
          [self = this->shared_from_this()](error_code) { self->close_socket(); });
    } else {
      const auto self = this->shared_from_this();
      rest_.forget(self, [this] { close_socket(); });
    }
  }

  void close_socket() {
    error_code ignored;
    lowest().socket().close(ignored);
    lowest().cancel();
  }

  std::shared_ptr<asio::ssl::context> tls_;
  Stream stream_;
  const std::vector<std::string> allowed_clients_;
  Service& service_;
  const ConnectionLimits limits_;
  const std::shared_ptr<Memory> peer_memory_;
  Share share_;
  Share share_of_peer_;
  bool allowed_ = true;

  beast::flat_buffer buffer_{piece_bytes * 2};
  std::optional<BodyParser> parser_;
  Request request_;
  BodyReader<Stream> body_;
  bool is_whole_ = false;
  bool keep_alive_ = true;

  Clock::time_point started_{};
  unsigned status_ = 0;
  std::uint64_t sent_ = 0;
  bool recorded_ = false;
  std::string begun_;  // head of an answer, not sent yet
  std::string outgoing_;
  Written written_;
  std::function<void()> gone_;
  bool watching_ = false;
  UnreadRest rest_{lowest(), buffer_};
};

template <class Stream>
std::shared_ptr<OpenConnection> started(Stream stream, NewConnection&& connection, Service& service,
                                        Memory& memory, const ConnectionLimits& limits) {
  const auto made = std::make_shared<Connection<Stream>>(std::move(stream), std::move(connection),
                                                         service, memory, limits);
  made->start();
  return made;
}

}  // namespace

std::shared_ptr<OpenConnection> serve(NewConnection connection, Service& service, Memory& memory,
                                      const ConnectionLimits& limits) {
  PlainStream plain(std::move(connection.socket));
  if (connection.tls == nullptr)
    return started(std::move(plain), std::move(connection), service, memory, limits);
  asio::ssl::context& context = *connection.tls;
  return started(TlsStream(std::move(plain), context), std::move(connection), service, memory,
                 limits);
}

}  // namespace trc::server::http
