// The HTTP server: libmicrohttpd with one thread, which serves every connection and every open stream.
#pragma once

#include <expected>
#include <memory>
#include <string>

#include "clients/channel/listener.hpp"
#include "clients/web/http/message.hpp"

namespace lockstep::web {

/// PEM texts; both are empty without TLS.
struct TlsFiles {
    std::string certificate;
    std::string key;
    bool is_used() const { return !certificate.empty(); }
};

class Server {
public:
    static constexpr unsigned kMaxConnections = 256;
    static constexpr unsigned kIdleSeconds = 20;                       // after them a connection is closed
    static constexpr std::size_t kMostDiscarded = 256U * 1024 * 1024;  // of a body beyond its limit, before its answer

    /// Serves until the object is destroyed. `handler` must outlive it. The error says why it cannot serve.
    static std::expected<std::unique_ptr<Server>, std::string> start(const Listener& listener, const TlsFiles& tls,
                                                                     Handler& handler);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Lets every stream read again, and closes the connections of those that are behind. May be called from any
    /// thread.
    void wake_streams();

private:
    struct Parts;
    explicit Server(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace lockstep::web
