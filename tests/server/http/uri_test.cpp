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

TEST(RequestTarget, LosesItsFragment) {
  const auto target = read_target("GET", "/path?a=1#b=2");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->query, (Pairs{{"a", "1"}}));
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

TEST(RequestTarget, IsNoneWithABrokenEscapeOrAControlCharacter) {
  for (const char* const target : {"/a%", "/a%2", "/a%zz", "/a%0A", "/?a=%4", "/?%g0=1"})
    EXPECT_FALSE(read_target("GET", target)) << target;
  EXPECT_TRUE(read_target("GET", "/?a=%0A")) << "a value may have several lines";
}

}  // namespace
}  // namespace trc::server::http
