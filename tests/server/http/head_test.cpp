#include "server/http/head.h"

#include <gtest/gtest.h>

#include <string>

namespace trc::server::http {
namespace {

// The reason for which a request with these headers, beside that of its host, is refused.
std::string reason_against(const Pairs& headers) {
  Request request{.method = "POST", .path = "/", .headers = {{"host", "here"}}, .peer = ""};
  request.headers.insert(request.headers.end(), headers.begin(), headers.end());
  const auto fault = fault_of(request);
  return fault ? fault->reason() : "";
}

TEST(RequestHead, IsTakenWithHeadersThatAreKnown) {
  EXPECT_EQ(reason_against({}), "");
  EXPECT_EQ(reason_against({{"content-length", "12"}, {"expect", "100-Continue"}}), "");
  EXPECT_EQ(reason_against({{"transfer-encoding", "Chunked"}}), "");
  EXPECT_EQ(reason_against({{"accept", "a"}, {"accept", "b"}}), "");
}

TEST(RequestHead, IsRefusedWhereTwoReadersMightSeeTwoRequests) {
  EXPECT_EQ(reason_against({{"host", "there"}}), "HEADER_REPEATED");
  EXPECT_EQ(reason_against({{"content-length", "1"}, {"content-length", "1"}}), "HEADER_REPEATED");
  EXPECT_EQ(reason_against({{"content-length", "+1"}}), "REQUEST_MALFORMED");
  EXPECT_EQ(reason_against({{"content-length", "1, 1"}}), "REQUEST_MALFORMED");
  EXPECT_EQ(reason_against({{"transfer-encoding", "gzip, chunked"}}), "TRANSFER_ENCODING");
  EXPECT_EQ(reason_against({{"transfer-encoding", ""}}), "TRANSFER_ENCODING");
  EXPECT_EQ(reason_against({{"content-length", "1"}, {"transfer-encoding", ""}}),
            "TRANSFER_ENCODING");
  EXPECT_EQ(reason_against({{"origin", "http://here"}, {"origin", "http://there"}}),
            "HEADER_REPEATED");
}

TEST(RequestHead, IsRefusedWithAnExpectationThatIsNotMet) {
  EXPECT_EQ(reason_against({{"expect", "a miracle"}}), "EXPECTATION_FAILED");
}

TEST(RequestHead, IsRefusedWithoutAHost) {
  const auto fault = fault_of({.method = "GET", .path = "/", .peer = ""});
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->reason(), "HOST_MISSING");
}

TEST(RequestHead, BecomesARequestWithNamesInLowerCase) {
  RequestHead head;
  head.method_string("PURGE");
  head.set("X-Name", "Value");
  const Request request = request_of(head, "10.0.0.1");
  EXPECT_EQ(request.method, "PURGE");
  EXPECT_EQ(request.header("x-name"), "Value");
  EXPECT_EQ(request.peer, "10.0.0.1");
  EXPECT_FALSE(expects_continue(head));
  head.set(boost::beast::http::field::expect, "100-CONTINUE");
  EXPECT_TRUE(expects_continue(head));
}

TEST(AnswerHead, HasTheLengthOfTheBodyOrComesInChunks) {
  const Head head{.status = 200, .content_type = "text/plain", .headers = {{"Trc-Warnings", "0"}}};
  EXPECT_EQ(bytes_of(head, 5, true),
            "HTTP/1.1 200 OK\r\nTrc-Warnings: 0\r\nContent-Type: text/plain\r\n"
            "Content-Length: 5\r\n\r\n");
  const std::string chunked = bytes_of(head, {}, false);
  EXPECT_NE(chunked.find("Transfer-Encoding: chunked\r\n"), std::string::npos);
  EXPECT_NE(chunked.find("Connection: close\r\n"), std::string::npos);
  EXPECT_EQ(chunked.find("Content-Length"), std::string::npos);
}

TEST(AnswerHead, SaysNothingOfABodyWhereTheStatusAllowsNone) {
  EXPECT_EQ(bytes_of({.status = 204}, 0, true), "HTTP/1.1 204 No Content\r\n\r\n");
}

TEST(Chunk, BeginsWithItsLengthAndIsNeverTheLastOne) {
  EXPECT_EQ(chunk_of("0123456789abcdef"), "10\r\n0123456789abcdef\r\n");
  EXPECT_EQ(chunk_of(""), "");
  EXPECT_EQ(last_chunk({}), "0\r\n\r\n");
  EXPECT_EQ(last_chunk({{"Trc-Warnings", "2"}}), "0\r\nTrc-Warnings: 2\r\n\r\n");
}

}  // namespace
}  // namespace trc::server::http
