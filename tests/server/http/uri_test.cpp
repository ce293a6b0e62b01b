#include "server/http/uri.h"

#include <gtest/gtest.h>

namespace trc::server::http {
namespace {

TEST(RequestTarget, HasItsPathAndItsQueryDecoded) {
  const auto target = read_target("GET", "/v1/a%20b+c?name=x+y%2B&empty=&flag&&q=1%3D2");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/v1/a b+c");
  EXPECT_EQ(target->query, (Pairs{{"name", "x y+"}, {"empty", ""}, {"flag", ""}, {"q", "1=2"}}));
  EXPECT_EQ(target->host, "");
}

// A forgotten escape: what stands after it would be lost.
TEST(RequestTarget, IsNoneWithAFragment) {
  for (const char* const target : {"/path?a=part#3&b=2", "/path#", "#", "http://host/path#b"})
    EXPECT_FALSE(read_target("GET", target)) << target;
  EXPECT_EQ(read_target("GET", "/path?a=part%233")->query, (Pairs{{"a", "part#3"}}));
}

TEST(RequestTarget, MayBeAnAbsoluteUri) {
  const auto target = read_target("GET", "HTTP://[::1]:8080/path?a=1");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->scheme, "http");
  EXPECT_EQ(target->host, "[::1]:8080");
  EXPECT_EQ(target->path, "/path");
  EXPECT_EQ(read_target("GET", "http://host")->path, "/");
  EXPECT_EQ(read_target("GET", "http://host?a=1")->path, "/");
}

TEST(RequestTarget, IsTheServerItselfForOptionsAlone) {
  EXPECT_EQ(read_target("OPTIONS", "*")->path, "*");
  EXPECT_EQ(read_target("OPTIONS", "http://host")->path, "*");
  EXPECT_FALSE(read_target("GET", "*"));
}

TEST(RequestTarget, IsNoneWithoutAPathOrAnOrigin) {
  for (const char* const target :
       {"path", "://host/", "http://", "http://:80/", "http://user@host/", "http://host:80a/",
        "http://[::1/", "http://[]/"})
    EXPECT_FALSE(read_target("GET", target)) << target;
}

TEST(Authority, IsAHostAndMaybeAPort) {
  for (const char* const text : {"localhost", "localhost:80", "[::1]", "[::1]:80", "localhost:"})
    EXPECT_TRUE(is_authority(text)) << text;
  for (const char* const text : {"", "[::1", "[::1]x", "[]", ":80", "localhost:80@evil",
                                 "me@localhost", "localhost:x", "localhost/"})
    EXPECT_FALSE(is_authority(text)) << text;
}

TEST(RequestTarget, IsNoneWithABrokenEscapeOrAControlCharacter) {
  for (const char* const target : {"/a%", "/a%2", "/a%zz", "/a%0A", "/?a=%4", "/?%g0=1"})
    EXPECT_FALSE(read_target("GET", target)) << target;
  EXPECT_TRUE(read_target("GET", "/?a=%0A")) << "a value may have several lines";
}

}  // namespace
}  // namespace trc::server::http
