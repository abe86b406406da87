// The roles that tokens and cookies give, and refused hosts and origins.
#include "clients/web/api/access.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

AccessRules rules() {
    return {.tokens = {.view = "view-token-0123456", .operate = "operate-token-0123"},
            .hosts = {"localhost", "127.0.0.1", "::1"},
            .port = 2302};
}

Request request_with(std::map<std::string, std::string> headers) {
    headers.emplace("host", "localhost:2302");
    return {.method = "GET", .path = "/api/state", .headers = std::move(headers)};
}

std::string cookie_of(const std::string& header) { return header.substr(0, header.find(';')); }

std::string refusal(const Access& access, std::map<std::string, std::string> headers) {
    const auto problem = access.refuse_foreign(request_with(std::move(headers)));
    return problem ? problem->code : "";
}

TEST(Access, ATokenGivesItsRole) {
    const Access access(rules());
    EXPECT_EQ(access.role_of(request_with({{"authorization", "Bearer operate-token-0123"}}), 1s), Role::Operate);
    EXPECT_EQ(access.role_of(request_with({{"authorization", "Bearer view-token-0123456"}}), 1s), Role::View);
}

TEST(Access, WithoutATokenThereIsNoRole) {
    const Access access(rules());
    for (const char* wrong : {"", "Bearer", "Bearer ", "Bearer operate-token-012", "Bearer operate-token-01234",
                              "Basic operate-token-0123", "bearer operate-token-0123"}) {
        EXPECT_EQ(access.role_of(request_with({{"authorization", wrong}}), 1s), std::nullopt) << wrong;
    }
    EXPECT_EQ(access.role_of(request_with({}), 1s), std::nullopt);
}

TEST(Access, ACookieStandsForATokenWithoutContainingIt) {
    const Access access(rules());
    for (const Role role : {Role::View, Role::Operate}) {
        const std::string header = access.cookie_for(role);
        EXPECT_EQ(access.role_of(request_with({{"cookie", "a=b; " + cookie_of(header)}}), 1s), role);
        EXPECT_NE(header.find("; HttpOnly; SameSite=Strict"), std::string::npos) << header;
        EXPECT_EQ(header.find("token"), std::string::npos) << header;
    }
    EXPECT_NE(access.removed_cookie().find("Max-Age=0"), std::string::npos);
}

TEST(Access, AWrongAuthorizationIsNotMendedByACookie) {
    const Access access(rules());
    const std::string cookie = cookie_of(access.cookie_for(Role::Operate));
    EXPECT_EQ(access.role_of(request_with({{"authorization", "Bearer wrong"}, {"cookie", cookie}}), 1s), std::nullopt);
}

TEST(Access, ACookieIsOfItsPortAndToken) {
    AccessRules other = rules();
    other.port = 2303;
    const std::string cookie = cookie_of(Access(other).cookie_for(Role::Operate));
    EXPECT_EQ(Access(rules()).role_of(request_with({{"cookie", cookie}}), 1s), std::nullopt);
    other = rules();
    other.tokens.operate = "another-token-0123";
    EXPECT_EQ(
        Access(other).role_of(request_with({{"cookie", cookie_of(Access(rules()).cookie_for(Role::Operate))}}), 1s),
        std::nullopt);
}

TEST(Access, OnlyWithTlsACookieIsSecure) {
    EXPECT_EQ(Access(rules()).cookie_for(Role::View).find("Secure"), std::string::npos);
    AccessRules with_tls = rules();
    with_tls.is_tls = true;
    EXPECT_NE(Access(with_tls).cookie_for(Role::View).find("; Secure"), std::string::npos);
}

TEST(Access, RefusesAForeignHost) {
    const Access access(rules());
    for (const char* host : {"evil.example",
                             "localhost.evil.example:2302",
                             "127.0.0.2",
                             "",
                             "[::2]:2302",
                             "[::1",
                             "127.0.0.1:2302.evil.example",
                             "127.0.0.1:2302@evil.example",
                             "127.0.0.1@evil.example",
                             "evil.example@127.0.0.1",
                             "127.0.0.1:",
                             "127.0.0.1:x",
                             "127.0.0.1:0",
                             "127.0.0.1:65536",
                             "127.0.0.1:+80",
                             "127.0.0.1:80:80",
                             "[::1].evil.example",
                             "[::1]evil.example:80",
                             "[::1]:80.evil.example",
                             "[]",
                             "[]:80",
                             ":2302",
                             "localhost.",
                             "localhost ",
                             "localhost,localhost",
                             "localhost/",
                             "127.1",
                             "2130706433",
                             "0x7f.1",
                             "::1"}) {
        EXPECT_EQ(refusal(access, {{"host", host}}), "foreign-host") << host;
    }
    for (const char* host : {"localhost", "localhost:2302", "LocalHost:2302", "localhost:65535", "127.0.0.1:2302",
                             "[::1]:2302", "[::1]"}) {
        EXPECT_EQ(refusal(access, {{"host", host}}), "") << host;
    }
    EXPECT_TRUE(access.refuse_foreign({.method = "GET", .path = "/"})) << "a request without a Host header";
}

