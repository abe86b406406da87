// Heads of requests that can be read in more than one way are refused.
#include "clients/web/request/head_check.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using Headers = std::vector<std::pair<std::string, std::string>>;

Request request_of(const Headers& headers) {
    Request request{.method = "POST", .target = "/api/commands/stop", .version = "HTTP/1.1"};
    request.add_header("Host", "localhost");
    for (const auto& [name, value] : headers) { request.add_header(name, value); }
    return request;
}

/// The place of the refusal; empty if the request is accepted.
std::string place(const Request& request) {
    const auto problem = refuse_head(request);
    if (problem) { EXPECT_FALSE(problem->detail.empty() || problem->limit.empty() || problem->remedy.empty()); }
    return problem ? problem->place : "";
}

TEST(HeadCheck, AcceptsWhatBrowsersAndScriptsSend) {
    EXPECT_EQ(place(request_of({})), "");
    EXPECT_EQ(place(request_of({{"Content-Length", "12"}, {"Accept", "*/*"}, {"Accept", "text/html"}})), "");
    EXPECT_EQ(place(request_of({{"Transfer-Encoding", "Chunked"}, {"User-Agent", "a\tb \xc3\xa9"}})), "");
    for (const char* target : {"/", "/api/program?name=a%20b.gcode&x=%C3%A9", "/../../etc/passwd", "/?", "/a//b"}) {
        Request request = request_of({});
        request.target = target;
        EXPECT_EQ(place(request), "") << target;
    }
    Request old = request_of({});
    old.version = "HTTP/1.0";
    EXPECT_EQ(place(old), "");
}

TEST(HeadCheck, RefusesAHeaderThatItReadsIfItComesTwice) {
    for (const char* name : {"Host", "HOST", "Content-Length", "Transfer-Encoding", "Authorization", "Cookie", "Origin",
                             "Content-Type", "Idempotency-Key", "Last-Event-ID", "Expect", "Connection"}) {
        EXPECT_EQ(place(request_of({{name, "1"}, {name, "1"}})), lower_case(name)) << "even with the same value";
    }
}

TEST(HeadCheck, RefusesContradictingLengths) {
    EXPECT_EQ(place(request_of({{"Content-Length", "4"}, {"Transfer-Encoding", "chunked"}})), "content-length");
    for (const char* length : {"", "-1", "+4", "4,4", "4, 5", "0x4", "4 ", " 4", "4;", "4.0", "1e3", "1234567890123"}) {
        EXPECT_EQ(place(request_of({{"Content-Length", length}})), "content-length") << length;
    }
    for (const char* coding : {"", "gzip", "chunked, chunked", "gzip, chunked", "chunked;q=1", "identity", " chunked",
                               "chunked\v", "xchunked"}) {
        EXPECT_EQ(place(request_of({{"Transfer-Encoding", coding}})), "transfer-encoding") << coding;
    }
    Request old = request_of({{"Transfer-Encoding", "chunked"}});
    old.version = "HTTP/1.0";
    EXPECT_EQ(place(old), "transfer-encoding");
}

TEST(HeadCheck, RefusesTargetsThatAreNoPath) {
    for (const char* target :
         {"", "*", "http://localhost/api/state", "//\x01", "api/state", "localhost:2302", "/a b", "/a#b", "/%", "/%4",
          "/%zz", "/%00", "/a%0d%0aSet-Cookie:x", "/%1f", "/%7F", "/\xc3\xa9", "/\x7f"}) {
        Request request = request_of({});
        request.target = target;
        EXPECT_EQ(place(request), "target") << target;
    }
}

TEST(HeadCheck, RefusesOtherVersionsAndMethodsThatAreNone) {
    for (const char* version : {"", "HTTP/1.2", "HTTP/2", "HTTP/0.9", "http/1.1", "HTTP/1.1 x", "HTTP/1.10"}) {
        Request request = request_of({});
        request.version = version;
        ASSERT_EQ(place(request), "version") << version;
        EXPECT_EQ(refuse_head(request)->status, 505);
    }
    for (const char* method : {"", "GE T", "G\x01T", "GET:", "{}"}) {
        Request request = request_of({});
        request.method = method;
        EXPECT_EQ(place(request), "method") << method;
    }
}

TEST(HeadCheck, RefusesNamesThatAreNoneAndControlCharacters) {
    for (const char* name : {"", "Host ", "X Y", "X\x01", "X\xc3\xa9", "X(Y)", "X\tY"}) {
        EXPECT_EQ(place(request_of({{name, "1"}})), "header") << name;
    }
    for (const char* value : {"a\rb", "a\nb", "a\x01", "\x7f", "a\x1b[2J"}) {
        EXPECT_EQ(place(request_of({{"X-Any", value}})), "x-any") << value;
    }
}

TEST(HeadCheck, AnswersWithAShortText) {
    const auto problem = refuse_head(request_of({{"Content-Length", std::string(30000, 'x')}}));
    ASSERT_TRUE(problem);
    EXPECT_LT(dumped(problem_json(*problem)).size(), 1000U);
}

}  // namespace
}  // namespace lockstep::web
