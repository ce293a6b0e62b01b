#include "server/http/head.h"

#include <array>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/http/write.hpp>
#include <cstdio>
#include <sstream>
#include <utility>

#include "server/http/problem.h"

namespace trc::server::http {
namespace {

namespace bhttp = boost::beast::http;

std::string lower(boost::beast::string_view text) {
  std::string result(text.data(), text.size());
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace

Request request_of(const RequestHead& head, std::string peer) {
  Request request;
  request.peer = std::move(peer);
  const auto method = head.method_string();
  request.method = std::string(method.data(), method.size());
  for (const auto& field : head)
    request.headers.emplace_back(lower(field.name_string()),
                                 std::string(field.value().data(), field.value().size()));
  return request;
}

bool expects_continue(const RequestHead& head) {
  return lower(head[bhttp::field::expect]) == "100-continue";
}

std::string bytes_of(const Head& head, std::optional<std::size_t> length, bool keep_alive) {
  bhttp::response<bhttp::empty_body> response(bhttp::int_to_status(head.status), 11);
  for (const auto& [name, value] : head.headers) response.insert(name, value);
  if (!head.content_type.empty()) response.set(bhttp::field::content_type, head.content_type);
  if (length)
    response.set(bhttp::field::content_length, std::to_string(*length));
  else
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
                 "at most " + std::to_string(most_bytes) +
                     " bytes are taken here (http-max-body-mib, max-message-bytes)");
}

v1::Problem no_memory_for_body() {
  return problem(503, "HTTP_MEMORY_LIMIT", "A limit of the server is reached",
                 "requests and views take all the memory the setting http-max-memory-mib "
                 "allows; try again later");
}

}  // namespace trc::server::http
