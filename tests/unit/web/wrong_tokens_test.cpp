// Addresses that send too many wrong tokens are locked for a while, each on its own.
#include "clients/web/api/wrong_tokens.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

TEST(WrongTokens, LockOnlyTheAddressThatSentThem) {
    WrongTokens tokens;
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) {
        EXPECT_FALSE(tokens.is_locked("a", 1s)) << i;
        tokens.note("a", 1s);
    }
    EXPECT_TRUE(tokens.is_locked("a", 1s));
    EXPECT_FALSE(tokens.is_locked("b", 1s));
}

TEST(WrongTokens, CountOnlyThoseOfTheLastMinute) {
    WrongTokens tokens;
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) { tokens.note("a", i * 10s); }
    EXPECT_FALSE(tokens.is_locked("a", 91s)) << "the first is 91 s old";
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) { tokens.note("a", 100s); }
    EXPECT_TRUE(tokens.is_locked("a", 160s));
    EXPECT_FALSE(tokens.is_locked("a", 161s));
}

TEST(WrongTokens, RememberABoundedNumberOfAddresses) {
    WrongTokens tokens;
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) { tokens.note("old", 1s); }
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) { tokens.note("new", 2s); }
    for (std::size_t i = 0; i + 1 < WrongTokens::kMostAddresses; ++i) { tokens.note(std::to_string(i), 3s); }
    EXPECT_FALSE(tokens.is_locked("old", 3s)) << "the address that was silent longest is forgotten";
    EXPECT_TRUE(tokens.is_locked("new", 3s));
}

}  // namespace
}  // namespace lockstep::web
