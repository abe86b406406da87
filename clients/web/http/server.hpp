// The HTTP server: libmicrohttpd with one thread, which serves every connection and every open stream.
#pragma once

#include <expected>
#include <memory>
#include <string>

#include "clients/channel/listener.hpp"
#include "clients/web/http/connection_limits.hpp"
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
    /// ConnectionLimits closes connections before the library would refuse new ones: these are that many more.
    static constexpr unsigned kMaxConnections = ConnectionLimits::kMostUnknown + ConnectionLimits::kMostSignedIn + 128;
    static constexpr std::size_t kMostDiscarded = 256U * 1024 * 1024;  // of a body beyond its limit, before its answer

    /// Serves until the object is destroyed. `handler` must outlive it. The error says why it cannot serve.
    static std::expected<std::unique_ptr<Server>, std::string> start(const Listener& listener, const TlsFiles& tls,
                                                                     Handler& handler);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Lets every stream read again, and closes the connections of those that are behind, and those whose time is over.
    /// Call it several times a second, from any thread.
    void wake_streams();

private:
    struct Parts;
    explicit Server(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace lockstep::web
