// A request of HTTP and its response, as plain values.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lockstep::web {

struct Request {
    std::string method;
    std::string path;                            // decoded, without the query
    std::map<std::string, std::string> query;    // decoded; the last value of a repeated name
    std::map<std::string, std::string> headers;  // names in lower case; the first value of a repeated name
    std::string body;
    bool is_too_long = false;  // the body exceeded its limit and was not kept

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

/// Handles a server's requests. Both functions are called in the server's thread and must return at once.
class Handler {
public:
    virtual ~Handler() = default;
    /// Returns how many bytes of the request's body are kept.
    virtual std::size_t body_limit(const Request& head) const = 0;
    virtual void handle(Request&& request, const Answer& answer) = 0;
};

}  // namespace lockstep::web
