#include "server/http/api.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/http/connect.h"
#include "server/http/problem.h"
#include "server/http/questions.h"
#include "server/http/uri.h"
#include "server/net/address.h"
#include "server/rpc/unknown_rpc.h"
#include "server/work/worker_pool.h"

namespace trc::server::http {
namespace {

// Counted from the last request for the view.
constexpr std::chrono::minutes view_lifetime{30};

// Whether a path matches a pattern.
bool fits(std::string_view pattern, std::string_view path) {
  while (!pattern.empty() && pattern.front() != '{') {
    if (path.empty() || path.front() != pattern.front()) return false;
    pattern.remove_prefix(1);
    path.remove_prefix(1);
  }
  if (pattern.empty()) return path.empty();
  pattern.remove_prefix(pattern.find('}') + 1);
  const std::size_t end = std::min(path.find('/'), path.size());
  return end > 0 && fits(pattern, path.substr(end));
}

bool is_method_of(const Route& route, std::string_view method) {
  return route.method == method || (route.method == "GET" && method == "HEAD");
}

const Route* route_of(const Request& request) {
  for (const Route& route : routes())
    if (is_method_of(route, request.method) && fits(route.path, request.path)) return &route;
  return nullptr;
}

// "GET, HEAD"; empty: the path does not exist. "*" gives the methods of all routes.
std::string methods_at(std::string_view path) {
  std::string methods;
  for (const Route& route : routes()) {
    if (path != "*" && !fits(route.path, path)) continue;
    if (methods.find(route.method) != std::string::npos) continue;
    if (!methods.empty()) methods += ", ";
    methods += route.method;
    if (route.method == "GET") methods += ", HEAD";
  }
  if (methods.empty() && rpc_at(std::string(path)) != nullptr) methods = "POST";
  return methods;
}

// "/trc.v1.TrcService/Name", for any names.
bool names_rpc(std::string_view path) {
  const std::string_view service = path.substr(0, path.find('/', 1));
  return service.size() < path.size() && service.find('.') != std::string_view::npos;
}

// "Sun, 06 Nov 1994 08:49:37 GMT", independent of the locale.
std::string date_of(std::chrono::system_clock::time_point now) {
  constexpr std::array<const char*, 7> days{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr std::array<const char*, 12> months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                               "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  std::tm utc{};
  if (::gmtime_r(&seconds, &utc) == nullptr) return {};
  std::array<char, 64> text{};
  const int length = std::snprintf(text.data(), text.size(), "%s, %02d %s %04d %02d:%02d:%02d GMT",
                                   days[static_cast<std::size_t>(utc.tm_wday)], utc.tm_mday,
                                   months[static_cast<std::size_t>(utc.tm_mon)], utc.tm_year + 1900,
                                   utc.tm_hour, utc.tm_min, utc.tm_sec);
  return {text.data(), static_cast<std::size_t>(length)};
}

std::string_view host_of(std::string_view authority) {
  if (authority.starts_with('[')) return authority.substr(1, authority.find(']') - 1);
  return authority.substr(0, authority.find(':'));
}

// Only whole addresses count: anybody can own a name such as 127.0.0.1.example. Case does not
// matter in host names.
bool is_this_machine(std::string_view authority) {
  if (!is_authority(authority)) return false;
  const std::string_view host = host_of(authority);
  const bool numeric = host.find_first_not_of("0123456789.") == std::string_view::npos;
  const bool named = std::ranges::equal(host, std::string_view("localhost"), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
  });
  return named || host == "::1" || (numeric && host.starts_with("127."));
}

}  // namespace

// Deletes itself at the end of its turn.
class Api::Task final : public WorkerPool::Job {
 public:
  Task(Api& api, std::function<void()> work) : api_(api), work_(std::move(work)) {}

  void turn() noexcept override {
    try {
      work_();
    } catch (const std::exception& bug) {
      api_.backend_.telemetry.log.error(LogLine("incident").text("what", bug.what()));
    }
    Api& api = api_;
    delete this;
    api.end();
  }

