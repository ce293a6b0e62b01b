#include "server/http/head.h"

#include <algorithm>
#include <array>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/http/write.hpp>
#include <cstdio>
#include <sstream>
#include <utility>

#include "core/base/ascii.h"
#include "server/http/problem.h"
#include "server/http/uri.h"

namespace trc::server::http {
namespace {

namespace bhttp = boost::beast::http;

std::string_view std_view(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

Request request_of(const RequestHead& head, std::string peer) {
  Request request;
  request.peer = std::move(peer);
  const auto method = head.method_string();
  request.method = std::string(method.data(), method.size());
  for (const auto& field : head)
    request.headers.emplace_back(in_lower_case(std_view(field.name_string())),
                                 std::string(field.value().data(), field.value().size()));
  return request;
}

std::optional<v1::Problem> fault_of(const Request& request) {
  constexpr std::array<std::string_view, 9> single{
      "host",         "origin",           "content-length",           "transfer-encoding", "expect",
      "content-type", "content-encoding", "connect-protocol-version", "connect-timeout-ms"};
  for (const std::string_view name : single)
    if (std::ranges::count(request.headers, name, &Pairs::value_type::first) > 1)
      return problem(400, "HEADER_REPEATED", "A header that may come once comes twice",
                     std::string(name) + " is given more than once");
  if (request.header("host").empty())
    return problem(400, "HOST_MISSING", "The request has no Host header", "HTTP/1.1 asks for one");
  const std::string_view length = request.header("content-length");
  if (length.find_first_not_of("0123456789") != std::string_view::npos)
    return problem(400, "REQUEST_MALFORMED", "This is not HTTP",
                   "Content-Length must be one whole number");
  const auto coding =
      std::ranges::find(request.headers, "transfer-encoding", &Pairs::value_type::first);
  if (coding != request.headers.end() && in_lower_case(coding->second) != "chunked")
    return problem(501, "TRANSFER_ENCODING", "The transfer encoding is not known",
                   "a body comes with Content-Length or with Transfer-Encoding: chunked");
  const std::string_view expected = request.header("expect");
  if (!expected.empty() && in_lower_case(expected) != "100-continue")
    return problem(417, "EXPECTATION_FAILED", "The expectation is not known",
                   "only 100-continue is met");
  return std::nullopt;
}

std::optional<v1::Problem> take_target(std::string_view target, std::string_view scheme,
                                       Request& request) {
  constexpr std::string_view malformed = "The target of the request is not one";
  auto read = read_target(request.method, target);
  if (!read)
    return problem(
        400, "TARGET_MALFORMED", malformed,
        target.find('#') == std::string_view::npos ? malformed : "a # in it is sent as %23");
  if (!read->scheme.empty()) {
    if (read->scheme != scheme)
      return problem(421, "SCHEME_NOT_SERVED", "This server is not the one that is meant",
                     "targets begin with " + std::string(scheme) + ":// here");
    // An absolute target names the host, whatever the header says.
    request.set_header("host", std::move(read->host));
  }
  request.path = std::move(read->path);
  request.query = std::move(read->query);
  return std::nullopt;
}

bool expects_continue(const RequestHead& head) {
  return in_lower_case(std_view(head[bhttp::field::expect])) == "100-continue";
}

std::string bytes_of(const Head& head, std::optional<std::size_t> length, bool keep_alive) {
  bhttp::response<bhttp::empty_body> response(bhttp::int_to_status(head.status), 11);
  for (const auto& [name, value] : head.headers) response.insert(name, value);
  if (!head.content_type.empty()) response.set(bhttp::field::content_type, head.content_type);
  const bool has_body = head.status != 204;
  if (has_body && length)
    response.set(bhttp::field::content_length, std::to_string(*length));
  else if (has_body)
    response.set(bhttp::field::transfer_encoding, "chunked");
  response.keep_alive(keep_alive);
  std::ostringstream bytes;
  bytes << response.base();
  return bytes.str();
}

std::string chunk_of(std::string_view piece) {
  if (piece.empty()) return {};
  std::array<char, 24> size{};
  const int length = std::snprintf(size.data(), size.size(), "%zx\r\n", piece.size());
  return std::string(size.data(), static_cast<std::size_t>(length)).append(piece) += "\r\n";
}

std::string last_chunk(const Pairs& trailers) {
  std::string bytes = "0\r\n";
  for (const auto& [name, value] : trailers)
    bytes.append(name).append(": ").append(value) += "\r\n";
  return bytes += "\r\n";
}

v1::Problem body_too_large(std::size_t most_bytes) {
  return problem(413, "BODY_TOO_LARGE", "The body of the request is too large",
                 most_bytes == 0 ? "none is taken here"
                                 : "at most " + std::to_string(most_bytes) +
                                       " bytes are taken here (http-max-body-mib, "
                                       "max-message-bytes)");
}

v1::Problem no_memory_for_body(Room room) {
  if (room == Room::none_of_own)
    return problem(503, "HTTP_MEMORY_LIMIT", "A limit of the server is reached",
                   "requests of this address take all the memory the setting "
                   "http-max-memory-per-peer-mib allows; try again later");
  return problem(503, "HTTP_MEMORY_LIMIT", "A limit of the server is reached",
                 "requests and views take all the memory the setting http-max-memory-mib "
                 "allows; try again later");
}

}  // namespace trc::server::http
