// Routes, roles and headers of the interface, with a machine that only notes the requests.
#include "clients/web/api/api.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class NotingPort : public MachinePort {
public:
    void command(const Command& command, Done done) override {
        asked.push_back("command " + std::to_string(static_cast<int>(command.kind)));
        done(Accepted{});
    }
    void jog(const JogOrder& order, Done done) override {
        asked.push_back("jog " + order.stream);
        done(Accepted{.jogging = true});
    }
    void run(ReadyProgram&&, Done done) override { done(Accepted{.job = 1}); }
    void change_values(ValuesTask::Change, Done done) override {
        asked.emplace_back("values");
        done(Accepted{});
    }
    void take_lease(Done done) override {
        asked.emplace_back("take");
        done(Accepted{});
    }
    void give_lease(Done done) override {
        asked.emplace_back("give");
        done(std::unexpected(unanswered("nobody")));
    }
    void begin_stream(bool may_operate) override { operators += may_operate ? 1 : 0; }
    void end_stream(const std::string& name, bool may_operate) override {
        asked.push_back("end " + name.substr(name.find('-')));
        operators -= may_operate ? 1 : 0;
    }
    std::shared_ptr<const Snapshot> snapshot() const override {
        return std::make_shared<const Snapshot>(snapshot_at_rest());
    }

    std::vector<std::string> asked;
    int operators = 0;
};

class Interface : public testing::Test {
protected:
    /// Sends a request with this token, or without a token if it is empty.
    Response ask(const std::string& method, const std::string& path, const std::string& body = "",
                 const std::string& token = "operate-token-0123", std::map<std::string, std::string> headers = {}) {
        headers.emplace("host", "localhost");
        if (!token.empty()) { headers.emplace("authorization", "Bearer " + token); }
        if (!body.empty()) { headers.emplace("content-type", "application/json"); }
        Response given;
        api.handle({.method = method, .path = path, .headers = std::move(headers), .body = body},
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

    MachineConfig machine = two_axes();
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
    EXPECT_EQ(ask("POST", "/api/commands/jog", R"({"jogs":[{"axis":"X","velocity":1}],"stream":"s"})").status, 200);
    EXPECT_EQ(ask("POST", "/api/commands/tool", R"({"number":1,"pocket":2})").status, 200);
    EXPECT_EQ(ask("POST", "/api/commands/give").status, 503) << "the machine's answer is the answer";
    EXPECT_THAT(port.asked, ElementsAre("take", "jog s", "values", "give"));
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
        return api.body_limit({.method = "POST", .path = path, .headers = {{"host", host}, {"authorization", token}}});
    };
    const std::size_t small = limit("/api/commands/stop", "Bearer operate-token-0123", "localhost");
    EXPECT_GT(limit("/api/program", "Bearer operate-token-0123", "localhost"), 100 * small);
    EXPECT_EQ(limit("/api/program", "Bearer view-token-0123456", "localhost"), small);
    EXPECT_EQ(limit("/api/program", "Bearer operate-token-0123", "evil.example"), small);
}

TEST_F(Interface, AStreamCountsAsAViewerUntilItEnds) {
    for (const char* token : {"view-token-0123456", "operate-token-0123"}) {
        const Response response = ask("GET", "/api/events", "", token);
        EXPECT_EQ(api.viewers(), 1u);
        EXPECT_EQ(port.operators, token[0] == 'o' ? 1 : 0);
        std::get<std::shared_ptr<ByteStream>>(response.body)->end();
        EXPECT_EQ(api.viewers(), 0u);
        EXPECT_EQ(port.operators, 0);
    }
    EXPECT_THAT(port.asked, ElementsAre("end -1", "end -2"));
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
