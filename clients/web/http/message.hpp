// A request of HTTP and its response, as plain values.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lockstep::web {

/// ASCII letters only.
std::string lower_case(std::string_view text);

struct Request {
    std::string method;
    std::string target;                          // the path and the query, as they came
    std::string version;                         // such as HTTP/1.1
    std::string path;                            // decoded, without the query
    std::map<std::string, std::string> query;    // decoded; the last value of a repeated name
    std::map<std::string, std::string> headers;  // names in lower case; the first value of a repeated name
    std::set<std::string> repeated;              // the names of headers that came more than once
    bool has_plain_lines = true;                 // each header has one line that ends with CR LF, without a zero
    std::string peer;                            // the address of the other side, as peer_address() returns it
    std::string body;
    bool is_too_long = false;  // the body exceeded its limit and was not kept

    void add_header(std::string_view name, std::string_view value);

    /// Returns null if the request has none.
    const std::string* header(std::string_view name) const;
    std::optional<std::string> cookie(std::string_view name) const;
};

/// A body that is made while it is sent. Every call comes from the server's thread.
class ByteStream {
public:
    virtual ~ByteStream() = default;
    /// Writes the next bytes and returns their number, 0 if there are none now. Returns nullopt if the stream is over.
    virtual std::optional<std::size_t> read(std::span<char> into) = 0;
    /// True if the reader is so far behind that the connection must be closed.
    virtual bool is_behind() const = 0;
    /// The connection has ended.
    virtual void end() = 0;
};

using SharedText = std::shared_ptr<const std::string>;

struct Response {
    int status = 200;
    /// A string_view's characters live as long as the process.
    std::variant<std::string, std::string_view, SharedText, std::shared_ptr<ByteStream>> body;
    std::vector<std::pair<std::string, std::string>> headers;
};

/// Gives a request's response. Call it once, at any time, from any thread. It has no effect after the connection has
/// ended.
using Answer = std::function<void(Response&& response)>;

/// How a server takes a request, decided when its head has come.
struct Intake {
    std::size_t body_limit_bytes = 0;  // more are not kept
    bool is_signed_in = false;         // the request has a valid token
    bool is_refused = false;  // it is handled at once, without its body, and its connection ends with the answer
};

/// Handles a server's requests. All functions are called in the server's thread and must return at once.
class Handler {
public:
    virtual ~Handler() = default;
    virtual Intake intake(const Request& head) const = 0;
    virtual void handle(Request&& request, const Answer& answer) = 0;
};

}  // namespace lockstep::web
