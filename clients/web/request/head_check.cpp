#include "clients/web/request/head_check.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace lockstep::web {
namespace {

constexpr std::size_t kMostShown = 100;        // bytes of a client's text in an answer
constexpr std::size_t kMostLengthDigits = 12;  // of Content-Length
constexpr std::array<std::string_view, 11> kOnce{
    // the headers that this server reads
    "authorization", "connection",      "content-length", "content-type", "cookie",           "expect",
    "host",          "idempotency-key", "last-event-id",  "origin",       "transfer-encoding"};

Problem bad_head(const std::string& place, const std::string& value, const std::string& what,
                 const std::string& limit) {
    const std::string start = value.substr(0, kMostShown);
    return {.status = 400,
            .code = "bad-head",
            .title = "the head of the request is not clear",
            .detail = place + (start.empty() ? " " : " '" + start + "' ") + what,
            .place = place,
            .value = start,
            .limit = limit,
            .remedy = "send one request as HTTP/1.1 defines it (RFC 9112)"};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool is_control(char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F; }

/// A character of a header's name (RFC 9110, 5.6.2).
bool is_token(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("!#$%&'*+-.^_`|~").contains(c);
}

/// Every % begins two hexadecimal digits that do not stand for a control character.
bool is_escaped_well(std::string_view target) {
    for (std::size_t i = target.find('%'); i != target.npos; i = target.find('%', i + 3)) {
        if (i + 2 >= target.size() || !is_hex(target[i + 1]) || !is_hex(target[i + 2])) { return false; }
        if (target[i + 1] < '2' || target.substr(i, 3) == "%7f" || target.substr(i, 3) == "%7F") { return false; }
    }
    return true;
}

std::optional<Problem> refuse_request_line(const Request& request) {
    if (request.version != "HTTP/1.1" && request.version != "HTTP/1.0") {
        Problem problem = bad_head("version", request.version, "is not served", "HTTP/1.1");
        problem.status = 505;
        return problem;
    }
    if (request.method.empty() || !std::ranges::all_of(request.method, is_token)) {
        return bad_head("method", request.method, "is not a method", "letters, such as GET");
    }
    const auto is_plain = [](char c) { return c > ' ' && c < 0x7F && c != '#'; };
    if (!request.target.starts_with('/') || !std::ranges::all_of(request.target, is_plain) ||
        !is_escaped_well(request.target)) {
        return bad_head("target", request.target, "is not a path of this server",
                        "a path that begins with /, in ASCII, with %XX for any other character");
    }
    return std::nullopt;
}

/// The length of the body must be stated once, and in one way.
std::optional<Problem> refuse_length(const Request& request) {
    const std::string* length = request.header("content-length");
    const std::string* coding = request.header("transfer-encoding");
    if (length != nullptr && coding != nullptr) {
        return bad_head("content-length", *length, "comes with a Transfer-Encoding", "one of the two");
    }
    if (length != nullptr &&
        (length->empty() || length->size() > kMostLengthDigits || !std::ranges::all_of(*length, is_digit))) {
        return bad_head("content-length", *length, "is not a length", "1 to 12 digits");
    }
    if (coding == nullptr) { return std::nullopt; }
    if (request.version != "HTTP/1.1" || lower_case(*coding) != "chunked") {
        return bad_head("transfer-encoding", *coding, "is not served", "chunked, with HTTP/1.1");
    }
    return std::nullopt;
}

}  // namespace

std::optional<Problem> refuse_head(const Request& request) {
    if (auto problem = refuse_request_line(request)) { return problem; }
    if (!request.has_plain_lines) {
        return bad_head("headers", "", "have a line that is folded, has a zero, or does not end with CR LF",
                        "one line for each header, with CR LF at its end");
    }
    for (const auto& [name, value] : request.headers) {
        if (name.empty() || !std::ranges::all_of(name, is_token)) {
            return bad_head("header", name, "is not a header's name", "letters, digits and hyphens");
        }
        if (std::ranges::any_of(value, is_control)) {
            return bad_head(name, value, "contains a control character", "visible characters and spaces");
        }
    }
    for (const std::string_view name : kOnce) {
        if (request.repeated.contains(std::string(name))) {
            return bad_head(std::string(name), "", "came more than once", "once");
        }
    }
    return refuse_length(request);
}

}  // namespace lockstep::web
