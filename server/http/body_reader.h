#pragma once

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/http/head.h"
#include "server/http/memory.h"
#include "server/http/problem.h"

namespace trc::server::http {

// A body, or an answer, must advance by this much within the timeout, or the connection ends.
inline constexpr std::size_t piece_bytes = 64U << 10U;

// Reads a request whose trailer is bounded and dropped: the head alone decides how it is handled.
// A field that goes on in the next line is refused: some readers see two fields in it.
// Beast throws where a field of a message is longer than 64 KiB.
class BodyParser : public boost::beast::http::request_parser<boost::beast::http::string_body> {
 public:
  explicit BodyParser(std::size_t most_trailer_bytes) : trailer_room_(most_trailer_bytes) {}

 private:
  void on_field_impl(boost::beast::http::field name, boost::beast::string_view text,
                     boost::beast::string_view value, boost::beast::error_code& fault) override {
    if (is_folded(text)) {
      fault = boost::beast::http::error::bad_value;
      return;
    }
    if (!is_header_done()) return get().insert(name, text, value);
    constexpr std::size_t colon_and_line_end = 4;
    const std::size_t bytes = text.size() + value.size() + colon_and_line_end;
    if (bytes > trailer_room_)
      fault = boost::beast::http::error::header_limit;
    else
      trailer_room_ -= bytes;
  }

  // `name` stands in the buffer that holds all lines of the head or trailer, down to the empty one.
  // The value may be a copy without its line ends.
  static bool is_folded(boost::beast::string_view name) {
    const char* end = name.data() + name.size();
    while (*end != '\n') ++end;
    return end[1] == ' ' || end[1] == '\t';
  }

  std::size_t trailer_room_;
};

struct BodyBounds {
  std::size_t most_bytes = 0;
  std::size_t held_bytes = 0;  // for which there is memory
};

// How the reading ended: with the whole body where neither is set.
struct BodyEnding {
  bool broken = false;  // the connection, or it took too long
  std::optional<v1::Problem> refused{};
};

// Reads the body of a request that follows its head in `buffer` and on the stream.
template <class Stream>
class BodyReader {
 public:
  using TakeMemory = std::function<Room(std::size_t bytes)>;
  using Done = std::function<void(const BodyEnding& ending)>;

  BodyReader(Stream& stream, boost::beast::flat_buffer& buffer, std::chrono::seconds timeout,
             TakeMemory take_memory, Done done)
      : stream_(stream),
        buffer_(buffer),
        timeout_(timeout),
        take_memory_(std::move(take_memory)),
        done_(std::move(done)) {}

  // One body at a time. `owner` of all that is given here lives until it has been read.
  void read(const std::shared_ptr<void>& owner, BodyParser& parser, std::string& body,
            const BodyBounds& bounds) {
    parser_ = &parser;
    body_ = &body;
    bounds_ = bounds;
    if (parser.chunked()) return read_chunks(owner, 0);
    length_ = static_cast<std::size_t>(*parser.content_length());
    body.reserve(length_);
    has_come_ = std::min(buffer_.size(), length_);
    body.append(static_cast<const char*>(buffer_.data().data()), has_come_);
    buffer_.consume(has_come_);
    read_rest(owner, 0);
  }

 private:
  using ErrorCode = boost::system::error_code;
  // What is read at a time.
  static constexpr std::size_t most_read_bytes = 1U << 20U;

  void begin_piece() { boost::beast::get_lowest_layer(stream_).expires_after(timeout_); }

  // Reads a body of known length, in pieces as large as they come. `way`: bytes since the clock was
  // last checked.
  void read_rest(const std::shared_ptr<void>& owner, std::size_t way) {
    if (has_come_ == length_) return done_({});
    if (way == 0) begin_piece();
    std::string& body = *body_;
    // Not all at once: a client that only promises a large body must not cost memory for it.
    if (has_come_ == body.size()) body.resize(std::min(length_, has_come_ + most_read_bytes));
    stream_.async_read_some(boost::asio::buffer(body.data() + has_come_, body.size() - has_come_),
                            [this, owner, way](ErrorCode fault, std::size_t bytes) {
                              has_come_ += bytes;
                              if (fault) return done_({.broken = true});
                              read_rest(owner, way_after(way + bytes));
                            });
  }

  // Only enough progress gives more time: a byte now and then does not.
  static std::size_t way_after(std::size_t way) {
    return way >= piece_bytes ? 0 : std::max<std::size_t>(way, 1);
  }

  void read_chunks(const std::shared_ptr<void>& owner, std::size_t way) {
    if (parser_->is_done()) {
      *body_ = std::move(parser_->get().body());
      return done_({});
    }
    if (way == 0) begin_piece();
    boost::beast::http::async_read_some(stream_, buffer_, *parser_,
                                        [this, owner, way](ErrorCode fault, std::size_t bytes) {
                                          on_chunks(owner, fault, way + bytes);
                                        });
  }

  void on_chunks(const std::shared_ptr<void>& owner, ErrorCode fault, std::size_t way) {
    using Error = boost::beast::http::error;
    if (fault == Error::body_limit) return done_({.refused = body_too_large(bounds_.most_bytes)});
    if (fault == Error::header_limit || fault == Error::buffer_overflow) {
      constexpr const char* too_large = "The trailer of the request is too large";
      return done_({.refused = problem(431, "TRAILER_TOO_LARGE", too_large, too_large)});
    }
    if (fault && fault.category() == make_error_code(Error::bad_chunk).category() &&
        fault != Error::partial_message && fault != Error::end_of_stream) {
      constexpr const char* malformed = "The body of the request is malformed";
      return done_({.refused = problem(400, "REQUEST_MALFORMED", malformed, malformed)});
    }
    if (fault) return done_({.broken = true});
    const std::size_t size = parser_->get().body().size();
    if (size > bounds_.held_bytes) {
      const std::size_t more = std::max(size - bounds_.held_bytes, piece_bytes);
      if (const Room room = take_memory_(more); room != Room::some)
        return done_({.refused = no_memory_for_body(room)});
      bounds_.held_bytes += more;
    }
    read_chunks(owner, way_after(way));
  }

  Stream& stream_;
  boost::beast::flat_buffer& buffer_;
  const std::chrono::seconds timeout_;
  const TakeMemory take_memory_;
  const Done done_;

  BodyParser* parser_ = nullptr;
  std::string* body_ = nullptr;
  BodyBounds bounds_{};
  std::size_t length_ = 0;  // where it is known
  std::size_t has_come_ = 0;
};

}  // namespace trc::server::http
