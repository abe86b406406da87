#include "clients/web/http/server.hpp"

#include <microhttpd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <set>
#include <vector>

#include "clients/channel/peer.hpp"
#include "clients/web/http/exchange.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

/// libmicrohttpd notices it and ends the connection in its own thread.
void close_soon(ConnectionLimits::Id connection) {
    auto* const own = static_cast<MHD_Connection*>(const_cast<void*>(connection));
    const auto* info = MHD_get_connection_info(own, MHD_CONNECTION_INFO_CONNECTION_FD);
    if (info != nullptr) { (void)shutdown(info->connect_fd, SHUT_RDWR); }
}

std::string address_of(MHD_Connection* connection) {
    const auto* info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
    return info == nullptr ? "" : peer_address(info->client_addr);
}

using Kept = std::shared_ptr<Exchange>;

}  // namespace

struct Server::Parts {
    explicit Parts(Handler& to_serve) : handler(to_serve) {}

    /// Returns a copy, because an exchange may end meanwhile.
    std::vector<std::shared_ptr<Exchange>> all() {
        const std::lock_guard lock(mutex);
        return {exchanges.begin(), exchanges.end()};
    }
    /// Returns null if the server is ending.
    std::shared_ptr<Exchange> add(MHD_Connection* connection) {
        const std::lock_guard lock(mutex);
        return ends ? nullptr : *exchanges.insert(std::make_shared<Exchange>(connection, handler, limits)).first;
    }

    // libmicrohttpd's calls. It keeps an owned pointer to the exchange for each request.
    static void notify(void* parts, MHD_Connection* connection, void**, MHD_ConnectionNotificationCode code);
    static void* begin(void* parts, const char* target, MHD_Connection* connection);
    static MHD_Result access(void* parts, MHD_Connection*, const char* path, const char* method, const char* version,
                             const char* body, std::size_t* size, void** kept);
    static void complete(void* parts, MHD_Connection*, void** kept, MHD_RequestTerminationCode);

    Handler& handler;
    ConnectionLimits limits{&close_soon};
    MHD_Daemon* daemon = nullptr;
    std::mutex mutex;  // protects the members below
    std::set<std::shared_ptr<Exchange>> exchanges;
    bool ends = false;
};

void Server::Parts::notify(void* parts, MHD_Connection* connection, void**, MHD_ConnectionNotificationCode code) {
    ConnectionLimits& limits = static_cast<Parts*>(parts)->limits;
    if (code == MHD_CONNECTION_NOTIFY_CLOSED) { return limits.forget(connection); }
    limits.begin(connection, address_of(connection), monotonic_now());
}

/// The first call for a request. Returns what is kept for it.
void* Server::Parts::begin(void* parts, const char* target, MHD_Connection* connection) {
    const auto made = static_cast<Parts*>(parts)->add(connection);
    if (made == nullptr) { return nullptr; }
    made->note_target(target);
    return new Kept(made);
}

MHD_Result Server::Parts::access(void*, MHD_Connection*, const char* path, const char* method, const char* version,
                                 const char* body, std::size_t* size, void** kept) {
    if (*kept == nullptr) { return MHD_NO; }
    Exchange& exchange = **static_cast<Kept*>(*kept);
    if (!exchange.has_begun()) { return exchange.begin(path, method, version); }
    return *size > 0 ? exchange.take_body(body, size) : exchange.proceed();
}

void Server::Parts::complete(void* parts, MHD_Connection*, void** kept, MHD_RequestTerminationCode) {
    if (*kept == nullptr) { return; }
    const std::unique_ptr<Kept> exchange(static_cast<Kept*>(*kept));
    *kept = nullptr;
    (*exchange)->end();
    auto& to = *static_cast<Parts*>(parts);
    const std::lock_guard lock(to.mutex);
    to.exchanges.erase(*exchange);
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

std::expected<std::unique_ptr<Server>, std::string> Server::start(const Listener& listener, const TlsFiles& tls,
                                                                  Handler& handler) {
    auto parts = std::make_unique<Parts>(handler);
    unsigned flags = MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ITC;
    std::vector<MHD_OptionItem> options;
    if (tls.is_used()) {
        flags |= MHD_USE_TLS;
        options.push_back({MHD_OPTION_HTTPS_MEM_KEY, 0, const_cast<char*>(tls.key.c_str())});
        options.push_back({MHD_OPTION_HTTPS_MEM_CERT, 0, const_cast<char*>(tls.certificate.c_str())});
    }
    options.push_back({MHD_OPTION_END, 0, nullptr});
    parts->daemon = MHD_start_daemon(
        flags, 0, nullptr, nullptr, Parts::access, parts.get(), MHD_OPTION_LISTEN_SOCKET, listener.socket,
        MHD_OPTION_NOTIFY_CONNECTION, Parts::notify, parts.get(), MHD_OPTION_URI_LOG_CALLBACK, Parts::begin,
        parts.get(), MHD_OPTION_NOTIFY_COMPLETED, Parts::complete, parts.get(), MHD_OPTION_CONNECTION_LIMIT,
        kMaxConnections, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_ARRAY, options.data(), MHD_OPTION_END);
    if (parts->daemon == nullptr) {
        close(listener.socket);
        return std::unexpected(tls.is_used() ? "HTTPS cannot be served: the certificate or its key is not valid PEM, "
                                               "or they do not belong together"
                                             : "HTTP cannot be served: no thread or no memory is left");
    }
    return std::unique_ptr<Server>(new Server(std::move(parts)));
}

Server::~Server() {
    {
        const std::lock_guard lock(parts_->mutex);
        parts_->ends = true;
    }
    for (const auto& exchange : parts_->all()) { exchange->release(); }
    MHD_stop_daemon(parts_->daemon);
}

void Server::wake_streams() {
    parts_->limits.close_late(monotonic_now());
    for (const auto& exchange : parts_->all()) { exchange->wake_stream(); }
}

}  // namespace lockstep::web
