// Headers and cookies of a request.
#include "clients/web/http/message.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

TEST(Message, FindsACookieAmongOthers) {
    const Request request{.method = "GET", .path = "/", .headers = {{"cookie", "a=1;  b = 2; c=x=y; b2=3;d; =4"}}};
    EXPECT_EQ(request.cookie("a"), "1");
    EXPECT_EQ(request.cookie("c"), "x=y");
    EXPECT_EQ(request.cookie("b2"), "3");
    EXPECT_EQ(request.cookie("d"), std::nullopt);
    EXPECT_EQ(request.cookie("e"), std::nullopt);
    EXPECT_EQ(Request{}.cookie("a"), std::nullopt);
}

}  // namespace
}  // namespace lockstep::web