TEST(Access, RefusesAForeignOrigin) {
    const Access access(rules());
    for (const char* origin : {"null", "http://evil.example", "https://localhost:2302", "http://localhost",
                               "http://localhost:2303", "http://127.0.0.1:2302"}) {
        EXPECT_EQ(refusal(access, {{"origin", origin}}), "foreign-origin") << origin;
    }
    EXPECT_EQ(refusal(access, {{"origin", "http://localhost:2302"}}), "");
    AccessRules with_tls = rules();
    with_tls.is_tls = true;
    EXPECT_EQ(refusal(Access(with_tls), {{"origin", "https://localhost:2302"}}), "");
}

constexpr const char* kPeer = "192.0.2.1";

Request from(const char* peer, std::map<std::string, std::string> headers) {
    Request request = request_with(std::move(headers));
    request.peer = peer;
    return request;
}

Request with_token(const char* peer, const std::string& token) {
    return from(peer, {{"authorization", "Bearer " + token}});
}

int status(const std::expected<Role, Problem>& admitted) { return admitted ? 200 : admitted.error().status; }

TEST(Access, TooManyWrongTokensBlockRequestsForAMinute) {
    Access access(rules());
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) {
        EXPECT_EQ(access.try_token("wrong", kPeer, 1s).error().status, 401);
    }
    EXPECT_EQ(access.try_token("wrong", kPeer, 2s).error().status, 429);
    EXPECT_EQ(access.try_token("operate-token-0123", kPeer, 2s).error().status, 429) << "also for the right one";
    EXPECT_EQ(access.try_token("operate-token-0123", kPeer, 62s), Role::Operate);
}

TEST(Access, CountsEveryWayToGiveAWrongTokenTogether) {
    Access access(rules());
    const std::string cookie = cookie_of(access.cookie_for(Role::Operate));
    const std::string wrong_cookie = cookie.substr(0, cookie.find('=') + 1) + "wrong";
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) {
        if (i % 3 == 0) {
            EXPECT_EQ(status(access.admit(with_token(kPeer, "wrong"), false, 1s)), 401);
        } else if (i % 3 == 1) {
            EXPECT_EQ(status(access.admit(from(kPeer, {{"cookie", wrong_cookie}}), false, 1s)), 401);
        } else {
            EXPECT_EQ(status(access.try_token("wrong", kPeer, 1s)), 401);
        }
    }
    EXPECT_EQ(status(access.admit(with_token(kPeer, "operate-token-0123"), false, 2s)), 429);
    EXPECT_EQ(access.role_of(with_token(kPeer, "operate-token-0123"), 2s), std::nullopt);
    EXPECT_EQ(status(access.admit(from(kPeer, {{"cookie", wrong_cookie}}), false, 2s)), 429);
    EXPECT_EQ(status(access.try_token("operate-token-0123", kPeer, 2s)), 429);
    EXPECT_EQ(status(access.admit(with_token(kPeer, "operate-token-0123"), false, 62s)), 200);
}

TEST(Access, ARequestWithoutATokenIsNotCounted) {
    Access access(rules());
    for (int i = 0; i < 100; ++i) { EXPECT_EQ(status(access.admit(from(kPeer, {}), false, 1s)), 401); }
    EXPECT_EQ(status(access.admit(with_token(kPeer, "view-token-0123456"), false, 1s)), 200);
}

TEST(Access, ALockedAddressLocksNoOther) {
    Access access(rules());
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) { (void)access.try_token("wrong", kPeer, 1s); }
    EXPECT_EQ(status(access.try_token("operate-token-0123", "192.0.2.2", 2s)), 200);
    EXPECT_EQ(status(access.admit(with_token("127.0.0.1", "operate-token-0123"), false, 2s)), 200);
}

TEST(Access, AStopAndASignedInPageAreNeverLockedOut) {
    Access access(rules());
    const std::string cookie = cookie_of(access.cookie_for(Role::Operate));
    for (std::size_t i = 0; i < WrongTokens::kMost; ++i) { (void)access.try_token("wrong", kPeer, 1s); }
    EXPECT_EQ(status(access.admit(with_token(kPeer, "operate-token-0123"), true, 2s)), 200);
    EXPECT_EQ(status(access.admit(with_token(kPeer, "wrong"), true, 2s)), 429);
    EXPECT_EQ(status(access.admit(from(kPeer, {{"cookie", cookie}}), false, 2s)), 200);
}

}  // namespace
}  // namespace lockstep::web
