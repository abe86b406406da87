// One request in libmicrohttpd and its response: how a connection waits for an answer from another thread, and for the
// next bytes of a stream.
#pragma once

#include <microhttpd.h>

#include <memory>
#include <mutex>
#include <optional>

#include "clients/web/http/connection_limits.hpp"
#include "clients/web/http/message.hpp"

namespace lockstep::web {

class Exchange : public std::enable_shared_from_this<Exchange> {
public:
    /// `limits` learns what the connection waits for.
    Exchange(MHD_Connection* connection, Handler& handler, ConnectionLimits& limits)
        : connection_(connection), handler_(handler), limits_(limits) {}

    // In the server's thread:
    /// The target as it came, before libmicrohttpd decodes it.
    void note_target(const char* target) { request_.target = target; }
    /// The request line and the headers have come.
    MHD_Result begin(const char* path, const char* method, const char* version);
    bool has_begun() const { return has_begun_; }
    /// Takes a part of the body, always the whole part.
    MHD_Result take_body(const char* bytes, std::size_t* size);
    /// The request is complete, or the connection was resumed.
    MHD_Result proceed();
    /// The connection has ended.
    void end();
    ssize_t read_stream(char* into, std::size_t size);

    // In any thread:
    void answer(Response&& response);
    void wake_stream();
    /// The server ends: the connection waits no longer.
    void release();

private:
    using Waits = ConnectionLimits::Waits;
    void wait(Waits what, std::size_t bytes);
    MHD_Result give_to_handler();
    MHD_Result queue(const Response& response);
    MHD_Response* made(const Response& response);
    void resume_locked();

    MHD_Connection* connection_;
    Handler& handler_;
    ConnectionLimits& limits_;
    Request request_;
    std::size_t body_limit_bytes_ = 0;
    std::size_t received_ = 0;
    bool has_begun_ = false;
    bool is_handled_ = false;

    std::mutex mutex_;  // protects all members below
    std::optional<Response> response_;
    std::shared_ptr<ByteStream> stream_;
    bool is_suspended_ = false;
    bool is_over_ = false;
};

}  // namespace lockstep::web
