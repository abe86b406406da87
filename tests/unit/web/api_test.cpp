// Routes, roles and headers of the interface, with a machine that only notes the requests.
#include "clients/web/api/api.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/unit/web/noting_port.hpp"

namespace lockstep::web {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Interface : public testing::Test {
protected:
    /// Sends a request with this token, or without a token if it is empty.
    Response ask(const std::string& method, const std::string& path, const std::string& body = "",
                 const std::string& token = "operate-token-0123", std::map<std::string, std::string> headers = {}) {
        headers.emplace("host", "localhost");
        if (!token.empty()) { headers.emplace("authorization", "Bearer " + token); }
        if (!body.empty()) { headers.emplace("content-type", "application/json"); }
        Response given;
        api.handle({.method = method,
                    .target = path,
                    .version = "HTTP/1.1",
                    .path = path,
                    .headers = std::move(headers),
                    .body = body},
                   [&given](Response&& response) { given = std::move(response); });
        return given;
    }
    static std::string header(const Response& response, const std::string& name) {
        for (const auto& [key, value] : response.headers) {
            if (key == name) { return value; }
        }
        return "";
    }
    static std::string code(const Response& response) {
        return Json::parse(std::get<std::string>(response.body))["code"];
    }

    MachineSetup machine = two_axes();
    NotingPort port;
    EventLog log{"run"};
    ProgramDesk desk;
    ReportFiles reports{"/nonexistent/a", "/nonexistent/b"};
    Api api{{machine, port, log, desk, reports, {}, "1.0"},
            {.tokens = {.view = "view-token-0123456", .operate = "operate-token-0123"}, .hosts = {"localhost"}}};
};

const std::vector<std::string> kWithAccess{"/api/session",      "/api/machine", "/api/state",
                                           "/api/events",       "/api/mdi",     "/api/program",
                                           "/api/program/path", "/api/reports", "/api/reports/a"};

TEST_F(Interface, NothingIsShownWithoutAToken) {
    for (const std::string& path : kWithAccess) {
        const Response response = ask("GET", path, "", "");
        EXPECT_EQ(response.status, 401) << path;
        EXPECT_EQ(header(response, "WWW-Authenticate"), "Bearer");
    }
    EXPECT_EQ(ask("POST", "/api/commands/estop", "", "").status, 401);
    EXPECT_TRUE(port.asked.empty());
}

TEST_F(Interface, AViewerOnlyLooks) {
    const std::string view = "view-token-0123456";
    EXPECT_EQ(ask("GET", "/api/state", "", view).status, 200);
    for (const std::string& verb : verbs()) {
        EXPECT_EQ(ask("POST", "/api/commands/" + verb, "", view).status, 403) << verb;
    }
    EXPECT_EQ(ask("POST", "/api/program", "G0", view).status, 403);
    EXPECT_TRUE(port.asked.empty());
}

TEST_F(Interface, AnotherPageIsRefusedBeforeItsToken) {
    EXPECT_EQ(code(ask("POST", "/api/commands/stop", "", "operate-token-0123", {{"host", "evil.example"}})),
              "foreign-host");
    EXPECT_EQ(code(ask("POST", "/api/commands/stop", "", "operate-token-0123", {{"origin", "http://evil.example"}})),
              "foreign-origin");
    EXPECT_TRUE(port.asked.empty());
}

TEST_F(Interface, CommandsReachTheMachineInTheirOrder) {
    EXPECT_EQ(ask("POST", "/api/commands/take").status, 200);
    EXPECT_EQ(ask("POST", "/api/commands/jog", R"({"jogs":[{"axis":"X","velocity":1}]})").status, 200);
    EXPECT_EQ(ask("POST", "/api/commands/tool", R"({"number":1,"pocket":2})").status, 200);
    EXPECT_EQ(ask("POST", "/api/commands/give").status, 503) << "the machine's answer is the answer";
    EXPECT_THAT(port.asked, ElementsAre("take", "jog ", "values", "give"));
}

TEST_F(Interface, AReplayedCommandIsNotCarriedOutAgain) {
    const std::map<std::string, std::string> key{{"idempotency-key", "one"}};
    EXPECT_EQ(ask("POST", "/api/commands/take", "", "operate-token-0123", key).status, 200);
    EXPECT_EQ(code(ask("POST", "/api/commands/take", "", "operate-token-0123", key)), "replayed");
    EXPECT_THAT(port.asked, ElementsAre("take"));
    for (const std::string& wrong : {std::string(), std::string(65, 'x')}) {
        EXPECT_EQ(ask("POST", "/api/commands/take", "", "operate-token-0123", {{"idempotency-key", wrong}}).status,
                  400);
    }
}

TEST_F(Interface, UnknownPathsAndMethodsAreNamed) {
    for (const char* path :
         {"/api", "/api/", "/api/commands", "/api/commands/", "/api/commands/stop/now", "/api/reports/a/b"}) {
        EXPECT_EQ(ask("POST", path).status, 404) << path;
    }
    const Response wrong = ask("DELETE", "/api/program");
    EXPECT_EQ(wrong.status, 405);
    EXPECT_EQ(header(wrong, "Allow"), "POST, GET");
    EXPECT_EQ(ask("HEAD", "/api/state").status, 200);
}

TEST_F(Interface, OnlyAnOperatorsProgramMayBeLong) {
    const auto limit = [&](const char* path, const char* token, const char* host) {
        return api
            .intake({.method = "POST",
                     .target = path,
                     .version = "HTTP/1.1",
                     .path = path,
                     .headers = {{"host", host}, {"authorization", token}}})
            .body_limit_bytes;
    };
    const std::size_t small = limit("/api/commands/stop", "Bearer operate-token-0123", "localhost");
    EXPECT_GT(limit("/api/program", "Bearer operate-token-0123", "localhost"), 100 * small);
    EXPECT_EQ(limit("/api/program", "Bearer view-token-0123456", "localhost"), small);
    EXPECT_EQ(limit("/api/program", "Bearer operate-token-0123", "evil.example"), 0U);
}

TEST_F(Interface, AStreamCountsAsAViewerUntilItEnds) {
    for (const char* token : {"view-token-0123456", "operate-token-0123"}) {
        const Response response = ask("GET", "/api/events", "", token);
        EXPECT_EQ(api.viewers(), 1u);
        std::get<std::shared_ptr<ByteStream>>(response.body)->end();
        EXPECT_EQ(api.viewers(), 0u);
    }
    EXPECT_THAT(port.asked, ElementsAre("end -1", "end -2"));
}

TEST_F(Interface, AJogMayNameOnlyAnOpenStream) {
    const Response events = ask("GET", "/api/events");
    const auto stream = std::get<std::shared_ptr<ByteStream>>(events.body);
    std::array<char, 200> first{};
    const std::string text(first.data(), stream->read(first).value());
    const std::size_t begin = text.find("{\"stream\":\"") + 11;
    const std::string name = text.substr(begin, text.find('"', begin) - begin);
    const auto jog = [&](const std::string& jogs, const std::string& to) {
        return ask("POST", "/api/commands/jog", R"({"jogs":)" + jogs + R"(,"stream":")" + to + "\"}");
    };
    const std::string press = R"([{"axis":"X","velocity":1}])";
    EXPECT_EQ(jog(press, name).status, 200) << text;
    EXPECT_EQ(code(jog(press, name + "0")), "stream-closed");
    stream->end();
    const Response closed = jog(press, name);
    EXPECT_EQ(closed.status, 409);
    EXPECT_EQ(code(closed), "stream-closed");
    EXPECT_EQ(jog("[]", name).status, 200) << "a release is never refused";
    EXPECT_THAT(port.asked, ElementsAre("jog " + name, HasSubstr("end"), "jog " + name));
}

