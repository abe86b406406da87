// The input is the head of a request, a line for each header. Either it is refused with texts, or it can be read in one
// way only: an independent reading of the same lines finds one own host, one length, and a path.
#include <algorithm>
#include <cstdint>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "clients/web/api/access.hpp"
#include "clients/web/request/head_check.hpp"
#include "tests/fuzz/require.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kLongestRefusal_bytes = 2048;

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        lines.emplace_back(text.substr(0, end));
        text = end == text.npos ? std::string_view{} : text.substr(end + 1);
    }
    return lines;
}

Request request_of(const std::vector<std::string>& lines) {
    Request request;
    if (lines.empty()) { return request; }
    const std::size_t first = lines[0].find(' ');
    const std::size_t last = lines[0].rfind(' ');
    request.method = lines[0].substr(0, first);
    request.version = last == std::string::npos ? "" : lines[0].substr(last + 1);
    if (first < last) { request.target = lines[0].substr(first + 1, last - first - 1); }
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::size_t colon = lines[i].find(": ");
        if (colon != std::string::npos) { request.add_header(lines[i].substr(0, colon), lines[i].substr(colon + 2)); }
    }
    return request;
}

std::size_t count(const std::vector<std::string>& lines, const char* pattern) {
    const std::regex whole(pattern, std::regex::icase);
    return static_cast<std::size_t>(
        std::ranges::count_if(lines, [&](const std::string& line) { return std::regex_match(line, whole); }));
}

void check(const Problem& problem) {
    require(!problem.code.empty() && !problem.detail.empty() && !problem.limit.empty() && !problem.remedy.empty(),
            "a refusal has its texts");
    const std::string text = dumped(problem_json(problem));
    require(Json::accept(text) && text.size() <= kLongestRefusal_bytes, "a refusal is JSON, and short");
}

void check_accepted(const std::vector<std::string>& lines) {
    require(std::regex_match(lines[0],
                             std::regex(R"([^ ]+ /([!-"$&-~]|%[2-9a-f][0-9a-f])* HTTP/1\.[01])", std::regex::icase)),
            "the target is a path in visible ASCII");
    require(count(lines, R"(host: [^]*)") == 1, "one host");
    require(count(lines, R"(host: (localhost|127\.0\.0\.1|\[::1\])(:[0-9]{1,})?)") == 1, "the host is this one");
    const std::size_t lengths = count(lines, R"(content-length: [^]*)");
    require(lengths <= 1 && count(lines, R"(content-length: [0-9]+)") == lengths, "at most one length, a number");
    const std::size_t codings = count(lines, R"(transfer-encoding: [^]*)");
    require(lengths + codings <= 1 && count(lines, R"(transfer-encoding: chunked)") == codings, "one kind of length");
    require(count(lines, R"(authorization: [^]*)") <= 1 && count(lines, R"(cookie: [^]*)") <= 1, "one proof");
    require(count(lines, R"(origin: [^]*)") <= 1, "at most one origin");
}

}  // namespace
}  // namespace lockstep::web

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep::web;
    static const Access access({.tokens = {.view = "view-token-0123456", .operate = "operate-token-0123"},
                                .hosts = {"localhost", "127.0.0.1", "::1"},
                                .port = 2302});
    const auto lines = lines_of({reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 2000)});
    const Request request = request_of(lines);
    auto problem = refuse_head(request);
    if (!problem) { problem = access.refuse_foreign(request); }
    if (problem) {
        check(*problem);
    } else {
        check_accepted(lines);
    }
    return 0;
}
