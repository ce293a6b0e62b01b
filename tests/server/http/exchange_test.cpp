#include "server/http/exchange.h"

#include <gtest/gtest.h>

namespace trc::server::http {
namespace {

Request with_header(const std::string& name, const std::string& value) {
  return {.method = "POST", .path = "/", .headers = {{name, value}}, .peer = ""};
}

TEST(HttpRequest, AcceptsATypeThatItNamesAndDoesNotRefuse) {
  constexpr const char* lines = "application/x-ndjson";
  EXPECT_TRUE(with_header("accept", "application/x-ndjson").accepts(lines));
  EXPECT_TRUE(with_header("accept", "text/plain, APPLICATION/X-NDJSON; q=0.5").accepts(lines));
  EXPECT_FALSE(with_header("accept", "application/x-ndjson;q=0").accepts(lines));
  EXPECT_FALSE(with_header("accept", "application/x-ndjson; q=0.000").accepts(lines));
  EXPECT_FALSE(with_header("accept", "*/*").accepts(lines)) << "a type that it does not name";
  EXPECT_FALSE(with_header("host", "here").accepts(lines));
}

TEST(HttpRequest, TellsTypeAndCharsetInLowerCase) {
  const Request request = with_header("content-type", "Text/Plain; x=y; Charset=\"UTF-8\"");
  EXPECT_EQ(request.content_type(), "text/plain");
  EXPECT_EQ(request.charset(), "utf-8");
  EXPECT_EQ(with_header("content-type", "text/plain").charset(), "");
}

TEST(HttpRequest, HasOneValueOfAHeaderThatIsSet) {
  Request request{
      .method = "GET", .path = "/", .headers = {{"a", "1"}, {"b", "2"}, {"a", "3"}}, .peer = ""};
  EXPECT_EQ(request.header("a"), "1");
  request.set_header("a", "4");
  EXPECT_EQ(request.headers, (Pairs{{"b", "2"}, {"a", "4"}}));
}

TEST(HttpRequest, GivesItsBodyAwayOnce) {
  Request request{.method = "POST", .path = "/", .body = "G1 X1", .peer = ""};
  EXPECT_EQ(*request.take_body(), "G1 X1");
  EXPECT_EQ(request.body, "");
}

TEST(ContentType, OfTextAndOfJsonAreTwoThings) {
  for (const char* const type : {"", "text/plain", "text/x-gcode", "application/octet-stream"})
    EXPECT_TRUE(is_text(type) && !is_json(type)) << type;
  for (const char* const type : {"application/json", "application/x-www-form-urlencoded"})
    EXPECT_TRUE(is_json(type) && !is_text(type)) << type;
  EXPECT_FALSE(is_text("multipart/form-data") || is_json("multipart/form-data"));
}

}  // namespace
}  // namespace trc::server::http
