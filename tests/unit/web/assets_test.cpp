// The page's files.
#include "clients/web/api/assets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

constexpr Asset kAssets[] = {{"/index.html", "<p>", "text/html; charset=utf-8", "\"1\""},
                             {"/page.js", "f()", "text/javascript", "\"2\"", true}};

std::optional<Response> get(const std::string& path, std::map<std::string, std::string> headers = {}) {
    return asset_response(kAssets, {.method = "GET", .path = path, .headers = std::move(headers)});
}

TEST(Assets, TheRootIsThePage) {
    ASSERT_TRUE(get("/"));
    EXPECT_EQ(std::get<std::string_view>(get("/")->body), "<p>");
    EXPECT_THAT(get("/")->headers, Contains(Pair("Cache-Control", "no-cache")));
    EXPECT_THAT(get("/page.js")->headers, Contains(Pair("Cache-Control", HasSubstr("immutable"))));
    EXPECT_FALSE(get("/nothing"));
    EXPECT_FALSE(get("/../page.js"));
}

TEST(Assets, AKnownFileIsNotSentAgain) {
    EXPECT_EQ(get("/page.js", {{"if-none-match", "\"2\""}})->status, 304);
    EXPECT_EQ(get("/page.js", {{"if-none-match", "\"1\""}})->status, 200);
}

TEST(Assets, ThePolicyAllowsNoInlineCode) {
    EXPECT_THAT(get("/")->headers, Contains(Pair("Content-Security-Policy", HasSubstr("default-src 'none'"))));
    EXPECT_THAT(get("/")->headers, Not(Contains(Pair("Content-Security-Policy", HasSubstr("unsafe")))));
}

TEST(Assets, ABuildWithoutAPageStillAnswers) {
    const auto plain = asset_response({}, {.method = "GET", .path = "/"});
    ASSERT_TRUE(plain);
    EXPECT_THAT(std::get<std::string_view>(plain->body), HasSubstr("has no page"));
}

}  // namespace
}  // namespace lockstep::web
