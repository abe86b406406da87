#include "clients/web/site.hpp"

#include "services/flight/incident_file.hpp"

namespace lockstep::web {

std::expected<std::unique_ptr<Site>, std::string> Site::open(Session session, const SiteOptions& options) {
    std::unique_ptr<Site> site(new Site(std::move(session), options));
    auto server = Server::start(options.listener, options.tls, site->api_);
    if (!server) { return std::unexpected(server.error()); }
    const std::lock_guard lock(site->mutex_);
    site->server_ = *std::move(server);
    return site;
}

Site::Site(Session session, const SiteOptions& options)
    : machine_(session.config()),
      log_(std::to_string(wall_clock_us())),
      reports_(options.reports, incident_directory(machine_)),
      loop_(std::move(session), options.writer, [this](const auto& snapshot) { publish(*snapshot); }),
      api_({machine_, loop_, log_, desk_, reports_, embedded_assets(), options.version}, options.rules) {}

Site::~Site() {
    std::unique_ptr<Server> server;
    {
        const std::lock_guard lock(mutex_);
        server = std::move(server_);
    }
}

/// Runs in the machine's thread, which may begin before the server and end after it.
void Site::publish(const Snapshot& snapshot) {
    const std::lock_guard lock(mutex_);
    if (!server_) { return; }
    api_.publish(snapshot);
    server_->wake_streams();
}

}  // namespace lockstep::web