TEST_F(Interface, WrongTokensLockTheirAddressOutOfAllButStops) {
    for (int i = 0; i < 10; ++i) { EXPECT_EQ(ask("GET", "/api/state", "", "wrong").status, 401); }
    for (const char* path : {"/api/state", "/api/session", "/api/events"}) {
        EXPECT_EQ(code(ask("GET", path)), "too-many-tokens") << path;
    }
    EXPECT_EQ(code(ask("POST", "/api/session", R"({"token":"operate-token-0123"})", "")), "too-many-tokens");
    EXPECT_EQ(code(ask("POST", "/api/commands/run")), "too-many-tokens");
    for (const char* stop : {"hold", "stop", "estop"}) {
        EXPECT_EQ(ask("POST", std::string("/api/commands/") + stop).status, 200) << stop;
        EXPECT_EQ(ask("POST", std::string("/api/commands/") + stop, "", "wrong").status, 429) << stop;
    }
    EXPECT_EQ(ask("GET", "/").status, 200) << "the page itself needs no token";
}

TEST_F(Interface, AnUnclearHeadIsRefusedBeforeItsTokenAndEndsItsConnection) {
    Request request{
        .method = "POST", .target = "/api/commands/stop", .version = "HTTP/1.1", .path = "/api/commands/stop"};
    for (const char* host : {"localhost", "evil.example"}) { request.add_header("Host", host); }
    request.add_header("Authorization", "Bearer operate-token-0123");
    EXPECT_TRUE(api.intake(request).is_refused);
    Response given;
    api.handle(std::move(request), [&given](Response&& response) { given = std::move(response); });
    EXPECT_EQ(given.status, 400);
    EXPECT_EQ(code(given), "bad-head");
    EXPECT_EQ(header(given, "Connection"), "close");
    EXPECT_TRUE(port.asked.empty());
}

TEST_F(Interface, EveryResponseTellsABrowserWhatItMayDo) {
    for (const char* path : {"/", "/api/state", "/api/nothing", "/nothing"}) {
        const Response response = ask("GET", path);
        EXPECT_EQ(header(response, "X-Content-Type-Options"), "nosniff") << path;
        EXPECT_EQ(header(response, "Referrer-Policy"), "no-referrer") << path;
        EXPECT_THAT(header(response, "Content-Security-Policy"), HasSubstr("default-src 'none'")) << path;
        EXPECT_EQ(header(response, "Access-Control-Allow-Origin"), "") << path;
    }
    EXPECT_EQ(header(ask("GET", "/api/state"), "Cache-Control"), "no-store");
}

}  // namespace
}  // namespace lockstep::web
