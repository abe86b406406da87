#include "clients/web/http/server.hpp"

#include <microhttpd.h>
#include <unistd.h>

#include <set>
#include <vector>

#include "clients/web/http/exchange.hpp"

namespace lockstep::web {

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
        return ends ? nullptr : *exchanges.insert(std::make_shared<Exchange>(connection, handler)).first;
    }

    // libmicrohttpd's calls. It keeps an owned pointer to the exchange for each request.
    static MHD_Result access(void* parts, MHD_Connection* connection, const char* path, const char* method, const char*,
                             const char* body, std::size_t* size, void** kept);
    static void complete(void* parts, MHD_Connection*, void** kept, MHD_RequestTerminationCode);

    Handler& handler;
    MHD_Daemon* daemon = nullptr;
    std::mutex mutex;  // protects the members below
    std::set<std::shared_ptr<Exchange>> exchanges;
    bool ends = false;
};

MHD_Result Server::Parts::access(void* parts, MHD_Connection* connection, const char* path, const char* method,
                                 const char*, const char* body, std::size_t* size, void** kept) {
    if (*kept == nullptr) {
        const auto made = static_cast<Parts*>(parts)->add(connection);
        if (made == nullptr) { return MHD_NO; }
        *kept = new std::shared_ptr<Exchange>(made);
        return made->begin(path, method);
    }
    Exchange& exchange = **static_cast<std::shared_ptr<Exchange>*>(*kept);
    return *size > 0 ? exchange.take_body(body, size) : exchange.proceed();
}

void Server::Parts::complete(void* parts, MHD_Connection*, void** kept, MHD_RequestTerminationCode) {
    if (*kept == nullptr) { return; }
    const std::unique_ptr<std::shared_ptr<Exchange>> exchange(static_cast<std::shared_ptr<Exchange>*>(*kept));
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
    parts->daemon =
        MHD_start_daemon(flags, 0, nullptr, nullptr, Parts::access, parts.get(), MHD_OPTION_LISTEN_SOCKET,
                         listener.socket, MHD_OPTION_NOTIFY_COMPLETED, Parts::complete, parts.get(),
                         MHD_OPTION_CONNECTION_LIMIT, kMaxConnections, MHD_OPTION_CONNECTION_TIMEOUT, kIdleSeconds,
                         MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_ARRAY, options.data(), MHD_OPTION_END);
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
    for (const auto& exchange : parts_->all()) { exchange->wake_stream(); }
}

}  // namespace lockstep::web