 private:
  Api& api_;
  std::function<void()> work_;
};

Api::Api(Backend& backend, std::shared_ptr<grpc::Channel> channel, Memory& memory,
         const Options& options)
    : backend_(backend),
      channel_(std::move(channel)),
      memory_(memory),
      views_(backend.config.http_max_views, view_lifetime),
      options_(options) {}

Api::~Api() = default;

std::size_t Api::most_message_bytes() const { return backend_.config.max_message_bytes; }

Service::Admission Api::admit(const Request& head) {
  if (auto refused = refuse_origin(head)) return {.refused = std::move(refused)};
  if (!head.header("content-encoding").empty() && head.header("content-encoding") != "identity")
    return {.refused = problem(415, "CONTENT_ENCODING", "Compressed bodies are not taken",
                               "send the body without Content-Encoding")};
  const std::string charset = head.charset();
  if (!charset.empty() && charset != "utf-8" && charset != "us-ascii")
    return {.refused = problem(415, "CHARSET", "Bodies are taken in UTF-8",
                               "send the body with charset=utf-8")};
  // JSON takes about four times the bytes of the binary message.
  constexpr std::size_t json_overhead = 4;
  const std::size_t most_message = json_overhead * most_message_bytes();
  if (const Route* route = route_of(head)) {
    switch (route->body) {
      case Body::none:
        return {.most_body_bytes = 0};
      case Body::message:
        return {.most_body_bytes = most_message};
      case Body::program:
        return {.most_body_bytes = std::size_t{backend_.config.http_max_body_mib} << 20U};
    }
  }
  if (head.method == "POST" && rpc_at(head.path) != nullptr)
    return {.most_body_bytes = most_message};
  const std::string methods = methods_at(head.path);
  if (methods.empty())
    return {.refused = problem(404, "NOT_FOUND", "There is nothing at this path",
                               names_rpc(head.path) ? "there is no such RPC; " + known_rpcs()
                                                    : "see /v1/openapi.json for what there is")};
  if (head.method == "OPTIONS") return {};
  return {.refused = problem(405, "METHOD_NOT_ALLOWED", "This method is not possible here",
                             "possible are " + methods)};
}

void Api::handle(const ExchangePointer& exchange) {
  const Stay stay(*this);
  if (stopping()) return exchange->break_off();
  Request& request = exchange->request();
  request.trace = trace_of(request.header("traceparent"));
  if (request.method == "OPTIONS")
    return exchange->answer(
        {.status = 204, .headers = {{"Allow", methods_at(request.path) + ", OPTIONS"}}}, {});
  if (const Route* route = route_of(request)) {
    if (const auto refused = refuse_query(*route, request.query))
      return answer_problem(*exchange, *refused);
    if (route->body == Body::program && !is_text(request.content_type()))
      return answer_problem(*exchange, problem(415, "CONTENT_TYPE", "The body must be NC text",
                                               "send it as text/plain; charset=utf-8"));
    std::optional<std::chrono::milliseconds> timeout;
    if (!read_timeout(request.header("connect-timeout-ms"), timeout))
      return answer_problem(*exchange,
                            problem(400, "TIMEOUT_INVALID", "The timeout cannot be taken",
                                    "Connect-Timeout-Ms must be a whole number of at most ten "
                                    "digits"));
    return route->handle(*this, exchange);
  }
  answer_connect(*this, exchange);
}

// A foreign page must not use a server that its reader can reach; browsers name the origin of a
// request. A server for this machine alone also refuses foreign host names, because such a name may
// have been pointed at this machine's address.
std::optional<v1::Problem> Api::refuse_origin(const Request& request) const {
  if (options_.local && !is_this_machine(request.header("host")))
    return problem(421, "HOST_NOT_LOCAL", "This server is for this machine",
                   "the Host header must be localhost, 127.0.0.1 or [::1]; a proxy has to send one "
                   "of them, or http-listen has to be an address that other machines can reach");
  const std::string_view origin = request.header("origin");
  if (origin.empty() || is_own_origin(request, origin)) return std::nullopt;
  const auto& allowed = backend_.config.http_cors_origins;
  if (std::find(allowed.begin(), allowed.end(), origin) != allowed.end()) return std::nullopt;
  return problem(403, "ORIGIN_NOT_ALLOWED", "Pages of this origin may not use the server",
                 "the setting http-cors-origins does not name it");
}

bool Api::is_own_origin(const Request& request, std::string_view origin) const {
  const std::string own =
      (options_.tls ? "https://" : "http://") + std::string(request.header("host"));
  return origin == own;
}

void Api::decorate(const Request& request, Head& head) {
  const auto add = [&](const char* name, std::string_view value) {
    head.headers.emplace_back(name, std::string(value));
  };
  add("X-Content-Type-Options", "nosniff");
  add("Referrer-Policy", "no-referrer");
  add("Cross-Origin-Resource-Policy", "same-origin");
  add("Date", date_of(std::chrono::system_clock::now()));
  if (head.status == 405) add("Allow", methods_at(request.path) + ", OPTIONS");
  const auto has = [&](std::string_view name) {
    return std::any_of(head.headers.begin(), head.headers.end(),
                       [&](const auto& pair) { return pair.first == name; });
  };
  if (!has("Cache-Control")) add("Cache-Control", "no-store");
  if (!has("Content-Security-Policy"))
    add("Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'");
  const std::string_view origin = request.header("origin");
  const auto& allowed = backend_.config.http_cors_origins;
  if (origin.empty() || std::find(allowed.begin(), allowed.end(), origin) == allowed.end()) return;
  add("Access-Control-Allow-Origin", origin);
  add("Vary", "Origin");
  add("Access-Control-Expose-Headers", "Trc-Status, Trc-Warnings, Trc-First-Warning");
  if (request.method != "OPTIONS") return;
  add("Access-Control-Allow-Methods", "GET, POST, DELETE");
  add("Access-Control-Allow-Headers",
      "Content-Type, Accept, Connect-Protocol-Version, Connect-Timeout-Ms, Traceparent");
  add("Access-Control-Max-Age", "600");
}

void Api::log(const Request& request, unsigned status, std::uint64_t bytes, double ms, End end) {
  LogLine line("http");
  line.text("method", request.method).text("path", request.path).text("peer", request.peer);
  // A request refused by its head has no trace.
  if (!request.trace.trace_id.empty()) add_trace(line, request.trace);
  line.number("status", std::uint64_t{status}).number("bytes_out", bytes).number("ms", ms);
  if (end == End::broken_off) line.text("ended", "broken_off");
  backend_.telemetry.log.info(line);
}

std::shared_ptr<RpcCall> Api::call(RpcCall::Options options, const Request& request,
                                   RpcCall::Done done) {
  options.traceparent = traceparent_of(request.trace);
  options.client = client_of(request.peer);
  options.address = request.peer;
  (void)read_timeout(request.header("connect-timeout-ms"), options.timeout);
  begin();
  auto call = RpcCall::start(channel_, options,
                             [this, done = std::move(done)](const grpc::Status& status) mutable {
                               done(status);
                               done = nullptr;
                               end();
                             });
  const std::lock_guard lock(mutex_);
  calls_.remove_if([](const std::weak_ptr<RpcCall>& other) { return other.expired(); });
  calls_.push_back(call);
  if (stopping_) call->cancel();
  return call;
}

void Api::compute(std::function<void()> work) {
  begin();
  // The task deletes itself after its turn.
  backend_.pool.submit(*new Task(*this, std::move(work)));
}

void Api::compute_in_background(std::function<void()> work) {
  begin();
  background_.submit(*new Task(*this, std::move(work)));
}

void Api::begin() {
  const std::lock_guard lock(mutex_);
  ++on_their_way_;
}

void Api::end() {
  const std::lock_guard lock(mutex_);
  --on_their_way_;
  changed_.notify_all();
}

bool Api::stopping() {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

void Api::stop() {
  std::unique_lock lock(mutex_);
  stopping_ = true;
  std::vector<std::shared_ptr<RpcCall>> alive;
  for (const auto& call : calls_) alive.push_back(call.lock());
  lock.unlock();
  for (const auto& call : alive)
    if (call != nullptr) call->cancel();
  alive.clear();
  lock.lock();
  changed_.wait(lock, [this] { return on_their_way_ == 0; });
}

}  // namespace trc::server::http
