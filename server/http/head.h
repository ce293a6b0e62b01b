#pragma once

#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/exchange.h"
#include "server/http/memory.h"
#include "trc/v1/http.pb.h"

namespace trc::server::http {

using RequestHead = boost::beast::http::request_header<boost::beast::http::fields>;

// Method and headers, these in lower case; path, query and body are not read yet.
[[nodiscard]] Request request_of(const RequestHead& head, std::string peer);

// Why a request is refused by its head alone: two readers might see different requests in it, or
// one that is not intended.
[[nodiscard]] std::optional<v1::Problem> fault_of(const Request& request);

// Whether the client waits for permission to send the body.
[[nodiscard]] bool expects_continue(const RequestHead& head);

// The head of an answer as HTTP/1.1 has it; `length` of the body, none: it comes in chunks.
[[nodiscard]] std::string bytes_of(const Head& head, std::optional<std::size_t> length,
                                   bool keep_alive);

// A piece of a body as one chunk; empty for an empty one, which would end the body.
[[nodiscard]] std::string chunk_of(std::string_view piece);
// The end of a body in chunks.
[[nodiscard]] std::string last_chunk(const Pairs& trailers);

// The problem of a body that is too large.
[[nodiscard]] v1::Problem body_too_large(std::size_t most_bytes);
[[nodiscard]] v1::Problem no_memory_for_body(Room room);

}  // namespace trc::server::http
